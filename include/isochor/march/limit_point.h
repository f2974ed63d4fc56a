#pragma once

// Why load control comes to a halt: at a limit point there is no equilibrium at larger loads nearby.

#include <isochor/march/load_control.h>

namespace isochor
{
  /// An equilibrium and its load factor.
  struct PathPoint
  {
    const Vector &state;
    double        load;
  };

  /// Load factor of the limit point towards which the path goes through @p before and @p last; none
  /// if it is not near. Near means between @p last and @p failed, the load at which no equilibrium was
  /// found, or as far again.
  ///
  /// Measured is the rate of displacement per load, |du/dl|: close to a limit point at l* it grows like
  /// (l* - l)^(-1/2) (Riks 1979), so that |du/dl|^-2 goes to zero on a straight line. Two tangents are
  /// factored. Collective.
  template <int dim>
  std::optional<double> limit_point_ahead(const LoadControl<dim> &control,
                                          const PathPoint        &before,
                                          const PathPoint        &last,
                                          double                  failed);

  /// That it is one, and what follows it.
  std::string describe_limit_point(double load);
} // namespace isochor
