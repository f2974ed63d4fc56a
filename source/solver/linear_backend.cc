#include <isochor/solver/linear_backend.h>

namespace isochor
{
  namespace
  {
    using Groups = std::vector<CondensedSolver::Group>;

    /// Groups of owned unknowns to eliminate.
    template <int dim>
    Groups eliminated_groups(const Equilibrium<dim> &equilibrium,
                             const Condensation      condensation,
                             const LinearSolver      solver)
    {
      const Discretisation<dim> &discretisation = equilibrium.discretisation();
      Groups                     groups;
      if (condensation == Condensation::pressure)
        for (LocalIndex i = discretisation.n_owned_displacements;
             i < discretisation.cells.n_owned_unknowns;
             ++i)
          groups.emplace_back(i, 1);
      else if (condensation != Condensation::none)
        {
          groups = discretisation.interior_displacements;
          // Without them the displacements are as stiff as kappa, which multigrid does not stand.
          const bool keeps_pressures
              = condensation == Condensation::automatic && solver == LinearSolver::block;
          if (equilibrium.is_compressible() && !keeps_pressures)
            groups.insert(groups.end(),
                          discretisation.interior_pressures.begin(),
                          discretisation.interior_pressures.end());
        }
      return groups;
    }

    /// Owned unknowns that are left.
    std::vector<LocalIndex> retained_unknowns(const LocalIndex n_owned, const Groups &groups)
    {
      std::vector<char> is_eliminated(n_owned, 0);
      for (const auto &[first, n] : groups)
        std::fill_n(is_eliminated.begin() + first, n, 1);
      std::vector<LocalIndex> retained;
      for (LocalIndex i = 0; i < n_owned; ++i)
        if (!is_eliminated[i])
          retained.push_back(i);
      return retained;
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
  } // namespace

  template <int dim>
  LinearBackend<dim>::LinearBackend(const Equilibrium<dim>    &equilibrium,
                                    const LinearSolver         solver,
                                    const Condensation         condensation,
                                    const NodalRotations<dim> &rotations,
                                    const SparseMatrix        &matrix)
    : solver_(solver)
  {
    const Discretisation<dim> &discretisation = equilibrium.discretisation();
    const MPI_Comm             communicator   = discretisation.communicator();
    Groups                     groups = eliminated_groups(equilibrium, condensation, solver);
    if (solver == LinearSolver::block)
      {
        blocks = std::make_unique<BodyBlockData<dim>>(
            equilibrium, retained_unknowns(discretisation.cells.n_owned_unknowns, groups));
        factors_ = std::make_unique<BlockSolver>(blocks->data());
      }
    else
      factors_ = make_direct_solver(kind_of(solver), communicator);
    if (dealii::Utilities::MPI::sum(groups.size(), communicator) > 0)
      factors_ = std::make_unique<CondensedSolver>(std::move(factors_), std::move(groups));
    if (is_preconditioner())
      factors_ = std::make_unique<TurnedSolver<dim>>(std::move(factors_), rotations);
    factors_->analyse(matrix, discretisation.node_of_row, discretisation.n_nodes);
  }

  template <int dim>
  void LinearBackend<dim>::start(const Vector &state, const SymmetricScaling &scaling)
  {
    if (blocks)
      blocks->update(state, scaling);
  }

  template class LinearBackend<2>;
  template class LinearBackend<3>;
} // namespace isochor
