#pragma once

// Shape figures of single simplices and of whole meshes.

#include <isochor/mesh/raw_mesh.h>

#include <array>

namespace isochor
{
  struct CellShape
  {
    double volume          = 0; ///< signed: negative if the cell is inverted
    double longest_edge    = 0;
    double smallest_height = 0; ///< 0 or more
    double min_angle       = 0; ///< degrees; between faces (2D: edges)
  };

  template <int dim>
  CellShape cell_shape(const std::array<dealii::Point<dim>, dim + 1> &vertices);

  template <int dim>
  std::array<dealii::Point<dim>, dim + 1> cell_vertices(const RawMesh<dim> &mesh, std::size_t cell);

  template <int dim>
  MeshQuality measure_quality(const RawMesh<dim> &mesh);
} // namespace isochor
