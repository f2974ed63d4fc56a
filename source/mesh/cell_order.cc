#include "cell_order.h"

#include <isochor/mesh/cell_geometry.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void renumber_vertices(RawMesh<dim>                    &mesh,
                         const std::size_t                cell,
                         const std::vector<unsigned int> &vertices)
  {
    auto      &numbers = mesh.cells[cell].vertices;
    const auto before  = numbers;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      numbers[v] = before[vertices[v]];
    if (mesh.geometry.order == 1)
      return;
    const auto nodes = cell_nodes(mesh, cell);
    const auto order = renumbered_nodes<dim>(mesh.kind, vertices);
    for (unsigned int i = 0; i < order.size(); ++i)
      mesh.geometry.points[cell * order.size() + i] = nodes[order[i]];
  }

  template <int dim>
  void direct_edges_alike(RawMesh<dim> &mesh)
  {
    if (mesh.kind == CellKind::simplex || mesh.cells.empty())
      return;
    auto turned = mesh.cells;
    dealii::GridTools::consistently_order_cells(turned);
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const auto               &old = mesh.cells[cell].vertices;
        std::vector<unsigned int> order;
        for (const unsigned int vertex : turned[cell].vertices)
          order.push_back(std::find(old.begin(), old.end(), vertex) - old.begin());
        renumber_vertices(mesh, cell, order);
      }
  }

  template void renumber_vertices(RawMesh<2> &, std::size_t, const std::vector<unsigned int> &);
  template void renumber_vertices(RawMesh<3> &, std::size_t, const std::vector<unsigned int> &);
  template void direct_edges_alike(RawMesh<2> &);
  template void direct_edges_alike(RawMesh<3> &);
} // namespace isochor
