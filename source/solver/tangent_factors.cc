// Which linear solver serves, its factors, and what their pivots certify.

#include <isochor/core/error.h>
#include <isochor/core/memory.h>
#include <isochor/solver/tangent_solver.h>

#include <cstdint>
#include <iomanip>
#include <sstream>
#include <utility>

namespace isochor
{
  namespace
  {
    // Of the memory that is available, for factors that nobody limits.
    constexpr double usable_share = 0.8;
    // Operations of a factorisation per entry of the matrix above which the block solver takes over. At
    // rest its linear algebra took as long as that of kept factors at 1e4 to 4e4 (P1-P1s with 27,000
    // unknowns, P2-P1 with 90,000; AVX-512); far from equilibrium it is slower and it counts no pivots,
    // hence the margin.
    constexpr double worthwhile_flops = 6e4;
    // What a solve with factors in single precision may leave of a right-hand side of random signs, if
    // their pivots are to have the signs of the matrix'. Measured: 0.001 to 0.04 of P1-P1 on a beam,
    // whose pivots are right; more than 0.05 of P2 from nu = 0.498 on and 0.3 to 40 at 0.4999, whose
    // pivots show modes that are not there.
    constexpr double sure_residual = 0.05;
  } // namespace

  template <int dim>
  TangentSolver<dim>::TangentSolver(const Equilibrium<dim> &equilibrium,
                                    const LinearOptions    &options,
                                    Stopwatch              &stopwatch)
    : equilibrium(equilibrium)
    , options(options)
    , stopwatch(stopwatch)
    , memory_limit(options.memory_limit > 0
                       ? options.memory_limit
                       : usable_share
                             * available_megabytes(equilibrium.discretisation().communicator()))
    , rotations(equilibrium.discretisation(), equilibrium.prescribed())
  {
    if (is_matrix_free(options.solver))
      {
        matrix_free = std::make_unique<MatrixFreeSolver<dim>>(
            equilibrium,
            options.solver == LinearSolver::cr ? KrylovMethod::conjugate_residuals
                                               : KrylovMethod::conjugate_gradients);
        return;
      }
    matrix = equilibrium.make_matrix();
    if (options.solver == LinearSolver::automatic)
      choose();
    else if (const std::string refusal = use(options.solver); !refusal.empty())
      throw UserError("Method/Memory limit: " + refusal
                      + "; choose Method/Linear solver = block or automatic, a coarser mesh, or a "
                        "higher limit");
  }

  template <int dim>
  void TangentSolver<dim>::choose()
  {
    counts.note = use(LinearSolver::kept);
    if (counts.note.empty() && equilibrium.discretisation().element.is_stable
        && options.condensation != Condensation::pressure)
      {
        const double entries = dealii::Utilities::MPI::sum(
            double(matrix.columns().size()), equilibrium.discretisation().communicator());
        const double flops = backend->factors().predicted_flops();
        if (flops > worthwhile_flops * entries)
          {
            std::ostringstream note;
            note << "factors would take " << std::setprecision(3) << flops / 1e9 << " GFlop and "
                 << counts.predicted_megabytes << " MB";
            counts.note = note.str();
          }
      }
    if (counts.note.empty())
      return;
    use(LinearSolver::block);
    counts.note += ": the block solver is used, which does not count negative pivots";
  }

  template <int dim>
  std::string TangentSolver<dim>::use(const LinearSolver solver)
  {
    const auto scope = stopwatch.measure(Phase::factorisation);
    are_kept         = false;
    backend.reset(); // its memory goes before the new one's comes
    backend = std::make_unique<LinearBackend<dim>>(
        equilibrium, solver, options.condensation, rotations, matrix);
    const double megabytes = backend->factors().predicted_megabytes();
    if (megabytes > 0.)
      counts.predicted_megabytes = megabytes;
    if (megabytes <= memory_limit)
      return "";
    double_is_refused = double_is_refused || solver == LinearSolver::direct;
    std::ostringstream why;
    why << "factors would take " << megabytes << " MB, the memory limit is " << std::setprecision(4)
        << memory_limit << " MB";
    return why.str();
  }

  template <int dim>
  Factorisation TangentSolver<dim>::factor(const Vector &state)
  {
    const auto scope = stopwatch.measure(Phase::factorisation);
    backend->start(state, scaling);
    const Factorisation factorisation = backend->factors().factor(matrix);
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
  bool TangentSolver<dim>::pivots_are_sure() const
  {
    Vector signs(matrix.partitioner()), solution(signs);
    for (LocalIndex i = 0; i < signs.locally_owned_size(); ++i)
      {
        const std::uint64_t mixed = (signs.get_partitioner()->local_to_global(i) + 1)
                                    * std::uint64_t(0x9E3779B97F4A7C15); // the golden ratio's
        signs.local_element(i) = mixed >> 63 ? 1. : -1.;
      }
    return checked_solve(matrix, backend->factors(), solution, signs, sure_residual, 0).succeeded;
  }

  template <int dim>
  Factorisation TangentSolver<dim>::factor_or_use_double(const Vector &state, const bool is_final)
  {
    Factorisation factorisation = factor(state);
    if (backend->solver() != LinearSolver::kept)
      return factorisation;
    // Rounding is a matter of the element and the Poisson ratio, so that a first look tells.
    const bool matters = is_final || counts.factorisations == 1 || counts.pivot_excess != 0;
    if (factorisation.succeeded && (!matters || pivots_are_sure()))
      return factorisation;

    if (factorisation.succeeded && double_is_refused)
      {
        counts.pivot_excess.reset();
        return factorisation;
      }
    counts.gave_up_single_precision = true;
    const std::string refusal       = use(LinearSolver::direct);
    if (refusal.empty())
      return factor(state);
    if (!factorisation.succeeded)
      {
        Factorisation refused;
        refused.failure = factorisation.failure + "; in double precision, " + refusal;
        return refused;
      }
    use(LinearSolver::kept);
    factorisation = factor(state);
    counts.pivot_excess.reset();
    return factorisation;
  }

  template <int dim>
  Factorisation TangentSolver<dim>::factor_equilibrium(const Vector &state,
                                                       const double  load,
                                                       const bool    is_final)
  {
    are_kept          = false;
    const auto change = std::exchange(change_tangent, {});
    assemble(state, load, nullptr, CurvatureFilter::none, {});
    change_tangent = change;
    rotations.start(state);
    return factor_or_use_double(state, is_final);
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
    if (matrix_free || backend->solver() == LinearSolver::umfpack
        || backend->solver() == LinearSolver::block)
      return;
    state.update_ghost_values();
    if (is_fresh && !change_tangent && counts.pivot_excess == 0
        && is_near_last_linearisation(state))
      return;
    are_kept = factor_equilibrium(state, load, true).succeeded && backend->is_preconditioner();
    if (backend->solver() == LinearSolver::kept && counts.pivot_excess != 0 && !double_is_refused)
      {
        // Those in double precision take at most twice as much; where both together are too much,
        // they come in the place of the others.
        std::unique_ptr<LinearBackend<dim>> single;
        if (3. * counts.megabytes <= memory_limit)
          single = std::move(backend);
        if (use(LinearSolver::direct).empty())
          factor(state);
        are_kept = single != nullptr;
        if (single)
          backend = std::move(single);
        else
          use(LinearSolver::kept);
      }
    are_kept = are_kept && !change_tangent;
    is_fresh = false;
  }

  template class TangentSolver<2>;
  template class TangentSolver<3>;
} // namespace isochor
