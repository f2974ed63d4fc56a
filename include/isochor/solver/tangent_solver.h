#pragma once

// One linearisation of an equilibrium: assemble, apply supports, scale, factor, solve, check.
//
// Kept factors: an LDL^T in single precision of one tangent preconditions FGMRES in double precision
// for this tangent and the next ones, until that takes too many iterations. Where single precision
// does not do (a matrix close to singular), double precision takes over for good.

#include <isochor/algebra/condensed_solver.h>
#include <isochor/algebra/symmetric_scaling.h>
#include <isochor/core/names.h>
#include <isochor/core/stopwatch.h>
#include <isochor/form/equilibrium.h>
#include <isochor/solver/newton.h>
#include <isochor/solver/nodal_rotations.h>

namespace isochor
{
  enum class LinearSolver
  {
    automatic, ///< kept
    kept,      ///< MUMPS in single precision, kept over several Newton iterations
    direct,    ///< MUMPS in double precision, of every tangent
    umfpack    ///< LU, of every tangent
  };
  inline constexpr auto linear_solver_names
      = name_table<LinearSolver>({{LinearSolver::automatic, "automatic"},
                                  {LinearSolver::kept, "kept"},
                                  {LinearSolver::direct, "direct"},
                                  {LinearSolver::umfpack, "UMFPACK"}});

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
    LinearSolver solver       = LinearSolver::automatic;
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
    std::size_t              null_pivots              = 0; ///< at the last factorisation
    double                   flops                    = 0; ///< of one factorisation
    double                   megabytes                = 0; ///< of the factors
    bool                     gave_up_single_precision = false;
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
    /// solves K step = -residual for the others, to a relative residual of @p tolerance.
    ///
    /// @p rate, if given: d(state) / d(load) along the path of equilibria, from K rate =
    /// -d(residual) / d(load) with the rates of the prescribed unknowns. Collective.
    NewtonProblem::Correction correction(const Vector &state,
                                         double        load,
                                         const Vector &residual,
                                         double        tolerance,
                                         Vector       &step,
                                         Vector       *rate = nullptr);

    /// Factor the tangent at @p state for its negative pivots: statistics().pivot_excess, in
    /// double precision wherever single precision shows anything but a stable equilibrium. Not
    /// if it was last factored for a stable state that this one can hardly be told from.
    /// Unknown for LU. Collective.
    void certify(const Vector &state, double load);

    /// Where a factorisation shows negative pivots too many, take the filtered tangent instead, in
    /// the next @p times corrections.
    void filter_unstable(const CurvatureFilter new_filter, const unsigned int times)
    {
      filter        = new_filter;
      filtered_left = times;
    }

    const LinearStatistics &statistics() const
    {
      return counts;
    }

  private:
    void use(DirectKind kind);
    void assemble(const Vector                                       &state,
                  double                                              load,
                  const PredictedStress                              *stress,
                  CurvatureFilter                                     filter,
                  const typename PrescribedDisplacements<dim>::Sides &sides);
    /// For a @p state that Newton's last step led to; null for any other.
    std::unique_ptr<PredictedStress> predicted_stress(const Vector &state) const;
    Factorisation                    factor();
    Factorisation                    factor_or_use_double();
    LinearSolve                      solve(const Vector &rhs, double tolerance, Vector &step);
    std::string                      complaint(const LinearSolve &outcome) const;
    bool                             is_near_last_linearisation(const Vector &state) const;

    const Equilibrium<dim>       &equilibrium;
    LinearOptions                 options;
    Stopwatch                    &stopwatch;
    SparseMatrix                  matrix; ///< scaled
    SymmetricScaling              scaling;
    NodalRotations<dim>           rotations; ///< since the factors
    std::unique_ptr<DirectSolver> factors;
    DirectKind                    kind = DirectKind::mumps;
    /// FGMRES converges fast enough with the factors of an earlier tangent.
    bool             are_kept      = false;
    bool             is_fresh      = false; ///< the last correction has factored its own tangent
    CurvatureFilter  filter        = CurvatureFilter::none;
    unsigned int     filtered_left = 0;
    Vector           linearised_at, last_step; ///< of the last correction; empty before
    LinearStatistics counts;
  };
} // namespace isochor
