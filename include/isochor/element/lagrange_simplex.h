#pragma once

// Lagrange polynomials of degree 0 to 3 on the reference simplex, nodes in the order in which
// a deal.II DoFHandler lists the DoFs of a cell: vertices, edges, faces (3D), interior.

#include <deal.II/base/point.h>

#include <array>
#include <utility>
#include <vector>

namespace isochor
{
  template <int dim>
  class LagrangeSimplex
  {
  public:
    /// @p degree 0 (one node at the centroid, discontinuous), 1, 2 or 3.
    explicit LagrangeSimplex(unsigned int degree);

    unsigned int degree() const
    {
      return degree_;
    }
    unsigned int n_nodes() const
    {
      return indices.size();
    }

    /// Reference position of node @p i.
    dealii::Point<dim> node(unsigned int i) const;

    double value(unsigned int i, const dealii::Point<dim> &xi) const;

    dealii::Tensor<1, dim> gradient(unsigned int i, const dealii::Point<dim> &xi) const;

    /// The two nodes inside each edge of the cubic with the edge's two vertices, each node
    /// paired with the vertex it is nearer to; empty for lower degrees. See Field for why.
    struct EdgeNodes
    {
      std::array<unsigned int, 2> vertices;
      std::array<unsigned int, 2> nodes;
    };
    const std::vector<EdgeNodes> &edge_nodes() const
    {
      return cubic_edges;
    }

    /// Nodes on face @p face_no, in ascending order.
    std::vector<unsigned int> nodes_on_face(unsigned int face_no) const;

    /// Number of nodes on each vertex, inside each edge, face, cell.
    std::vector<unsigned int> nodes_per_object() const;

  private:
    /// N = prod_v prod_{m < a_v} (k lambda_v - m) / (m + 1), a the multi-index of the node.
    using MultiIndex = std::array<unsigned int, dim + 1>;

    unsigned int            degree_;
    std::vector<MultiIndex> indices;
    std::vector<EdgeNodes>  cubic_edges;
  };

  /// Barycentric coordinates of a reference point; the first belongs to the vertex at the origin.
  template <int dim>
  std::array<double, dim + 1> barycentric(const dealii::Point<dim> &xi);

  /// Vertices of edge / face of the reference simplex in deal.II's numbering.
  template <int dim>
  std::array<unsigned int, 2> edge_vertices(unsigned int edge);
  template <int dim>
  std::array<unsigned int, dim> face_vertices(unsigned int face);
} // namespace isochor
