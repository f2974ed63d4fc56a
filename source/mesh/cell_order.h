#pragma once

// In which order a cell's vertices are.

#include <isochor/mesh/raw_mesh.h>

namespace isochor
{
  /// Vertex @p vertices[v] of a cell becomes its vertex v; its geometry nodes follow.
  template <int dim>
  void renumber_vertices(RawMesh<dim>                    &mesh,
                         std::size_t                      cell,
                         const std::vector<unsigned int> &vertices);

  /// Quadrilaterals and hexahedra: turn the cells so that they agree on the direction of their
  /// edges, which deal.II needs in 2D always, in 3D as far as the mesh allows. Others stay.
  template <int dim>
  void direct_edges_alike(RawMesh<dim> &mesh);
} // namespace isochor
