#include <isochor/march/arc_length.h>
#include <isochor/march/limit_point.h>
#include <isochor/march/quasi_static.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /// The straight line through the last two converged states. (The tangent of the path would not
    /// do better: it is Newton's first iteration from the last state.)
    template <int dim>
    class Extrapolation
    {
    public:
      explicit Extrapolation(const LoadControl<dim> &control)
        : control(control)
      {
      }

      /// Before @p state, an equilibrium at load factor @p load, is replaced.
      void remember(const Vector &state, const double load)
      {
        before      = state;
        load_before = load;
      }

      /// Move @p trial, the equilibrium at @p from, to @p to, unless that inverts a cell or is worse
      /// to start from than to stay.
      void apply(Vector &trial, const double from, const double to)
      {
        if (before.size() == 0)
          return;
        Vector       residual(trial), guess(trial);
        const double ratio = (to - from) / (from - load_before);
        guess.sadd(1. + ratio, -ratio, before);
        // Residuals of different boundary positions do not compare, but extrapolated ones are closer.
        Vector gap(trial);
        control.equilibrium.prescribed().gap(guess, to, gap);
        guess += gap;

        ResidualSize              all;
        const NewtonProblem::Size here  = control.residual(trial, to, residual, all);
        const NewtonProblem::Size there = control.residual(guess, to, residual, all);
        // Written so that NaN stays.
        if (there.admissible && (there.merit < here.merit || (here.gap > 0. && there.merit < 1.)))
          trial.swap(guess);
      }

      /// Empty unless the path through the last state and @p last goes to a limit point, not far from
      /// the load factor @p failed.
      std::string describe_limit(const PathPoint &last, const double failed) const
      {
        // The dual ascent's tangent is another one.
        if (before.size() == 0 || control.callbacks.solve)
          return "";
        const auto limit = limit_point_ahead(control, {before, load_before}, last, failed);
        return limit ? describe_limit_point(*limit) : "";
      }

      Vector before;
      double load_before = 0;

    private:
      const LoadControl<dim> &control;
    };

    template <int dim>
    MarchReport march_in_steps(const LoadControl<dim> &control,
                               const SteppingOptions  &stepping,
                               Vector                 &state,
                               const MarchState       &begin)
    {
      const MarchCallbacks   &callbacks  = control.callbacks;
      const LinearStatistics &statistics = control.tangent_solver.statistics();
      MarchReport             report     = begin.report;
      StepControl             step_control(stepping);
      Extrapolation<dim>      extrapolation(control);
      // From an unstable equilibrium on, the next is likely to be so too, and the filter only leads
      // away from it; where it has failed, it may be for that reason.
      bool is_unstable = false, filters = true;
      if (begin.state.size() > 0)
        {
          state = begin.state;
          state.update_ghost_values();
          step_control.resume(begin.next_step);
        }
      if (begin.load_history)
        {
          extrapolation.remember(begin.load_history->before, begin.load_history->load_before);
          is_unstable = begin.load_history->is_unstable;
          filters     = !is_unstable;
        }
      Vector trial(state);
      while (report.load < 1.)
        {
          // No sliver of a step at the end.
          const double       step = step_control.step();
          const double       load = report.load + step > 1. - 1e-9 ? 1. : report.load + step;
          const Stopwatch    clock;
          const unsigned int factorisations = statistics.factorisations;

          ResidualSize size;
          trial = state;
          if (stepping.extrapolates)
            extrapolation.apply(trial, report.load, load);
          const NewtonReport newton_report
              = control.solve(load, trial, size, filters ? stepping.filter : CurvatureFilter::none);
          report.newton_iterations += newton_report.iterations;

          if (newton_report.outcome == NewtonOutcome::converged)
            {
              extrapolation.remember(state, report.load);
              state.swap(trial);
              state.update_ghost_values();
              report.load = load;
              report.size = size;
              ++report.load_steps;
              step_control.succeeded(newton_report.iterations);
              LoadStep done{report.load_steps, load, newton_report, size, clock.total(), {}};
              if (statistics.factorisations > factorisations)
                done.pivot_excess = statistics.pivot_excess;
              is_unstable = done.pivot_excess.value_or(0) > 0;
              filters     = !is_unstable;
              callbacks.converged(done, state);
              if (callbacks.resumable && load < 1.)
                callbacks.resumable({report,
                                     state,
                                     step_control.step(),
                                     MarchState::LoadHistory{extrapolation.before,
                                                             extrapolation.load_before,
                                                             is_unstable},
                                     {}});
            }
          else if (newton_report.outcome == NewtonOutcome::interrupted)
            {
              report.status = RunStatus::interrupted;
              report.reason = "interrupted on the way to load factor " + std::to_string(load);
              return report;
            }
          else
            {
              ++report.failed_steps;
              filters = !is_unstable && !filters;
              if (!step_control.failed(load - report.load))
                {
                  report.reason
                      = describe_failure(newton_report, size, statistics)
                        + describe_minimum(report.load, load - report.load, stepping.minimum_step);
                  report.reason += extrapolation.describe_limit({state, report.load}, load);
                  control.finish(state, report);
                  return report;
                }
              callbacks.failed(load, newton_report, step_control.step());
            }
          if (report.load < 1. && callbacks.interrupted())
            {
              report.status = RunStatus::interrupted;
              report.reason = "interrupted after load factor " + std::to_string(report.load);
              return report;
            }
        }
      control.finish(state, report);
      return report;
    }
  } // namespace

  template <int dim>
  MarchReport march_quasi_static(const LoadControl<dim> &control,
                                 const SteppingOptions  &stepping,
                                 Vector                 &state,
                                 const MarchState       &begin)
  {
    if (stepping.kind == Stepping::arc_length)
      return march_along_path(control, stepping, state, begin);
    return march_in_steps(control, stepping, state, begin);
  }

  template MarchReport
  march_quasi_static(const LoadControl<2> &, const SteppingOptions &, Vector &, const MarchState &);
  template MarchReport
  march_quasi_static(const LoadControl<3> &, const SteppingOptions &, Vector &, const MarchState &);
} // namespace isochor
