#pragma once

// Quadrature on simplices, by the polynomial degree that must be exact.

#include <deal.II/base/quadrature.h>

namespace isochor
{
  /// Fewest-point rule of deal.II on the reference simplex of dimension @p dim (1 to 3) that is
  /// exact to @p degree (up to 9); weights add up to 1 / dim!. deal.II 9.4.1 returns empty or
  /// weaker rules without a word where it has none; this throws std::logic_error instead.
  template <int dim>
  dealii::Quadrature<dim> simplex_quadrature(unsigned int degree);
} // namespace isochor
