#include <isochor/algebra/direct_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /// FGMRES keeps two vectors for each iteration until it starts again.
    constexpr unsigned int max_basis = 60;

    /// Vector::l2_norm() stops a Debug program at a NaN, which here is an answer.
    double norm(const Vector &v)
    {
      double sum = 0;
      for (std::size_t i = 0; i < v.locally_owned_size(); ++i)
        sum += v.local_element(i) * v.local_element(i);
      return std::sqrt(dealii::Utilities::MPI::sum(sum, v.get_mpi_communicator()));
    }

    double residual_norm(const SparseMatrix &matrix, const Vector &x, const Vector &b)
    {
      Vector residual(matrix.partitioner());
      matrix.vmult(residual, x);
      for (std::size_t i = 0; i < residual.locally_owned_size(); ++i)
        residual.local_element(i) = b.local_element(i) - residual.local_element(i);
      return norm(residual);
    }

    /// What dealii::SolverFGMRES wants to see of the factors.
    struct Preconditioner
    {
      DirectSolver &factors;

      void vmult(Vector &dst, const Vector &src) const
      {
        factors.solve(dst, src);
        const double size = norm(dst);
        if (!std::isfinite(size))
          throw dealii::SolverControl::NoConvergence(0, size);
      }
    };

    /// If impatient, gives up as soon as the pace says that the iterations allowed will not do.
    class PacedControl : public dealii::SolverControl
    {
    public:
      PacedControl(const unsigned int max_iterations,
                   const double       tolerance,
                   const bool         is_impatient)
        : SolverControl(max_iterations, tolerance, false, false)
        , is_impatient(is_impatient)
      {
      }

      State check(const unsigned int step, const double value) override
      {
        if (step == 0)
          first = value;
        const State state = SolverControl::check(step, value);
        if (state != iterate || step == 0 || !is_impatient)
          return state;
        const double pace     = std::log(value / first) / step;
        const double expected = step + std::log(tolerance() / value) / pace;
        // Written so that NaN fails.
        return pace < 0. && expected <= 1.25 * max_steps() ? iterate : failure;
      }

    private:
      const bool is_impatient;
      double     first = 0;
    };
  } // namespace

  LinearSolve checked_solve(const SparseMatrix &matrix,
                            DirectSolver       &factors,
                            Vector             &x,
                            const Vector       &b,
                            const double        tolerance,
                            const unsigned int  max_iterations,
                            const bool          is_impatient)
  {
    LinearSolve  outcome;
    const double norm_b = norm(b);
    if (norm_b == 0.)
      {
        x                 = 0.;
        outcome.succeeded = true;
        return outcome;
      }

    // Every comparison is written such that a NaN fails.
    outcome.relative_residual = norm_b;
    if (!std::isfinite(norm_b))
      return outcome;
    factors.solve(x, b);
    outcome.relative_residual = residual_norm(matrix, x, b) / norm_b;
    outcome.succeeded         = outcome.relative_residual <= tolerance;
    if (outcome.succeeded || max_iterations == 0 || !std::isfinite(outcome.relative_residual))
      return outcome;

    if (outcome.relative_residual > 1.)
      x = 0.;
    // The residual of the iteration is an estimate, hence a little further than needed.
    PacedControl                 control(max_iterations, .9 * tolerance * norm_b, is_impatient);
    dealii::SolverFGMRES<Vector> fgmres(
        control, dealii::SolverFGMRES<Vector>::AdditionalData(std::min(max_iterations, max_basis)));
    try
      {
        fgmres.solve(matrix, x, b, Preconditioner{factors});
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
