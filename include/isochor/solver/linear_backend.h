#pragma once

// What stands behind a linear solver's name: factors or a preconditioner, with the unknowns that are
// eliminated before, ready to be given matrices of one pattern.

#include <isochor/algebra/condensed_solver.h>
#include <isochor/core/names.h>
#include <isochor/solver/block_data.h>
#include <isochor/solver/nodal_rotations.h>

namespace isochor
{
  enum class LinearSolver
  {
    automatic, ///< kept; block where factors do not fit into memory or do not pay
    kept,      ///< MUMPS in single precision, kept over several Newton iterations
    direct,    ///< MUMPS in double precision, of every tangent
    block,     ///< FGMRES with multigrid and a pressure mass matrix
    umfpack,   ///< LU, of every tangent
    cr,        ///< conjugate residuals without a matrix
    cg         ///< conjugate gradients without a matrix
  };
  inline constexpr auto linear_solver_names
      = name_table<LinearSolver>({{LinearSolver::automatic, "automatic"},
                                  {LinearSolver::kept, "kept"},
                                  {LinearSolver::direct, "direct"},
                                  {LinearSolver::block, "block"},
                                  {LinearSolver::umfpack, "UMFPACK"},
                                  {LinearSolver::cr, "CR"},
                                  {LinearSolver::cg, "CG"}});

  inline bool is_matrix_free(const LinearSolver solver)
  {
    return solver == LinearSolver::cr || solver == LinearSolver::cg;
  }

  /// Which unknowns are eliminated before the linear solver.
  enum class Condensation
  {
    automatic, ///< cells; bubbles alone before the block solver
    none,
    cells,   ///< bubbles and, if kappa is finite, discontinuous pressures, cell by cell
    pressure ///< a continuous pressure with a lumped compliance matrix (equation 37)
  };
  inline constexpr auto condensation_names
      = name_table<Condensation>({{Condensation::automatic, "automatic"},
                                  {Condensation::none, "none"},
                                  {Condensation::cells, "cells"},
                                  {Condensation::pressure, "pressure"}});

  template <int dim>
  class LinearBackend
  {
  public:
    /// @p solver is neither automatic nor matrix-free. Analyses the pattern of @p matrix. @p equilibrium and
    /// @p rotations must outlive this. Collective.
    LinearBackend(const Equilibrium<dim>    &equilibrium,
                  LinearSolver               solver,
                  Condensation               condensation,
                  const NodalRotations<dim> &rotations,
                  const SparseMatrix        &matrix);

    LinearSolver solver() const
    {
      return solver_;
    }
    /// Does it precondition FGMRES, and may it serve several Newton iterations?
    bool is_preconditioner() const
    {
      return solver_ == LinearSolver::kept || solver_ == LinearSolver::block;
    }
    /// For the next factorisation: the tangent is of @p state and scaled. Collective.
    void start(const Vector &state, const SymmetricScaling &scaling);

    DirectSolver &factors()
    {
      return *factors_;
    }

  private:
    LinearSolver                        solver_;
    std::unique_ptr<BodyBlockData<dim>> blocks; ///< of the block solver
    std::unique_ptr<DirectSolver>       factors_;
  };
} // namespace isochor
