#pragma once

#include <isochor/element/lagrange_simplex.h>

namespace isochor
{
  /// The displacement of MINI (Arnold, Brezzi and Fortin 1984): linear, and the bubble
  /// (d + 1)^(d + 1) prod_v lambda_v, which is 1 at the centroid and 0 on the faces. The linear
  /// functions do not vanish at the bubble's node: its value there is not the field's.
  template <int dim>
  class BubbleSimplex : public ShapeFunctions<dim>
  {
  public:
    CellKind kind() const override
    {
      return CellKind::simplex;
    }
    unsigned int degree() const override
    {
      return dim + 1;
    }
    unsigned int trace_degree() const override
    {
      return 1;
    }
    unsigned int n_nodes() const override
    {
      return dim + 2;
    }
    dealii::Point<dim>        node(unsigned int i) const override;
    double                    value(unsigned int i, const dealii::Point<dim> &xi) const override;
    dealii::Tensor<1, dim>    gradient(unsigned int i, const dealii::Point<dim> &xi) const override;
    std::vector<unsigned int> nodes_on_face(unsigned int face_no) const override;
    std::vector<unsigned int> nodes_per_object() const override;

  private:
    const LagrangeSimplex<dim> linear{1};
  };
} // namespace isochor
