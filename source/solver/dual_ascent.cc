#include <isochor/solver/dual_ascent.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    // The primal problem need not be solved better than the constraints are met.
    constexpr double first_primal_target = 1e-2, primal_part = 0.1;
    // Of the system for omega; it is a length and a prediction.
    constexpr double       response_tolerance = 1e-3;
    constexpr unsigned int max_halvings       = 5;
    constexpr double       one_percent = 1e-2, hundredth_percent = 1e-4;
  } // namespace

  void DualOptions::declare(dealii::ParameterHandler &prm)
  {
    const DualOptions defaults;
    prm.declare_entry(
        "Augmentation Poisson ratio",
        "0.4",
        dealii::Patterns::Double(0., 0.4999),
        "Dual ascent: its primal problem has the volumetric stiffness 2 mu nu / (1 - 2 "
        "nu) of this Poisson ratio, which does not change the solution. 0: none; the "
        "distortional energy alone then has to hold the body. No unit.");
    prm.declare_entry("Dual acceleration",
                      dual_acceleration_names.name(defaults.acceleration),
                      dealii::Patterns::Selection(dual_acceleration_names.selection()),
                      "Dual ascent: steepest ascent, nonlinear conjugate gradients, or Anderson's "
                      "mixing of the last six iterates.");
    prm.declare_entry(
        "Dual metric",
        dual_metric_names.name(defaults.metric),
        dealii::Patterns::Selection(dual_metric_names.selection()),
        "Dual ascent is steepest in the metric of the pressure mass matrix, the same on "
        "every mesh, or of the pressure nodes.");
    prm.declare_entry("Maximum dual iterations",
                      std::to_string(defaults.max_iterations),
                      dealii::Patterns::Integer(1, 1000000),
                      "Dual ascent: per load step; a step that needs more is halved.");
  }

  void DualOptions::parse(dealii::ParameterHandler &prm)
  {
    augmentation_poisson_ratio = prm.get_double("Augmentation Poisson ratio");
    acceleration
        = dual_acceleration_names.value(prm.get("Dual acceleration"), "Method/Dual acceleration");
    metric         = dual_metric_names.value(prm.get("Dual metric"), "Method/Dual metric");
    max_iterations = prm.get_integer("Maximum dual iterations");
  }

  DualReport most(const DualReport &a, const DualReport &b)
  {
    return {std::max(a.iterations, b.iterations),
            std::max(a.to_one_percent, b.to_one_percent),
            std::max(a.to_hundredth_percent, b.to_hundredth_percent)};
  }

  template <int dim>
  DualAscent<dim>::DualAscent(const Equilibrium<dim> &equilibrium,
                              TangentSolver<dim>     &tangent_solver,
                              const NewtonOptions    &newton_options,
                              const DualOptions      &options,
                              Stopwatch              &stopwatch)
    : equilibrium(equilibrium)
    , tangent_solver(tangent_solver)
    , newton_options(newton_options)
    , options(options)
    , stopwatch(stopwatch)
    , mass(equilibrium.discretisation())
    , directions(options.acceleration)
  {
    const double nu = options.augmentation_poisson_ratio;
    augmentation    = 2. * equilibrium.moduli().mu * nu / (1. - 2. * nu);

    Vector ones = mass.diagonal(), volumes(ones);
    ones.update_ghost_values();
    is_pressure.resize(ones.locally_owned_size() + ones.get_partitioner()->n_ghost_indices());
    for (LocalIndex i = 0; i < is_pressure.size(); ++i)
      is_pressure[i] = ones.local_element(i) > 0.;
    for (LocalIndex i = 0; i < ones.locally_owned_size(); ++i)
      ones.local_element(i) = is_pressure[i] ? 1. : 0.;
    mass.vmult(volumes, ones);
    volume      = ones * volumes;
    volume_norm = volumes.l2_norm();

    tangent_solver.change_tangents([this](SparseMatrix &matrix) { change_tangent(matrix); });
  }

  template <int dim>
  DualAscent<dim>::~DualAscent()
  {
    tangent_solver.change_tangents({});
  }

  template <int dim>
  void DualAscent<dim>::change_tangent(SparseMatrix &matrix) const
  {
    if (is_augmented())
      {
        mass.add_to(matrix, -1. / augmentation);
        return;
      }
    // Pressures are given: they leave the system, each with a row of its own. As many pivots are
    // negative as in the whole one.
    const auto &row_start = matrix.row_start();
    for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
      for (std::size_t k = row_start[row]; k < row_start[row + 1]; ++k)
        if (const LocalIndex column = matrix.columns()[k]; is_pressure[row] || is_pressure[column])
          matrix.values()[k] = row == column ? -1. : 0.;
  }

  template <int dim>
  NewtonReport DualAscent<dim>::primal(const double                 load,
                                       const double                 target,
                                       const std::function<bool()> &interrupted,
                                       DualIterate                 &at)
  {
    NewtonProblem problem;
    problem.residual = [&](const Vector &state, Vector &residual) -> NewtonProblem::Size {
      const auto         scope = stopwatch.measure(Phase::assembly);
      const ResidualSize whole = equilibrium.residual(state, load, residual);
      Vector             excess(at.pressure), part(residual);
      if (is_augmented())
        {
          for (LocalIndex i = 0; i < state.locally_owned_size(); ++i)
            excess.local_element(i) = is_pressure[i] ? state.local_element(i) : 0.;
          excess -= at.pressure;
          mass.vmult(part, excess);
          residual.add(-1. / augmentation, part);
        }
      double squared = 0;
      for (LocalIndex i = 0; i < residual.locally_owned_size(); ++i)
        if (is_pressure[i])
          {
            if (!is_augmented())
              residual.local_element(i) = 0.;
            squared += std::pow(residual.local_element(i), 2);
          }
      squared = dealii::Utilities::MPI::sum(squared, equilibrium.discretisation().communicator());

      NewtonProblem::Size size;
      size.merit      = std::hypot(whole.force, std::sqrt(squared) / volume_norm);
      size.target     = std::max(target, whole.rounding);
      size.admissible = equilibrium.is_linear() || whole.min_jacobian > 0.;
      Vector       gap(state.get_partitioner());
      const double largest = equilibrium.prescribed().gap(state, load, gap);
      size.gap             = largest <= 1e-13 * (state.linfty_norm() + largest) ? 0. : largest;
      return size;
    };
    problem.correction =
        [&](const Vector &state, const Vector &residual, const double tolerance, Vector &step) {
          const auto correction = tangent_solver.correction(state, load, residual, tolerance, step);
          has_system |= correction.succeeded;
          return correction;
        };
    problem.accepted
        = [&](unsigned int, const NewtonProblem::Size &, double) { return interrupted(); };
    return newton(problem, newton_options, at.state);
  }

  template <int dim>
  NewtonReport DualAscent<dim>::primal_after(const double                 load,
                                             const double                 target,
                                             const std::function<bool()> &interrupted,
                                             const DualIterate           &before,
                                             DualIterate                 &at)
  {
    DualIterate predicted = at;
    const auto  report    = primal(load, target, interrupted, predicted);
    if (report.outcome == NewtonOutcome::converged || report.outcome == NewtonOutcome::interrupted)
      {
        at = std::move(predicted);
        return report;
      }
    for (LocalIndex i = 0; i < at.state.locally_owned_size(); ++i)
      if (!is_pressure[i])
        at.state.local_element(i) = before.state.local_element(i);
    NewtonReport again = primal(load, target, interrupted, at);
    again.iterations += report.iterations;
    return again;
  }

  template <int dim>
  typename DualAscent<dim>::Evaluated DualAscent<dim>::evaluate(const double       load,
                                                                const DualIterate &at) const
  {
    const auto scope = stopwatch.measure(Phase::assembly);
    Evaluated  here{{}, at.pressure, 0.};
    here.size    = equilibrium.residual(at.state, load, here.gradient);
    double error = 0;
    for (LocalIndex i = 0; i < here.gradient.locally_owned_size(); ++i)
      {
        if (!is_pressure[i])
          here.gradient.local_element(i) = 0.;
        error += std::abs(here.gradient.local_element(i));
      }
    here.volume_error
        = dealii::Utilities::MPI::sum(error, equilibrium.discretisation().communicator()) / volume;
    return here;
  }

  template <int dim>
  bool DualAscent<dim>::respond(const double       load,
                                const DualIterate &at,
                                const Vector      &direction,
                                Ascent            &ascent)
  {
    Vector rhs(direction), solution(direction), product(direction);
    if (!has_system)
      {
        // The first primal problem of this program took no iteration: so begins a run that goes on.
        equilibrium.residual(at.state, load, rhs);
        has_system = tangent_solver
                         .correction(
                             at.state, load, rhs, newton_options.largest_linear_tolerance, solution)
                         .succeeded;
        if (!has_system)
          return false;
        rhs = direction;
      }
    if (is_augmented())
      {
        mass.vmult(product, direction);
        rhs.equ(-1. / augmentation, product);
      }
    else
      {
        equilibrium.tangent_product(at.state, load, direction, product);
        for (LocalIndex i = 0; i < rhs.locally_owned_size(); ++i)
          rhs.local_element(i) = is_pressure[i] ? 0. : product.local_element(i);
        equilibrium.prescribed().set_zero(rhs);
      }
    if (!tangent_solver.solve_again(rhs, response_tolerance, solution).succeeded)
      return false;

    if (is_augmented())
      {
        // d . (M / kappa_a) (d - dq)
        ascent.curvature = (product * direction - product * solution) / augmentation;
        ascent.response  = std::move(solution);
      }
    else
      {
        // d . G K^-1 G^T d + d . C d; x answers with -K^-1 G^T d.
        ascent.curvature = rhs * solution - product * direction;
        solution *= -1.;
        solution += direction;
        ascent.response = std::move(solution);
      }
    return ascent.curvature > 0.;
  }

  template <int dim>
  NewtonReport DualAscent<dim>::solve(const double                 load,
                                      const std::function<bool()> &interrupted,
                                      ResidualSize                &size,
                                      Vector                      &state)
  {
    directions.restart();
    counts = {};
    DualIterate at{state, state};
    for (LocalIndex i = 0; i < state.locally_owned_size(); ++i)
      if (!is_pressure[i])
        at.pressure.local_element(i) = 0.;
    at.pressure.zero_out_ghost_values();

    NewtonReport total;
    const auto   failed = [&](const NewtonOutcome outcome, const std::string &why) {
      total.outcome = outcome;
      total.reason  = why + " (dual iteration " + std::to_string(counts.iterations) + ")";
      return total;
    };

    double       length        = 0.;
    NewtonReport newton_report = primal(load, first_primal_target, interrupted, at);
    while (true)
      {
        ++counts.iterations;
        total.iterations += newton_report.iterations;
        total.halvings += newton_report.halvings;
        if (newton_report.outcome != NewtonOutcome::converged)
          return failed(newton_report.outcome, "primal problem: " + newton_report.reason);

        const Evaluated here      = evaluate(load, at);
        size                      = here.size;
        total.merit               = std::hypot(size.force, size.constraint);
        const double target_merit = std::max(newton_options.tolerance, size.rounding);
        total.iterates.push_back({counts.iterations, {total.merit, target_merit}, length});
        counts.volume_errors.push_back(here.volume_error);
        for (auto [count, bound] : {std::pair(&counts.to_one_percent, one_percent),
                                    std::pair(&counts.to_hundredth_percent, hundredth_percent)})
          if (*count == 0 && here.volume_error <= bound)
            *count = counts.iterations;
        // Written so that NaN goes on, and fails below.
        if (total.merit <= target_merit)
          {
            state = at.state;
            return total;
          }
        if (counts.iterations == options.max_iterations)
          {
            std::ostringstream why;
            why << "no convergence: volume error " << 100. * here.volume_error << " %";
            return failed(NewtonOutcome::iterations, why.str());
          }

        Vector steepest = here.gradient;
        if (options.metric == DualMetric::mass)
          mass.solve(steepest, here.gradient);
        const double target = std::clamp(
            primal_part * size.constraint, 0.3 * newton_options.tolerance, first_primal_target);
        DualIterate from = at;
        auto        next = directions.next(here.gradient, steepest, from);
        Ascent      ascent;
        if (!respond(load, at, next.direction, ascent) || !(next.slope > 0.))
          {
            directions.restart();
            from = at;
            next = directions.next(here.gradient, steepest, from);
            if (!respond(load, at, next.direction, ascent))
              return failed(NewtonOutcome::stalled,
                            "the primal problem is not a minimum; a larger Augmentation Poisson "
                            "ratio may hold the body");
          }

        DualIterate  trial;
        unsigned int halving = 0;
        length               = next.slope / ascent.curvature;
        for (; halving <= max_halvings; ++halving, length *= 0.5)
          {
            trial = from;
            trial.pressure.add(length, next.direction);
            trial.state.add(length, ascent.response);
            newton_report = primal_after(load, target, interrupted, at, trial);
            if (newton_report.outcome == NewtonOutcome::converged
                || newton_report.outcome == NewtonOutcome::interrupted)
              break;
            total.iterations += newton_report.iterations;
            directions.restart();
            from = at;
          }
        at = std::move(trial);
      }
  }

  template class DualAscent<2>;
  template class DualAscent<3>;
} // namespace isochor
