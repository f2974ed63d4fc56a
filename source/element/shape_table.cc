#include <isochor/element/shape_table.h>

namespace isochor
{
  template <int dim>
  ShapeTable<dim>::ShapeTable(const ShapeFunctions<dim>             &shape,
                              const std::vector<dealii::Point<dim>> &reference_points)
    : n(shape.n_nodes())
  {
    for (const auto &xi : reference_points)
      for (unsigned int i = 0; i < n; ++i)
        {
          values.push_back(shape.value(i, xi));
          gradients.push_back(shape.gradient(i, xi));
        }
  }

  template class ShapeTable<2>;
  template class ShapeTable<3>;
} // namespace isochor
