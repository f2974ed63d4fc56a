#pragma once

// Shape functions at fixed points of the reference cell: loops over cells read these, because
// evaluating the functions anew for every cell costs more than what is done with them.

#include <isochor/element/shape_functions.h>

#include <deal.II/base/tensor.h>

namespace isochor
{
  template <int dim>
  class ShapeTable
  {
  public:
    ShapeTable(const ShapeFunctions<dim>             &shape,
               const std::vector<dealii::Point<dim>> &reference_points);

    unsigned int n_nodes() const
    {
      return n;
    }
    unsigned int n_points() const
    {
      return values.size() / n;
    }
    double value(const unsigned int point, const unsigned int i) const
    {
      return values[point * n + i];
    }
    /// d/d xi
    const dealii::Tensor<1, dim> &gradient(const unsigned int point, const unsigned int i) const
    {
      return gradients[point * n + i];
    }

  private:
    unsigned int                        n;
    std::vector<double>                 values;
    std::vector<dealii::Tensor<1, dim>> gradients;
  };
} // namespace isochor
