#pragma once

// The two kinds of reference cells, with deal.II's numbering of their vertices, edges and faces.
// Simplex: vertex 0 at the origin, vertex v at the unit vector v - 1. Hypercube: vertex v at
// (v & 1, v >> 1 & 1, v >> 2 & 1).

#include <isochor/core/names.h>

#include <deal.II/base/point.h>

#include <vector>

namespace dealii
{
  class ReferenceCell;
}

namespace isochor
{
  enum class CellKind
  {
    simplex,  ///< triangle, tetrahedron
    hypercube ///< quadrilateral, hexahedron
  };

  /// "triangles", "tetrahedra", "quadrilaterals" or "hexahedra", for messages.
  std::string cells_name(CellKind kind, int dim);

  template <int dim>
  dealii::ReferenceCell reference_cell(CellKind kind);

  constexpr unsigned int n_vertices(const CellKind kind, const int dim)
  {
    return kind == CellKind::simplex ? dim + 1 : 1u << dim;
  }

  /// Volume of the reference cell.
  constexpr double reference_volume(const CellKind kind, const int dim)
  {
    return kind == CellKind::hypercube ? 1. : dim == 1 ? 1. : dim == 2 ? 1. / 2 : 1. / 6;
  }

  template <int dim>
  dealii::Point<dim> reference_vertex(CellKind kind, unsigned int vertex);

  template <int dim>
  dealii::Point<dim> reference_centre(CellKind kind);

  /// The two vertices of each edge; in 2D the edges are the faces.
  template <int dim>
  const std::vector<std::array<unsigned int, 2>> &reference_edges(CellKind kind);

  /// The vertices of each face: dim of a simplex, 2^(dim - 1) of a hypercube. The first is the
  /// face's origin, and vertex 1 (in 3D: vertices 1 and 2) lie along its coordinates.
  template <int dim>
  const std::vector<std::vector<unsigned int>> &reference_faces(CellKind kind);
} // namespace isochor
