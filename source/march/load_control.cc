#include <isochor/march/load_control.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    // A step that is on its way needs no more, and towards an equilibrium that is unstable indeed,
    // filtered ones would go on for long.
    constexpr unsigned int max_filtered_corrections = 15;
    // A filtered step leads to a smaller energy, on whose way the residual may rise for longer.
    constexpr unsigned int patience_with_filter = 8;
  } // namespace

  std::string MarchReport::status_text() const
  {
    std::string text = run_status_names.name(status);
    if (status == RunStatus::unstable)
      text += " (" + std::to_string(*pivot_excess) + (*pivot_excess == 1 ? " mode)" : " modes)");
    return text;
  }

  template <int dim>
  LoadControl<dim>::LoadControl(const Equilibrium<dim> &equilibrium,
                                TangentSolver<dim>     &tangent_solver,
                                const NewtonOptions    &newton_options,
                                const MarchCallbacks   &callbacks,
                                Stopwatch              &stopwatch)
    : equilibrium(equilibrium)
    , tangent_solver(tangent_solver)
    , newton_options(newton_options)
    , callbacks(callbacks)
    , stopwatch(stopwatch)
  {
    // A linear problem is to take one iteration.
    if (equilibrium.is_linear())
      this->newton_options.largest_linear_tolerance = 0.;
  }

  template <int dim>
  NewtonProblem::Size LoadControl<dim>::residual(const Vector &x,
                                                 const double  load,
                                                 Vector       &residual,
                                                 ResidualSize &all) const
  {
    const auto scope = stopwatch.measure(Phase::assembly);
    all              = equilibrium.residual(x, load, residual);

    NewtonProblem::Size size;
    size.merit      = std::hypot(all.force, all.constraint);
    size.target     = std::max(newton_options.tolerance, all.rounding);
    size.admissible = equilibrium.is_linear() || all.min_jacobian > 0.;
    if (equilibrium.is_minimum())
      size.energy = all.value;

    Vector       gap(x.get_partitioner());
    const double largest = equilibrium.prescribed().gap(x, load, gap);
    // Adding a difference does not give back the last bit.
    size.gap = largest <= 1e-13 * (x.linfty_norm() + largest) ? 0. : largest;
    return size;
  }

  template <int dim>
  std::string LoadControl<dim>::find_rate(const Vector &x, const double load, Vector &rate) const
  {
    Vector       force(x.get_partitioner()), step(force);
    ResidualSize size;
    residual(x, load, force, size);
    const auto correction = tangent_solver.correction(
        x, load, force, newton_options.largest_linear_tolerance, step, &rate);
    return correction.succeeded ? "" : correction.failure;
  }

  template <int dim>
  void LoadControl<dim>::tell(const double load, const NewtonReport &newton) const
  {
    if (callbacks.solved)
      callbacks.solved(load, newton);
  }

  template <int dim>
  NewtonReport LoadControl<dim>::solve(const double          load,
                                       Vector               &x,
                                       ResidualSize         &size,
                                       const CurvatureFilter filter) const
  {
    NewtonReport report = iterate(load, x, size, filter);
    tell(load, report);
    return report;
  }

  template <int dim>
  NewtonReport LoadControl<dim>::iterate(const double          load,
                                         Vector               &x,
                                         ResidualSize         &size,
                                         const CurvatureFilter filter) const
  {
    if (callbacks.solve)
      return callbacks.solve(load, size, x);
    NewtonProblem problem;
    problem.residual = [&](const Vector &at, Vector &residual) {
      return this->residual(at, load, residual, size);
    };
    problem.correction
        = [&](const Vector &at, const Vector &residual, const double tolerance, Vector &step) {
            return tangent_solver.correction(at, load, residual, tolerance, step);
          };
    problem.fallback
        = [&](const Vector &at, const Vector &residual, const double tolerance, Vector &step) {
            return tangent_solver.filtered_correction(at, load, residual, tolerance, step);
          };
    problem.accepted = [&](unsigned int, const NewtonProblem::Size &, double) {
      return callbacks.interrupted();
    };
    tangent_solver.filter_unstable(filter, max_filtered_corrections);
    NewtonOptions options = newton_options;
    if (filter != CurvatureFilter::none)
      options.patience = std::max(options.patience, patience_with_filter);
    return newton(problem, options, x);
  }

  template <int dim>
  void LoadControl<dim>::finish(const Vector &state, MarchReport &report) const
  {
    if (report.load_steps > 0)
      {
        tangent_solver.certify(state, report.load);
        report.pivot_excess = tangent_solver.statistics().pivot_excess;
      }
    if (!report.reason.empty())
      return;
    if (!report.pivot_excess)
      report.status = RunStatus::converged;
    else
      report.status = *report.pivot_excess > 0 ? RunStatus::unstable : RunStatus::stable;
  }

  std::string describe_failure(const NewtonReport     &newton,
                               const ResidualSize     &size,
                               const LinearStatistics &statistics)
  {
    const long long    excess = statistics.pivot_excess.value_or(0);
    std::ostringstream why;
    if (statistics.null_pivots > 0)
      why << "singular tangent (" << statistics.null_pivots << " null pivots): ";
    else if (newton.outcome == NewtonOutcome::inverted)
      why << "inverted cell (min J " << size.min_jacobian << "): ";
    else if (excess > 0)
      why << "unstable (" << excess << " negative pivots too many on the way): ";
    else if (newton.outcome != NewtonOutcome::linear)
      why << "no convergence: ";
    why << newton.reason;
    if (excess < 0)
      why << "; " << -excess << " negative pivots too few: some pressures are not determined";
    return why.str();
  }

  std::string describe_minimum(const double load, const double step, const double minimum_step)
  {
    std::ostringstream why;
    why << "; step below minimum: from load factor " << load << " a step of " << step
        << " failed and the next would be below " << minimum_step;
    return why.str();
  }

  template class LoadControl<2>;
  template class LoadControl<3>;
} // namespace isochor
