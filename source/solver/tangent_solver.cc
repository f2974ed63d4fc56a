#include <isochor/solver/tangent_solver.h>

#include <sstream>

namespace isochor
{
  namespace
  {
    // Sought, and still acceptable: Newton corrects what a solve leaves, but a direct solver that
    // leaves more than this has met a singular matrix.
    constexpr double       wanted_residual       = 1e-10;
    constexpr double       acceptable_residual   = 1e-5;
    constexpr unsigned int max_krylov_iterations = 60;

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
                                              const LinearOptions    &options)
    {
      const MPI_Comm communicator = equilibrium.discretisation().communicator();
      auto           solver       = make_direct_solver(options.solver, communicator);
      auto           groups       = eliminated_groups(equilibrium, options.condensation);
      if (dealii::Utilities::MPI::sum(groups.size(), communicator) == 0)
        return solver;
      return std::make_unique<CondensedSolver>(std::move(solver), std::move(groups));
    }
  } // namespace

  template <int dim>
  TangentSolver<dim>::TangentSolver(const Equilibrium<dim> &equilibrium,
                                    const LinearOptions    &options,
                                    Stopwatch              &stopwatch)
    : equilibrium(equilibrium)
    , stopwatch(stopwatch)
    , matrix(equilibrium.make_matrix())
    , factors(make_solver(equilibrium, options))
  {
    const auto scope = stopwatch.measure(Phase::factorisation);
    factors->analyse(
        matrix, equilibrium.discretisation().node_of_row, equilibrium.discretisation().n_nodes);
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::correction(const Vector &state,
                                                           const double  load,
                                                           const Vector &residual,
                                                           Vector       &step)
  {
    Vector rhs(residual), gap(residual);
    rhs *= -1.;
    {
      const auto scope = stopwatch.measure(Phase::assembly);
      state.update_ghost_values();
      equilibrium.tangent(state, load, matrix);
      equilibrium.prescribed().gap(state, load, gap);
      equilibrium.prescribed().apply(matrix, rhs, gap);
      ++counts.assemblies;
    }
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
      if (!factorisation.succeeded)
        return {false, factorisation.failure};
    }
    return solve(rhs, step);
  }

  template <int dim>
  NewtonProblem::Correction TangentSolver<dim>::solve(const Vector &rhs, Vector &step)
  {
    const auto        scope = stopwatch.measure(Phase::solve);
    const LinearSolve outcome
        = checked_solve(matrix, *factors, step, rhs, wanted_residual, max_krylov_iterations);
    counts.krylov_iterations += outcome.krylov_iterations;
    counts.worst_residual = std::max(counts.worst_residual, outcome.relative_residual);
    // Written so that NaN fails.
    if (!(outcome.relative_residual <= acceptable_residual))
      {
        std::ostringstream why;
        why << "the linear solve left a relative residual of " << outcome.relative_residual;
        if (counts.null_pivots > 0)
          why << "; the tangent is singular (" << counts.null_pivots << " null pivots)";
        return {false, why.str()};
      }
    return {true, ""};
  }

  template class TangentSolver<2>;
  template class TangentSolver<3>;
} // namespace isochor
