#pragma once

// Quadrature on reference cells, by the polynomial degree that must be exact.

#include <isochor/core/reference_cell.h>

#include <deal.II/base/quadrature.h>

namespace isochor
{
  /// Simplices (dim 1 to 3): the rule with the fewest points of deal.II that is exact to total
  /// degree @p degree, up to 9. deal.II 9.4.1 returns empty or weaker rules without a word where it
  /// has none; this throws std::logic_error instead. Hypercubes: Gauss, exact to @p degree in each
  /// coordinate. Weights add up to the volume of the reference cell.
  template <int dim>
  dealii::Quadrature<dim> cell_quadrature(CellKind kind, unsigned int degree);
} // namespace isochor
