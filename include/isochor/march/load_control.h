#pragma once

// Newton's method at one load factor, and how a march ends: what the ways of stepping share.

#include <isochor/march/report.h>
#include <isochor/march/step_control.h>
#include <isochor/solver/tangent_solver.h>

namespace isochor
{
  /// What a march works with; all must outlive it.
  template <int dim>
  class LoadControl
  {
  public:
    LoadControl(const Equilibrium<dim> &equilibrium,
                TangentSolver<dim>     &tangent_solver,
                const NewtonOptions    &newton_options,
                const MarchCallbacks   &callbacks,
                Stopwatch              &stopwatch);

    /// Size of the residual at @p x, ready for Newton. @p all: the same in detail. Collective.
    NewtonProblem::Size
    residual(const Vector &x, double load, Vector &residual, ResidualSize &all) const;

    /// From @p x to the equilibrium at @p load; @p filter: of tangents with negative pivots too
    /// many. Collective.
    NewtonReport solve(double load, Vector &x, ResidualSize &size, CurvatureFilter filter) const;

    /// Sets @p rate to du/dl, by the tangent, at the equilibrium @p x at @p load. Why there is none;
    /// empty: there is one. Collective.
    std::string find_rate(const Vector &x, double load, Vector &rate) const;

    /// That a solution was tried at @p load.
    void tell(double load, const NewtonReport &newton) const;

    /// At the end of a march, with its last converged @p state: count negative pivots there and,
    /// if there is no reason against it, call it converged. Collective.
    void finish(const Vector &state, MarchReport &report) const;

    const Equilibrium<dim> &equilibrium;
    TangentSolver<dim>     &tangent_solver;
    NewtonOptions           newton_options;
    const MarchCallbacks   &callbacks;
    Stopwatch              &stopwatch;

  private:
    NewtonReport iterate(double load, Vector &x, ResidualSize &size, CurvatureFilter filter) const;
  };

  /// Why a step failed, the likely cause first: unstable, singular tangent, inverted cell, no
  /// convergence.
  std::string describe_failure(const NewtonReport     &newton,
                               const ResidualSize     &size,
                               const LinearStatistics &statistics);

  /// That the next step would be below the minimum.
  std::string describe_minimum(double load, double step, double minimum_step);
} // namespace isochor
