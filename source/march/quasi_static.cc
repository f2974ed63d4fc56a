#include <isochor/march/quasi_static.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <sstream>

namespace isochor
{
  void SteppingOptions::declare(dealii::ParameterHandler &prm)
  {
    const SteppingOptions defaults;
    prm.declare_entry("Load steps",
                      std::to_string(defaults.load_steps),
                      dealii::Patterns::Integer(1, 1000000),
                      "Number of equal steps in which the load factor goes from 0 to 1. A step "
                      "that fails is halved, and steps grow again up to this size.");
    prm.declare_entry("Minimum load step",
                      "1e-3",
                      dealii::Patterns::Double(1e-12, 1.),
                      "Smallest step of the load factor; below it the run ends as not "
                      "converged. No unit.");
  }

  void SteppingOptions::parse(dealii::ParameterHandler &prm)
  {
    load_steps   = prm.get_integer("Load steps");
    minimum_step = prm.get_double("Minimum load step");
  }

  namespace
  {
    template <int dim>
    NewtonProblem make_problem(const Equilibrium<dim> &equilibrium,
                               TangentSolver<dim>     &tangent_solver,
                               const double            load,
                               const double            tolerance,
                               const MarchCallbacks   &callbacks,
                               Stopwatch              &stopwatch,
                               ResidualSize           &last_size)
    {
      NewtonProblem problem;
      problem.residual
          = [&, load, tolerance](const Vector &x, Vector &residual) -> NewtonProblem::Size {
        const auto scope = stopwatch.measure(Phase::assembly);
        last_size        = equilibrium.residual(x, load, residual);

        NewtonProblem::Size size;
        size.merit      = std::hypot(last_size.force, last_size.constraint);
        size.target     = std::max(tolerance, last_size.rounding);
        size.admissible = equilibrium.is_linear() || last_size.min_jacobian > 0.;

        Vector       gap(x.get_partitioner());
        const double largest = equilibrium.prescribed().gap(x, load, gap);
        // Adding a difference does not give back the last bit.
        size.gap = largest <= 1e-13 * (x.linfty_norm() + largest) ? 0. : largest;
        return size;
      };
      problem.correction =
          [&, load](const Vector &x, const Vector &residual, const double tolerance, Vector &step) {
            return tangent_solver.correction(x, load, residual, tolerance, step);
          };
      problem.accepted = [&](unsigned int, const NewtonProblem::Size &, double) {
        return callbacks.interrupted();
      };
      return problem;
    }

    std::string describe_failure(const double            load,
                                 const NewtonReport     &newton,
                                 const ResidualSize     &size,
                                 const LinearStatistics &statistics,
                                 const double            step,
                                 const double            minimum_step)
    {
      std::ostringstream why;
      why << "step below minimum: from load factor " << load << " a step of " << step
          << " failed and the next would be below " << minimum_step << "; " << newton.reason;
      if (newton.outcome == NewtonOutcome::inverted)
        why << " (inverted cell, min J " << size.min_jacobian << ")";
      if (statistics.null_pivots > 0)
        why << "; " << statistics.null_pivots << " null pivots: the tangent is singular";
      if (statistics.pivot_excess.value_or(0) > 0)
        why << "; " << *statistics.pivot_excess
            << " negative pivots too many: the equilibrium is unstable there";
      if (statistics.pivot_excess.value_or(0) < 0)
        why << "; " << -*statistics.pivot_excess
            << " negative pivots too few: some pressures are not determined";
      return why.str();
    }
  } // namespace

  template <int dim>
  MarchReport march_quasi_static(const Equilibrium<dim> &equilibrium,
                                 TangentSolver<dim>     &tangent_solver,
                                 const NewtonOptions    &asked_newton_options,
                                 const SteppingOptions  &stepping,
                                 const MarchCallbacks   &callbacks,
                                 Stopwatch              &stopwatch,
                                 Vector                 &state,
                                 const MarchState       &begin)
  {
    // A linear problem is to take one iteration.
    NewtonOptions newton_options = asked_newton_options;
    if (equilibrium.is_linear())
      newton_options.largest_linear_tolerance = 0.;

    MarchReport  report       = begin.report;
    const double largest_step = 1. / stepping.load_steps;
    double       step         = largest_step;
    if (!begin.vectors.empty())
      {
        state = begin.vectors.front();
        state.update_ghost_values();
        step = std::min(begin.numbers.front(), largest_step);
      }
    Vector trial(state);

    while (report.load < 1.)
      {
        // No sliver of a step at the end.
        const double    load = report.load + step > 1. - 1e-9 ? 1. : report.load + step;
        const Stopwatch clock;

        ResidualSize size;
        trial                      = state;
        const auto   problem       = make_problem(equilibrium,
                                          tangent_solver,
                                          load,
                                          newton_options.tolerance,
                                          callbacks,
                                          stopwatch,
                                          size);
        NewtonReport newton_report = callbacks.solve ? callbacks.solve(load, size, trial)
                                                     : newton(problem, newton_options, trial);
        report.newton_iterations += newton_report.iterations;

        if (newton_report.outcome == NewtonOutcome::converged)
          {
            state.swap(trial);
            state.update_ghost_values();
            report.load = load;
            report.size = size;
            ++report.load_steps;
            step = std::min(2. * step, largest_step);
            callbacks.converged({report.load_steps, load, newton_report, size, clock.total()},
                                state);
            if (callbacks.resumable && load < 1.)
              callbacks.resumable({report, {state}, {step}});
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
            const double next = 0.5 * (load - report.load);
            if (next < stepping.minimum_step)
              {
                report.status = RunStatus::not_converged;
                report.reason = describe_failure(report.load,
                                                 newton_report,
                                                 size,
                                                 tangent_solver.statistics(),
                                                 load - report.load,
                                                 stepping.minimum_step);
                return report;
              }
            step = next;
            callbacks.failed(load, newton_report, next);
          }
        if (report.load < 1. && callbacks.interrupted())
          {
            report.status = RunStatus::interrupted;
            report.reason = "interrupted after load factor " + std::to_string(report.load);
            return report;
          }
      }
    return report;
  }

  template MarchReport march_quasi_static(const Equilibrium<2> &,
                                          TangentSolver<2> &,
                                          const NewtonOptions &,
                                          const SteppingOptions &,
                                          const MarchCallbacks &,
                                          Stopwatch &,
                                          Vector &,
                                          const MarchState &);
  template MarchReport march_quasi_static(const Equilibrium<3> &,
                                          TangentSolver<3> &,
                                          const NewtonOptions &,
                                          const SteppingOptions &,
                                          const MarchCallbacks &,
                                          Stopwatch &,
                                          Vector &,
                                          const MarchState &);
} // namespace isochor
