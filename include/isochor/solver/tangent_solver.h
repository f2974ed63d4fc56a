#pragma once

// One linearisation of an equilibrium: assemble, apply supports, scale, factor, solve, check.
//
// Kept factors: an LDL^T in single precision of one tangent preconditions FGMRES in double precision
// for this tangent and the next ones, until that takes too many iterations. Where single precision
// does not do (a matrix close to singular), double precision takes over for good.

#include <isochor/core/stopwatch.h>
#include <isochor/solver/linear_backend.h>
#include <isochor/solver/matrix_free.h>
#include <isochor/solver/newton.h>

namespace isochor
{
  /// Which stress the geometric part of Newton's tangent holds.
  enum class NewtonTangent
  {
    predicted, ///< S + dS / dx step of the last iteration (predicted_stress.h)
    consistent ///< of the state: the derivative of the residual
  };
  inline constexpr auto newton_tangent_names = name_table<NewtonTangent>(
      {{NewtonTangent::predicted, "predicted stress"}, {NewtonTangent::consistent, "consistent"}});

  struct LinearOptions
  {
    LinearSolver  solver       = LinearSolver::automatic;
    Condensation  condensation = Condensation::automatic;
    double        memory_limit = 0.; ///< of factors, all ranks, MB; 0: most of what is available
    NewtonTangent tangent      = NewtonTangent::predicted;
  };

  struct LinearStatistics
  {
    unsigned int assemblies        = 0;
    unsigned int factorisations    = 0;
    unsigned int krylov_iterations = 0;
    double       worst_residual    = 0; ///< largest true relative residual of a solve
    /// Negative pivots minus pressure unknowns at the last factorisation: 0 certifies a stable
    /// equilibrium; unknown for LU, block.
    std::optional<long long> pivot_excess;
    std::size_t              null_pivots         = 0; ///< at the last factorisation
    double                   flops               = 0; ///< of one factorisation
    double                   megabytes           = 0; ///< of the factors
    double                   predicted_megabytes = 0; ///< that factors were to need; 0: not known
    bool                     gave_up_single_precision = false;
    std::string note; ///< why the automatic choice is not the usual one; empty if it is
  };

  template <int dim>
  class TangentSolver
  {
  public:
    /// Analyses the pattern. Collective. References must outlive this. Throws UserError if the factors
    /// of a solver asked for by name would not fit into memory.
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

    /// The same where the line search cannot use that step: with new factors of the filtered
    /// tangent; if it was, by absolute curvature, because a projected one may be close to singular.
    /// Refused if that was absolute, or filter_unstable() allows no more. Collective.
    NewtonProblem::Correction filtered_correction(const Vector &state,
                                                  double        load,
                                                  const Vector &residual,
                                                  double        tolerance,
                                                  Vector       &step);

    /// Factor the tangent at @p state for its negative pivots: statistics().pivot_excess, in
    /// double precision wherever single precision shows anything but a stable equilibrium. Not
    /// if it was last factored for a stable state that this one can hardly be told from.
    /// Unknown for LU, block and matrix-free solvers. Collective.
    void certify(const Vector &state, double load);

    /// Where a factorisation shows negative pivots too many, take the filtered tangent instead, in
    /// the next @p times corrections.
    void filter_unstable(const CurvatureFilter new_filter, const unsigned int times)
    {
      filter        = new_filter;
      filtered_left = times;
    }

    /// From now on every tangent goes through @p change before supports are applied; see
    /// dual_ascent.h.
    void change_tangents(std::function<void(SparseMatrix &)> change)
    {
      change_tangent = std::move(change);
    }

    /// Solve the system of the last correction() for another right-hand side, zero at the prescribed
    /// unknowns, with the factors that are there. Collective.
    NewtonProblem::Correction solve_again(const Vector &rhs, double tolerance, Vector &solution);

    /// Solve K adjoint = @p derivative, K the tangent of the equilibrium @p state or one close to it, with
    /// factors that are there or, if they do not do, new ones. @p derivative is a figure's by the
    /// unknowns; its entries at the prescribed ones, where the adjoint is zero, are not looked at. K
    /// is taken to be symmetric, which it is not without a potential (a pressure on a boundary with an
    /// edge, an energy as printed): the adjoint is a weight, not a result. Refused without a matrix.
    /// Collective.
    NewtonProblem::Correction
    adjoint(const Vector &state, double load, Vector derivative, double tolerance, Vector &adjoint);

    const LinearStatistics &statistics() const
    {
      return counts;
    }

  private:
    /// Why @p solver cannot be used, empty if it can.
    std::string use(LinearSolver solver);
    void        choose();
    void        assemble(const Vector                                       &state,
                         double                                              load,
                         const PredictedStress                              *stress,
                         CurvatureFilter                                     filter,
                         const typename PrescribedDisplacements<dim>::Sides &sides);
    /// For a @p state that Newton's last step led to; null for any other.
    std::unique_ptr<PredictedStress> predicted_stress(const Vector &state) const;
    /// One correction on its way.
    struct Linearisation;
    void linearise(Linearisation &at, const PredictedStress *stress, CurvatureFilter which);
    bool solve_all(Linearisation &at); ///< step and, if wanted, rate
    /// By the tangent that @p fallback filters, whatever the pivots; none: see factor_anew().
    NewtonProblem::Correction correct(Linearisation &at, CurvatureFilter fallback);
    /// New factors of the tangent or, where pivots show negative ones too many, of the one without
    /// predicted stress, of the filtered one.
    Factorisation factor_anew(Linearisation &at, bool is_predicted);
    /// By kept factors after the block solver, in double precision after single; why not, or empty.
    std::string   solve_otherwise(Linearisation &at);
    Factorisation factor(const Vector &state);
    /// In double precision, for good, if single precision fails or, where that matters (always if @p
    /// is_final), its pivots are in doubt.
    Factorisation factor_or_use_double(const Vector &state, bool is_final = false);
    /// The tangent at @p state, with ghosts, itself: whatever change_tangents() has asked for.
    Factorisation factor_equilibrium(const Vector &state, double load, bool is_final);
    /// The factors tell the signs of the matrix' pivots from rounding. Collective.
    bool                      pivots_are_sure() const;
    NewtonProblem::Correction matrix_free_correction(const Vector &state,
                                                     double        load,
                                                     const Vector &residual,
                                                     double        tolerance,
                                                     Vector       &step,
                                                     Vector       *rate);
    unsigned int              max_iterations_when_kept(double tolerance) const;
    LinearSolve               solve(const Vector &rhs, double tolerance, Vector &step);
    std::string               complaint(const LinearSolve &outcome) const;
    bool                      is_near_last_linearisation(const Vector &state) const;

    const Equilibrium<dim>             &equilibrium;
    LinearOptions                       options;
    Stopwatch                          &stopwatch;
    SparseMatrix                        matrix;       ///< scaled
    double                              memory_limit; ///< of factors, MB
    SymmetricScaling                    scaling;
    NodalRotations<dim>                 rotations; ///< since the factors
    std::unique_ptr<LinearBackend<dim>> backend;
    double fresh_effort = 0; ///< iterations per digit when the preconditioner was new
    /// FGMRES converges fast enough with the factors of an earlier tangent.
    bool            are_kept          = false;
    bool            is_fresh          = false; ///< the last correction has factored its own tangent
    bool            double_is_refused = false; ///< its factors do not fit into memory
    CurvatureFilter filter            = CurvatureFilter::none;
    unsigned int    filtered_left     = 0;
    CurvatureFilter filtered_by       = CurvatureFilter::none; ///< the last correction's tangent
    Vector          linearised_at, last_step; ///< of the last correction; empty before
    std::function<void(SparseMatrix &)>    change_tangent;
    std::unique_ptr<MatrixFreeSolver<dim>> matrix_free; ///< null: factors
    LinearStatistics                       counts;
  };
} // namespace isochor
