#include <isochor/form/predicted_stress.h>
#include <isochor/solver/tangent_solver.h>

#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    // Newton corrects what a solve leaves, but a direct solver in double precision that leaves more
    // than this has met a singular matrix.
    constexpr double acceptable_residual = 1e-5;
    // Far from equilibrium the tangent has negative eigenvalues, on which the block solver stagnates
    // at some per cent: still a step of inexact Newton.
    constexpr double acceptable_block_residual = 0.1;
    // More, and new factors are cheaper: an iteration took 6 to 9 % of a factorisation (P1-P1, 4,000
    // and 24,000 unknowns).
    constexpr unsigned int max_iterations_with_kept_factors = 6;
    // The same of a kept block preconditioner, against the iterations per digit when it was new.
    constexpr double worth_keeping  = 1.5;
    constexpr double rate_tolerance = 1e-6;
    // Of a linear problem, which is to take one iteration with factors.
    constexpr double smallest_matrix_free_tolerance = 1e-10;

    unsigned int max_iterations(const LinearSolver solver)
    {
      return solver == LinearSolver::block ? 150 : 60;
    }

    /// Iterations per digit.
    double effort(const LinearSolve &outcome)
    {
      return outcome.krylov_iterations / std::max(1., -std::log10(outcome.relative_residual));
    }

    /// -d(residual) / d(load) and the rate of the prescribed unknowns. Loads are affine in the load
    /// factor, so that the difference is exact; prescribed formulas may not be.
    template <int dim>
    void load_rates(const Equilibrium<dim> &equilibrium,
                    const Vector           &state,
                    const double            load,
                    Vector                 &rhs,
                    Vector                 &gap)
    {
      constexpr double h = 1e-4;
      Vector           before(rhs);
      equilibrium.residual(state, load - h, rhs);
      equilibrium.residual(state, load + h, before);
      rhs -= before;
      rhs *= 1. / (2. * h);
      equilibrium.prescribed().gap(state, load + h, gap);
      equilibrium.prescribed().gap(state, load - h, before);
      gap -= before;
      gap *= 1. / (2. * h);
      gap.update_ghost_values();
    }
  } // namespace

  template <int dim>
  void TangentSolver<dim>::assemble(const Vector                                       &state,
                                    const double                                        load,
                                    const PredictedStress                              *stress,
                                    const CurvatureFilter                               filter,
                                    const typename PrescribedDisplacements<dim>::Sides &sides)
  {
    const auto scope = stopwatch.measure(Phase::assembly);
    equilibrium.tangent(state, load, matrix, stress, filter);
    if (change_tangent)
      change_tangent(matrix);
    equilibrium.prescribed().apply(matrix, sides);
    if (!are_kept)
      scaling.compute(matrix, equilibrium.discretisation().n_owned_displacements, dim);
    scaling.apply(matrix);
    for (const auto &side : sides)
      scaling.apply(*side.first);
    ++counts.assemblies;
  }

  template <int dim>
  std::unique_ptr<PredictedStress> TangentSolver<dim>::predicted_stress(const Vector &state) const
  {
    if (options.tangent == NewtonTangent::consistent || last_step.size() == 0
        || equilibrium.is_linear())
      return {};
    Vector change(state);
    change -= linearised_at;
    const double length = (change * last_step) / last_step.norm_sqr();
    // Written so that NaN gives none.
    if (!(length > 0. && length < 1. + 1e-6))
      return {};
    Vector rest(change);
    rest.add(-length, last_step);
    if (!(rest.l2_norm() <= 1e-6 * change.l2_norm()))
      return {};
    return equilibrium.predict_stress(linearised_at, change);
  }

  template <int dim>
  struct TangentSolver<dim>::Linearisation
  {
    const Vector &state;
    double        load;
    const Vector &residual;
    double        tolerance;
    Vector       &step, *rate; ///< to be found; no rate: null
    Vector        rhs, gap, rate_rhs, rate_gap;
    LinearSolve   outcome;
  };

  template <int dim>
  void TangentSolver<dim>::linearise(Linearisation         &at,
                                     const PredictedStress *stress,
                                     const CurvatureFilter  which)
  {
    at.rhs.equ(-1., at.residual);
    equilibrium.prescribed().gap(at.state, at.load, at.gap);
    typename PrescribedDisplacements<dim>::Sides sides{{&at.rhs, &at.gap}};
    if (at.rate != nullptr)
      {
        load_rates(equilibrium, at.state, at.load, at.rate_rhs, at.rate_gap);
        sides.emplace_back(&at.rate_rhs, &at.rate_gap);
      }
    assemble(at.state, at.load, stress, which, sides);
  }

  template <int dim>
  bool TangentSolver<dim>::solve_all(Linearisation &at)
  {
    at.outcome = solve(at.rhs, at.tolerance, at.step);
    if (at.outcome.succeeded && at.rate != nullptr)
      at.outcome = solve(at.rate_rhs, std::min(at.tolerance, rate_tolerance), *at.rate);
    return at.outcome.succeeded;
  }

  template <int dim>
  Factorisation TangentSolver<dim>::factor_anew(Linearisation &at, const bool is_predicted)
  {
    are_kept                 = false;
    const auto excess_before = counts.pivot_excess;
    rotations.start(at.state);
    Factorisation factorisation = factor_or_use_double(at.state);
    if (filtered_by != CurvatureFilter::none)
      {
        // The filtered tangent says nothing of the state.
        counts.pivot_excess = excess_before;
        return factorisation;
      }
    if (is_predicted && counts.pivot_excess.value_or(0) > 0)
      {
        // Far from a solution the prediction may be one of compression.
        linearise(at, nullptr, CurvatureFilter::none);
        factorisation = factor_or_use_double(at.state);
      }
    const auto excess = counts.pivot_excess;
    if (filter != CurvatureFilter::none && filtered_left > 0 && excess.value_or(0) > 0)
      {
        filtered_by = filter;
        --filtered_left;
        linearise(at, nullptr, filter);
        factorisation       = factor_or_use_double(at.state);
        counts.pivot_excess = excess;
      }
    return factorisation;
  }

  template <int dim>
  std::string TangentSolver<dim>::solve_otherwise(Linearisation &at)
  {
    if (backend->solver() == LinearSolver::block && options.solver == LinearSolver::automatic
        && counts.predicted_megabytes <= memory_limit)
      {
        counts.note.clear();
        use(LinearSolver::kept);
        if (const Factorisation kept = factor_or_use_double(at.state); !kept.succeeded)
          return kept.failure;
        if (solve_all(at))
          return "";
      }
    if (backend->solver() == LinearSolver::kept)
      {
        counts.gave_up_single_precision = true;
        if (const std::string refusal = use(LinearSolver::direct); !refusal.empty())
          return refusal;
        if (const Factorisation direct = factor(at.state); !direct.succeeded)
          return direct.failure;
        if (solve_all(at))
          return "";
      }
    return complaint(at.outcome);
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::correction(const Vector &state,
                                                           const double  load,
                                                           const Vector &residual,
                                                           const double  tolerance,
                                                           Vector       &step,
                                                           Vector       *rate)
  {
    if (matrix_free)
      return matrix_free_correction(state, load, residual, tolerance, step, rate);
    const Vector  none = rate == nullptr ? Vector() : Vector(residual.get_partitioner());
    Linearisation at{
        state, load, residual, tolerance, step, rate, residual, residual, none, none, {}};
    return correct(at, CurvatureFilter::none);
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::correct(Linearisation        &at,
                                                        const CurvatureFilter fallback)
  {
    at.state.update_ghost_values();
    const bool is_fallback = fallback != CurvatureFilter::none;
    const auto stress      = is_fallback ? nullptr : predicted_stress(at.state);
    filtered_by            = fallback;
    are_kept               = are_kept && !is_fallback;
    linearise(at, stress.get(), fallback);

    if (are_kept)
      {
        const auto scope = stopwatch.measure(Phase::solve);
        rotations.update(at.state);
      }
    const bool kept_do = are_kept && solve_all(at);
    is_fresh           = !kept_do && !is_fallback;
    if (!kept_do)
      {
        if (const Factorisation fresh = factor_anew(at, stress != nullptr); !fresh.succeeded)
          return {false, fresh.failure};
        if (!solve_all(at))
          if (const std::string failure = solve_otherwise(at); !failure.empty())
            return {false, failure};
        fresh_effort = effort(at.outcome);
      }
    are_kept = filtered_by == CurvatureFilter::none && backend->is_preconditioner()
               && at.outcome.krylov_iterations <= max_iterations_when_kept(at.tolerance);
    scaling.apply(at.step);
    if (at.rate != nullptr)
      scaling.apply(*at.rate);
    linearised_at = at.state;
    last_step     = at.step;
    return {true, "", filtered_by != CurvatureFilter::none};
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::filtered_correction(const Vector &state,
                                                                    const double  load,
                                                                    const Vector &residual,
                                                                    const double  tolerance,
                                                                    Vector       &step)
  {
    if (matrix_free || filter == CurvatureFilter::none || filtered_left == 0
        || filtered_by == CurvatureFilter::absolute)
      return {false, "no other tangent"};
    --filtered_left;
    Linearisation at{
        state, load, residual, tolerance, step, nullptr, residual, residual, {}, {}, {}};
    return correct(at, filtered_by == CurvatureFilter::none ? filter : CurvatureFilter::absolute);
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::matrix_free_correction(const Vector &state,
                                                                       const double  load,
                                                                       const Vector &residual,
                                                                       const double  tolerance,
                                                                       Vector       &step,
                                                                       Vector       *rate)
  {
    Vector rhs(residual), gap(residual);
    rhs *= -1.;
    equilibrium.prescribed().gap(state, load, gap);
    const auto solve_one = [&](const double accuracy, Vector &solution) {
      const auto        scope   = stopwatch.measure(Phase::solve);
      const KrylovSolve outcome = matrix_free->solve(state, load, rhs, gap, accuracy, solution);
      counts.krylov_iterations += outcome.iterations;
      if (outcome.succeeded)
        counts.worst_residual = std::max(counts.worst_residual, outcome.relative_residual);
      return outcome;
    };
    KrylovSolve outcome = solve_one(std::max(tolerance, smallest_matrix_free_tolerance), step);
    if (outcome.succeeded && rate != nullptr)
      {
        load_rates(equilibrium, state, load, rhs, gap);
        outcome = solve_one(std::min(tolerance, rate_tolerance), *rate);
      }
    return {outcome.succeeded, outcome.failure};
  }

  template <int dim>
  NewtonProblem::Correction
  TangentSolver<dim>::solve_again(const Vector &rhs, const double tolerance, Vector &solution)
  {
    Vector scaled(rhs);
    scaling.apply(scaled);
    const LinearSolve outcome = solve(scaled, tolerance, solution);
    if (!outcome.succeeded)
      return {false, complaint(outcome)};
    scaling.apply(solution);
    return {true, ""};
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::adjoint(const Vector &state,
                                                        const double  load,
                                                        Vector        derivative,
                                                        const double  tolerance,
                                                        Vector       &adjoint)
  {
    if (matrix_free)
      return {false, "there is no matrix"};
    equilibrium.prescribed().set_zero(derivative);
    const bool has_factors
        = linearised_at.size() > 0 && (are_kept || !backend->is_preconditioner());
    if (has_factors && filtered_by == CurvatureFilter::none && !change_tangent)
      if (const auto solved = solve_again(derivative, tolerance, adjoint); solved.succeeded)
        return solved;
    state.update_ghost_values();
    if (const auto fresh = factor_equilibrium(state, load, false); !fresh.succeeded)
      return {false, fresh.failure};
    return solve_again(derivative, tolerance, adjoint);
  }

  template <int dim>
  unsigned int TangentSolver<dim>::max_iterations_when_kept(const double tolerance) const
  {
    if (backend->solver() == LinearSolver::kept)
      return max_iterations_with_kept_factors;
    return 5
           + static_cast<unsigned int>(worth_keeping * fresh_effort
                                       * std::max(1., -std::log10(tolerance)));
  }

  template <int dim>
  LinearSolve TangentSolver<dim>::solve(const Vector &rhs, const double tolerance, Vector &step)
  {
    const auto  scope   = stopwatch.measure(Phase::solve);
    LinearSolve outcome = checked_solve(matrix,
                                        backend->factors(),
                                        step,
                                        rhs,
                                        tolerance,
                                        are_kept ? max_iterations_when_kept(tolerance)
                                                 : max_iterations(backend->solver()),
                                        are_kept && backend->solver() == LinearSolver::kept);
    counts.krylov_iterations += outcome.krylov_iterations;
    // Written so that NaN fails.
    if (backend->solver() == LinearSolver::block)
      outcome.succeeded |= !are_kept && outcome.relative_residual <= acceptable_block_residual;
    else if (backend->solver() != LinearSolver::kept)
      outcome.succeeded |= outcome.relative_residual <= acceptable_residual;
    if (outcome.succeeded)
      counts.worst_residual = std::max(counts.worst_residual, outcome.relative_residual);
    return outcome;
  }

  template <int dim>
  std::string TangentSolver<dim>::complaint(const LinearSolve &outcome) const
  {
    std::ostringstream why;
    why << "the linear solve left a relative residual of " << outcome.relative_residual;
    if (counts.null_pivots > 0)
      why << "; the tangent is singular (" << counts.null_pivots << " null pivots)";
    if (backend->solver() == LinearSolver::block)
      why << " after " << outcome.krylov_iterations
          << " iterations with the block preconditioner, which suits stable mixed elements, and "
             "displacement elements far from a Poisson ratio of 0.5, on the way to a stable "
             "equilibrium; choose Method/Linear solver = kept or direct, or a stable element";
    return why.str();
  }

  template class TangentSolver<2>;
  template class TangentSolver<3>;
} // namespace isochor
