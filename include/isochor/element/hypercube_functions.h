#pragma once

// Shape functions on the unit square and cube.

#include <isochor/element/shape_functions.h>

namespace isochor
{
  /// Products of Lagrange polynomials of degree 1 or 2 in each coordinate.
  template <int dim>
  class LagrangeHypercube : public ShapeFunctions<dim>
  {
  public:
    explicit LagrangeHypercube(unsigned int degree);

    CellKind kind() const override
    {
      return CellKind::hypercube;
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

  private:
    unsigned int degree_;
    /// Node i lies at indices[i] / degree.
    std::vector<std::array<unsigned int, dim>> indices;
  };

  /// 1 and, of degree 1, xi_k - 1/2: polynomials of total degree 0 or 1 on one cell alone.
  template <int dim>
  class DiscontinuousHypercube : public ShapeFunctions<dim>
  {
  public:
    explicit DiscontinuousHypercube(unsigned int degree);

    CellKind kind() const override
    {
      return CellKind::hypercube;
    }
    unsigned int degree() const override
    {
      return degree_;
    }
    unsigned int n_nodes() const override
    {
      return degree_ == 0 ? 1 : dim + 1;
    }
    dealii::Point<dim>        node(unsigned int i) const override;
    double                    value(unsigned int i, const dealii::Point<dim> &xi) const override;
    dealii::Tensor<1, dim>    gradient(unsigned int i, const dealii::Point<dim> &xi) const override;
    std::vector<unsigned int> nodes_on_face(unsigned int face_no) const override;
    std::vector<unsigned int> nodes_per_object() const override;

  private:
    unsigned int degree_;
  };
} // namespace isochor
