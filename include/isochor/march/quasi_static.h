#pragma once

// Quasi-static load stepping: the load factor goes from 0 to 1, in steps or along a path.

#include <isochor/march/report.h>
#include <isochor/march/step_control.h>
#include <isochor/solver/tangent_solver.h>

namespace isochor
{
  /// @p state: start, usually zero; afterwards the last converged state. @p begin: where an
  /// earlier march was left. Collective.
  template <int dim>
  MarchReport march_quasi_static(const Equilibrium<dim> &equilibrium,
                                 TangentSolver<dim>     &tangent_solver,
                                 const NewtonOptions    &newton_options,
                                 const SteppingOptions  &stepping,
                                 const MarchCallbacks   &callbacks,
                                 Stopwatch              &stopwatch,
                                 Vector                 &state,
                                 const MarchState       &begin = {});
} // namespace isochor
