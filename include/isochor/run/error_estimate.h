#pragma once

// What a run that has converged tells of its own discretisation error.

#include <isochor/measure/probes.h>
#include <isochor/solver/tangent_solver.h>

namespace isochor
{
  /// J(u) - J(u_h) of each probe column, estimated at the equilibrium @p state by RecoveredError. NaN
  /// where @p is_wanted does not hold for the probe's name, the probe has no derivatives
  /// (Probes::derivatives), its adjoint no solution or the body too few cells. Collective.
  template <int dim>
  std::vector<double>
  estimated_errors(const std::function<bool(const std::string &probe)> &is_wanted,
                   const Scene<dim>                                    &scene,
                   const Probes<dim>                                   &probes,
                   const Equilibrium<dim>                              &equilibrium,
                   TangentSolver<dim>                                  &tangent_solver,
                   Stopwatch                                           &stopwatch,
                   const Vector                                        &state,
                   double                                               load);
} // namespace isochor
