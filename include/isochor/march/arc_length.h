#pragma once

// Along the path of equilibria (state, load factor), through limit points and turning points: what
// snaps through under load control is followed here (Riks 1979, Crisfield 1981).

#include <isochor/march/load_control.h>

namespace isochor
{
  /// Arc length squared is |d u|^2 / U^2 + d load^2, |u| over the displacement unknowns, U = |d u /
  /// d load| at the start of the path, where both parts are thus equal. Every step is a tangent
  /// predictor and Newton in the plane perpendicular to it. Loads and supports may be any formulas
  /// of the load factor that have a derivative, which is taken by differences. The path ends on the
  /// state at which the load factor first reaches 1, or as SteppingOptions say. Collective.
  template <int dim>
  MarchReport march_along_path(const LoadControl<dim> &control,
                               const SteppingOptions  &stepping,
                               Vector                 &state,
                               const MarchState       &begin);
} // namespace isochor
