#pragma once

// Shape figures of single cells and of whole meshes.

#include <isochor/mesh/cell_geometry.h>

namespace isochor
{
  /// Of a cell with straight edges.
  struct CellShape
  {
    double volume       = 0; ///< signed: negative if the cell is inverted; exact, also trilinear
    double longest_edge = 0;
    /// 0 or more. Of a quadrilateral or hexahedron: of the parallelepipeds that the edges at one
    /// vertex span, the smallest height; that of a brick is its shortest edge.
    double smallest_height = 0;
    /// Degrees. Triangle: between edges; tetrahedron: between faces; quadrilateral: between edges;
    /// hexahedron: between two edges, or between the planes of two pairs of edges, at one vertex.
    double min_angle = 0;
  };

  template <int dim>
  CellShape cell_shape(CellKind kind, const std::vector<dealii::Point<dim>> &vertices);

  template <int dim>
  MeshQuality measure_quality(const RawMesh<dim> &mesh);
} // namespace isochor
