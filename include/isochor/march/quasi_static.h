#pragma once

// Quasi-static load stepping: the load factor goes from 0 to 1; a step that fails is halved, and
// steps grow again after each success.

#include <isochor/solver/tangent_solver.h>

namespace isochor
{
  struct SteppingOptions
  {
    unsigned int load_steps   = 1;
    double       minimum_step = 1e-3; ///< of the load factor

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
  };

  /// One converged load step.
  struct LoadStep
  {
    unsigned int number = 0; ///< from 1
    double       load   = 0; ///< factor reached
    NewtonReport newton;
    ResidualSize size;
    double       seconds = 0;
  };

  enum class RunStatus
  {
    converged,
    not_converged,
    interrupted
  };
  inline constexpr auto run_status_names
      = name_table<RunStatus>({{RunStatus::converged, "converged"},
                               {RunStatus::not_converged, "not converged"},
                               {RunStatus::interrupted, "interrupted"}});

  struct MarchReport
  {
    RunStatus    status = RunStatus::converged;
    std::string  reason;                ///< empty if converged
    double       load              = 0; ///< last converged load factor
    unsigned int load_steps        = 0; ///< converged
    unsigned int failed_steps      = 0;
    unsigned int newton_iterations = 0; ///< of converged and failed steps
    ResidualSize size;                  ///< at the last converged state
  };

  /// Between two load steps: what the march needs to go on from there.
  struct MarchState
  {
    MarchReport report; ///< so far
    /// The last converged state, and what else the way of stepping needs. None: the march begins at
    /// the state that it is given.
    std::vector<Vector> vectors;
    std::vector<double> numbers; ///< likewise: the next step of the load factor
  };

  struct MarchCallbacks
  {
    /// Solves one load step in the place of Newton's method, from @p state; null: Newton's method.
    std::function<NewtonReport(double load, ResidualSize &size, Vector &state)> solve;
    /// After each converged step, with the state.
    std::function<void(const LoadStep &, const Vector &state)> converged;
    /// After each failed step: why, and the next step tried.
    std::function<void(double load, const NewtonReport &, double next_step)> failed;
    /// Asks to stop.
    std::function<bool()> interrupted;
    /// After each converged step but the last: from there the march can go on another time. May
    /// be empty.
    std::function<void(const MarchState &)> resumable;
  };

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
