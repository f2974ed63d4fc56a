#include <isochor/form/predicted_stress.h>
#include <isochor/solver/tangent_solver.h>

#include <sstream>

namespace isochor
{
  namespace
  {
    // Newton corrects what a solve leaves, but a direct solver in double precision that leaves more
    // than this has met a singular matrix.
    constexpr double       acceptable_residual   = 1e-5;
    constexpr unsigned int max_krylov_iterations = 60;
    // More, and new factors are cheaper.
    constexpr unsigned int max_krylov_iterations_with_kept_factors = 10;
    constexpr double       rate_tolerance                          = 1e-6;

    /// Groups of owned unknowns to eliminate.
    template <int dim>
    std::vector<CondensedSolver::Group> eliminated_groups(const Equilibrium<dim> &equilibrium,
                                                          const Condensation      condensation)
    {
      const Discretisation<dim>          &discretisation = equilibrium.discretisation();
      std::vector<CondensedSolver::Group> groups;
      if (condensation == Condensation::pressure)
        for (LocalIndex i = discretisation.n_owned_displacements;
             i < discretisation.cells.n_owned_unknowns;
             ++i)
          groups.emplace_back(i, 1);
      else if (condensation != Condensation::none)
        {
          groups = discretisation.interior_displacements;
          if (equilibrium.is_compressible())
            groups.insert(groups.end(),
                          discretisation.interior_pressures.begin(),
                          discretisation.interior_pressures.end());
        }
      return groups;
    }

    template <int dim>
    std::unique_ptr<DirectSolver> make_solver(const Equilibrium<dim> &equilibrium,
                                              const DirectKind        kind,
                                              const Condensation      condensation)
    {
      const MPI_Comm communicator = equilibrium.discretisation().communicator();
      auto           solver       = make_direct_solver(kind, communicator);
      auto           groups       = eliminated_groups(equilibrium, condensation);
      if (dealii::Utilities::MPI::sum(groups.size(), communicator) == 0)
        return solver;
      return std::make_unique<CondensedSolver>(std::move(solver), std::move(groups));
    }

    DirectKind kind_of(const LinearSolver solver)
    {
      switch (solver)
        {
          case LinearSolver::direct:
            return DirectKind::mumps;
          case LinearSolver::umfpack:
            return DirectKind::umfpack;
          default:
            return DirectKind::single_mumps;
        }
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
  TangentSolver<dim>::TangentSolver(const Equilibrium<dim> &equilibrium,
                                    const LinearOptions    &options,
                                    Stopwatch              &stopwatch)
    : equilibrium(equilibrium)
    , options(options)
    , stopwatch(stopwatch)
    , matrix(equilibrium.make_matrix())
    , rotations(equilibrium.discretisation(), equilibrium.prescribed())
  {
    use(kind_of(options.solver));
  }

  template <int dim>
  void TangentSolver<dim>::use(const DirectKind new_kind)
  {
    const auto scope = stopwatch.measure(Phase::factorisation);
    are_kept         = false;
    kind             = new_kind;
    factors          = make_solver(equilibrium, kind, options.condensation);
    if (kind == DirectKind::single_mumps)
      factors = std::make_unique<TurnedSolver<dim>>(std::move(factors), rotations);
    factors->analyse(
        matrix, equilibrium.discretisation().node_of_row, equilibrium.discretisation().n_nodes);
  }

  template <int dim>
  void TangentSolver<dim>::assemble(const Vector                                       &state,
                                    const double                                        load,
                                    const PredictedStress                              *stress,
                                    const CurvatureFilter                               filter,
                                    const typename PrescribedDisplacements<dim>::Sides &sides)
  {
    const auto scope = stopwatch.measure(Phase::assembly);
    equilibrium.tangent(state, load, matrix, stress, filter);
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
    if (last_step.size() == 0 || equilibrium.is_linear())
      return {};
    Vector change(state);
    change -= linearised_at;
    const double length = (change * last_step) / last_step.norm_sqr();
    Vector       rest(change);
    rest.add(-length, last_step);
    // Written so that NaN gives none.
    if (!(length > 0. && length < 1. + 1e-6 && rest.l2_norm() <= 1e-6 * change.l2_norm()))
      return {};
    return equilibrium.predict_stress(linearised_at, change);
  }

  template <int dim>
  Factorisation TangentSolver<dim>::factor()
  {
    const auto          scope         = stopwatch.measure(Phase::factorisation);
    const Factorisation factorisation = factors->factor(matrix);
    ++counts.factorisations;
    counts.flops       = factorisation.flops;
    counts.megabytes   = factorisation.megabytes;
    counts.null_pivots = factorisation.null_pivots;
    counts.pivot_excess.reset();
    if (factorisation.negative_pivots)
      counts.pivot_excess = static_cast<long long>(*factorisation.negative_pivots)
                            - static_cast<long long>(equilibrium.discretisation().n_pressures);
    return factorisation;
  }

  template <int dim>
  Factorisation TangentSolver<dim>::factor_or_use_double()
  {
    const Factorisation factorisation = factor();
    if (factorisation.succeeded || kind != DirectKind::single_mumps)
      return factorisation;
    counts.gave_up_single_precision = true;
    use(DirectKind::mumps);
    return factor();
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::correction(const Vector &state,
                                                           const double  load,
                                                           const Vector &residual,
                                                           const double  tolerance,
                                                           Vector       &step,
                                                           Vector       *rate)
  {
    Vector rhs(residual), gap(residual), rate_rhs, rate_gap;
    if (rate != nullptr)
      {
        rate_rhs.reinit(residual);
        rate_gap.reinit(residual);
      }
    const auto linearise = [&](const PredictedStress *stress, const CurvatureFilter filter) {
      rhs.equ(-1., residual);
      equilibrium.prescribed().gap(state, load, gap);
      typename PrescribedDisplacements<dim>::Sides sides{{&rhs, &gap}};
      if (rate != nullptr)
        {
          load_rates(equilibrium, state, load, rate_rhs, rate_gap);
          sides.emplace_back(&rate_rhs, &rate_gap);
        }
      assemble(state, load, stress, filter, sides);
    };
    state.update_ghost_values();
    const auto stress = predicted_stress(state);
    linearise(stress.get(), CurvatureFilter::none);

    LinearSolve outcome;
    const auto  solve_all = [&]() {
      outcome = solve(rhs, tolerance, step);
      if (outcome.succeeded && rate != nullptr)
        outcome = solve(rate_rhs, std::min(tolerance, rate_tolerance), *rate);
      return outcome.succeeded;
    };

    if (are_kept)
      {
        const auto scope = stopwatch.measure(Phase::solve);
        rotations.update(state);
      }
    bool is_solved = are_kept && solve_all(), is_filtered = false;
    is_fresh = !is_solved;
    if (!is_solved)
      {
        are_kept = false;
        rotations.start(state);
        Factorisation factorisation = factor_or_use_double();
        if (stress && counts.pivot_excess.value_or(0) > 0)
          {
            // Far from a solution the prediction may be one of compression.
            linearise(nullptr, CurvatureFilter::none);
            factorisation = factor_or_use_double();
          }
        if (filter != CurvatureFilter::none && filtered_left > 0
            && counts.pivot_excess.value_or(0) > 0)
          {
            is_filtered = true;
            --filtered_left;
            const auto excess = counts.pivot_excess;
            linearise(nullptr, filter);
            factorisation       = factor_or_use_double();
            counts.pivot_excess = excess;
          }
        if (!factorisation.succeeded)
          return {false, factorisation.failure};
        is_solved = solve_all();
        if (!is_solved && kind == DirectKind::single_mumps)
          {
            counts.gave_up_single_precision = true;
            use(DirectKind::mumps);
            if (const Factorisation again = factor(); !again.succeeded)
              return {false, again.failure};
            is_solved = solve_all();
          }
      }
    are_kept = is_solved && !is_filtered && kind == DirectKind::single_mumps
               && outcome.krylov_iterations <= max_krylov_iterations_with_kept_factors;
    if (!is_solved)
      return {false, complaint(outcome)};
    scaling.apply(step);
    if (rate != nullptr)
      scaling.apply(*rate);
    linearised_at = state;
    last_step     = step;
    return {true, ""};
  }

  template <int dim>
  LinearSolve TangentSolver<dim>::solve(const Vector &rhs, const double tolerance, Vector &step)
  {
    const auto  scope = stopwatch.measure(Phase::solve);
    LinearSolve outcome
        = checked_solve(matrix,
                        *factors,
                        step,
                        rhs,
                        tolerance,
                        are_kept ? max_krylov_iterations_with_kept_factors : max_krylov_iterations);
    counts.krylov_iterations += outcome.krylov_iterations;
    if (kind != DirectKind::single_mumps)
      outcome.succeeded |= outcome.relative_residual <= acceptable_residual; // NaN fails
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
    return why.str();
  }

  template <int dim>
  bool TangentSolver<dim>::is_near_last_linearisation(const Vector &state) const
  {
    // Displacements and pressures have different units.
    double     sums[4] = {};
    const auto n_u     = equilibrium.discretisation().n_owned_displacements;
    for (LocalIndex i = 0; i < state.locally_owned_size(); ++i)
      {
        double *sum = &sums[i < n_u ? 0 : 2];
        sum[0] += std::pow(state.local_element(i) - linearised_at.local_element(i), 2);
        sum[1] += std::pow(state.local_element(i), 2);
      }
    dealii::Utilities::MPI::sum(sums, state.get_mpi_communicator(), sums);
    constexpr double near = 1e-4;
    return sums[0] <= near * near * sums[1] && sums[2] <= near * near * sums[3];
  }

  template <int dim>
  void TangentSolver<dim>::certify(const Vector &state, const double load)
  {
    if (kind == DirectKind::umfpack)
      return;
    state.update_ghost_values();
    if (is_fresh && counts.pivot_excess == 0 && is_near_last_linearisation(state))
      return;
    are_kept = false;
    assemble(state, load, nullptr, CurvatureFilter::none, {});
    rotations.start(state);
    are_kept = factor_or_use_double().succeeded && kind == DirectKind::single_mumps;
    if (kind == DirectKind::single_mumps && counts.pivot_excess != 0)
      {
        auto single = std::move(factors);
        use(DirectKind::mumps);
        factor();
        factors  = std::move(single);
        kind     = DirectKind::single_mumps;
        are_kept = true;
      }
    is_fresh = false;
  }

  template class TangentSolver<2>;
  template class TangentSolver<3>;
} // namespace isochor
