#pragma once

// Lagrange polynomials of degree 0 to 3 on the reference simplex.

#include <isochor/element/shape_functions.h>

namespace isochor
{
  template <int dim>
  class LagrangeSimplex : public ShapeFunctions<dim>
  {
  public:
    using typename ShapeFunctions<dim>::EdgeNodes;

    /// @p degree 0 (one node at the centroid, discontinuous), 1, 2 or 3.
    explicit LagrangeSimplex(unsigned int degree);

    CellKind kind() const override
    {
      return CellKind::simplex;
    }
    unsigned int degree() const override
    {
      return degree_;
    }
    unsigned int n_nodes() const override
    {
      return indices.size();
    }
    dealii::Point<dim>        node(unsigned int i) const override;
    double                    value(unsigned int i, const dealii::Point<dim> &xi) const override;
    dealii::Tensor<1, dim>    gradient(unsigned int i, const dealii::Point<dim> &xi) const override;
    std::vector<unsigned int> nodes_on_face(unsigned int face_no) const override;
    std::vector<unsigned int> nodes_per_object() const override;
    const std::vector<EdgeNodes> &edge_nodes() const override
    {
      return cubic_edges;
    }

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
} // namespace isochor
