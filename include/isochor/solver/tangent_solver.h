#pragma once

// One linearisation of an equilibrium: assemble, apply supports, factor, solve, check.

#include <isochor/algebra/condensed_solver.h>
#include <isochor/core/stopwatch.h>
#include <isochor/form/equilibrium.h>
#include <isochor/solver/newton.h>

namespace isochor
{
  /// Which unknowns are eliminated before the direct solver.
  enum class Condensation
  {
    automatic, ///< cells
    none,
    cells,   ///< bubbles and, if kappa is finite, discontinuous pressures, cell by cell
    pressure ///< a continuous pressure with a lumped compliance matrix (equation 37)
  };
  inline constexpr auto condensation_names
      = name_table<Condensation>({{Condensation::automatic, "automatic"},
                                  {Condensation::none, "none"},
                                  {Condensation::cells, "cells"},
                                  {Condensation::pressure, "pressure"}});

  struct LinearOptions
  {
    LinearSolver solver       = LinearSolver::mumps;
    Condensation condensation = Condensation::automatic;
  };

  struct LinearStatistics
  {
    unsigned int assemblies        = 0;
    unsigned int factorisations    = 0;
    unsigned int krylov_iterations = 0;
    double       worst_residual    = 0; ///< largest true relative residual of a solve
    /// Negative pivots minus pressure unknowns at the last factorisation: 0 certifies a stable
    /// equilibrium; unknown for LU.
    std::optional<long long> pivot_excess;
    std::size_t              null_pivots = 0; ///< at the last factorisation
    double                   flops       = 0; ///< of one factorisation
    double                   megabytes   = 0; ///< of the factors
  };

  template <int dim>
  class TangentSolver
  {
  public:
    /// Analyses the pattern. Collective. References must outlive this.
    TangentSolver(const Equilibrium<dim> &equilibrium,
                  const LinearOptions    &options,
                  Stopwatch              &stopwatch);

    /// step = Newton's step at @p state: moves the prescribed unknowns to their values at @p load and
    /// solves K step = -residual for the others. Collective.
    NewtonProblem::Correction
    correction(const Vector &state, double load, const Vector &residual, Vector &step);

    const LinearStatistics &statistics() const
    {
      return counts;
    }

  private:
    NewtonProblem::Correction solve(const Vector &rhs, Vector &step);

    const Equilibrium<dim>       &equilibrium;
    Stopwatch                    &stopwatch;
    SparseMatrix                  matrix;
    std::unique_ptr<DirectSolver> factors;
    LinearStatistics              counts;
  };
} // namespace isochor
