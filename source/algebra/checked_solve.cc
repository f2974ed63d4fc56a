#include <isochor/algebra/direct_solver.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /// What dealii::SolverFGMRES wants to see of the factors.
    struct Preconditioner
    {
      DirectSolver &factors;

      void vmult(Vector &dst, const Vector &src) const
      {
        factors.solve(dst, src);
      }
    };

    double residual_norm(const SparseMatrix &matrix, const Vector &x, const Vector &b)
    {
      Vector residual(matrix.partitioner());
      matrix.vmult(residual, x);
      residual.sadd(-1., 1., b);
      return residual.l2_norm();
    }
  } // namespace

  LinearSolve checked_solve(const SparseMatrix &matrix,
                            DirectSolver       &factors,
                            Vector             &x,
                            const Vector       &b,
                            const double        tolerance,
                            const unsigned int  max_iterations)
  {
    LinearSolve  outcome;
    const double norm_b = b.l2_norm();
    if (norm_b == 0.)
      {
        x                 = 0.;
        outcome.succeeded = true;
        return outcome;
      }

    // Every comparison is written such that a NaN fails.
    factors.solve(x, b);
    outcome.relative_residual = residual_norm(matrix, x, b) / norm_b;
    outcome.succeeded         = outcome.relative_residual <= tolerance;
    if (outcome.succeeded || max_iterations == 0 || !std::isfinite(outcome.relative_residual))
      return outcome;

    if (outcome.relative_residual > 1.)
      x = 0.;
    // The residual of the iteration is an estimate, hence a little further than needed.
    dealii::SolverControl        control(max_iterations, .9 * tolerance * norm_b, false, false);
    dealii::SolverFGMRES<Vector> fgmres(control);
    try
      {
        fgmres.solve(matrix, x, b, Preconditioner{ factors });
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
      }
    outcome.krylov_iterations = control.last_step();
    outcome.relative_residual = residual_norm(matrix, x, b) / norm_b;
    outcome.succeeded         = outcome.relative_residual <= tolerance;
    return outcome;
  }
} // namespace isochor
