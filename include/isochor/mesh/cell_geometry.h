#pragma once

// The polynomial map from the reference cell to a cell: its nodes, and its Jacobian determinant.

#include <isochor/element/shape_table.h>
#include <isochor/mesh/raw_mesh.h>

namespace isochor
{
  /// For each node of a quadratic cell, in the order of GeometryNodes, the vertices in whose middle
  /// it lies on the reference cell; bit v stands for vertex v.
  template <int dim>
  const std::vector<unsigned int> &node_vertices(CellKind kind);

  /// Nodes per cell: the vertices (order 1), or those of node_vertices (order 2).
  template <int dim>
  unsigned int n_geometry_nodes(CellKind kind, unsigned int order);

  /// The mean of the vertices whose bits are set: where the node of node_vertices lies in a
  /// quadratic cell with straight edges. Of one bit exactly that vertex.
  template <int dim>
  dealii::Point<dim> middle(unsigned int                           vertex_bits,
                            const std::vector<dealii::Point<dim>> &vertices);

  /// Where vertex @p vertices[v] of the old cell is vertex v of the new one, node result[i] of the
  /// old cell is node i of the new one (of a quadratic cell).
  template <int dim>
  std::vector<unsigned int> renumbered_nodes(CellKind                         kind,
                                             const std::vector<unsigned int> &vertices);

  /// Vertices of a cell of @p mesh.
  template <int dim>
  std::vector<dealii::Point<dim>> cell_vertices(const RawMesh<dim> &mesh, std::size_t cell);

  /// All nodes of a cell of @p mesh, whatever its order.
  template <int dim>
  std::vector<dealii::Point<dim>> cell_nodes(const RawMesh<dim> &mesh, std::size_t cell);

  /// The map's derivatives at fixed points of the reference cell.
  template <int dim>
  class CellMap
  {
  public:
    CellMap(CellKind kind, unsigned int order, const std::vector<dealii::Point<dim>> &points);

    unsigned int n_points() const
    {
      return shape.n_points();
    }
    /// Jacobian determinant at point @p q for a cell with these nodes: volume per volume of the
    /// reference cell, negative where the cell is turned inside out.
    double determinant(unsigned int q, const std::vector<dealii::Point<dim>> &nodes) const;

  private:
    ShapeTable<dim> shape;
  };
} // namespace isochor
