#include <isochor/algebra/symmetric_krylov.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace isochor
{
  namespace
  {
    /// a . b; Vector's own stops a Debug program at a NaN, which here is an answer.
    double dot(const Vector &a, const Vector &b)
    {
      double sum = 0;
      for (LocalIndex i = 0; i < a.locally_owned_size(); ++i)
        sum += a.local_element(i) * b.local_element(i);
      return dealii::Utilities::MPI::sum(sum, a.get_mpi_communicator());
    }

    /// x = y + factor x
    void turn(Vector &x, const double factor, const Vector &y)
    {
      for (LocalIndex i = 0; i < x.locally_owned_size(); ++i)
        x.local_element(i) = y.local_element(i) + factor * x.local_element(i);
    }

    void add(Vector &x, const double factor, const Vector &y)
    {
      for (LocalIndex i = 0; i < x.locally_owned_size(); ++i)
        x.local_element(i) += factor * y.local_element(i);
    }
  } // namespace

  KrylovSolve symmetric_krylov(const KrylovMethod                                         method,
                               const std::function<void(Vector &dst, const Vector &src)> &product,
                               Vector                                                    &x,
                               const Vector                                              &b,
                               const double                                               tolerance,
                               const unsigned int max_iterations)
  {
    const bool   residuals = method == KrylovMethod::conjugate_residuals;
    KrylovSolve  outcome;
    const double norm_b = std::sqrt(dot(b, b));
    Vector       r(b), p(b), Ar(b), Ap(b);
    x = 0.;
    product(Ap, p);
    Ar = Ap;
    // Conjugate residuals minimise |r| in the metric of A^2, conjugate gradients in that of A: each
    // product of the one is that of the other with a residual replaced by A times it.
    double rho  = residuals ? dot(r, Ar) : dot(r, r);
    double size = norm_b;
    // Written such that a NaN goes on to fail.
    while (!(size <= tolerance * norm_b) && outcome.iterations < max_iterations)
      {
        const double curvature = residuals ? dot(Ap, Ap) : dot(p, Ap);
        const double scale
            = residuals ? size * std::sqrt(dot(Ar, Ar)) : std::sqrt(dot(p, p) * dot(Ap, Ap));
        if (!(std::abs(residuals ? rho : curvature)
              > 16. * std::numeric_limits<double>::epsilon() * scale))
          {
            outcome.failure = "broke down, as it may on an indefinite matrix,";
            break;
          }
        const double length = rho / curvature;
        add(x, length, p);
        add(r, -length, Ap);
        ++outcome.iterations;
        size              = std::sqrt(dot(r, r));
        double rho_before = rho;
        if (residuals)
          {
            product(Ar, r);
            rho = dot(r, Ar);
            turn(p, rho / rho_before, r);
            turn(Ap, rho / rho_before, Ar);
          }
        else
          {
            rho = size * size;
            turn(p, rho / rho_before, r);
            product(Ap, p);
          }
      }

    product(Ar, x);
    r = b;
    add(r, -1., Ar);
    outcome.relative_residual = norm_b == 0. ? 0. : std::sqrt(dot(r, r)) / norm_b;
    // The residual of the recurrence drifts a little from the true one.
    outcome.succeeded = outcome.failure.empty() && outcome.relative_residual <= 2. * tolerance;
    if (!outcome.succeeded)
      {
        std::ostringstream why;
        why << (residuals ? "CR " : "CG ")
            << (outcome.failure.empty() ? "did not converge" : outcome.failure) << " in "
            << outcome.iterations << " iterations (relative residual " << outcome.relative_residual
            << ")";
        // x . A r = r . A x, if A is symmetric; Ar is A x here.
        product(Ap, r);
        if (std::abs(dot(x, Ap) - dot(r, Ar)) > 1e-8 * std::sqrt(dot(r, r) * dot(Ar, Ar)))
          why << "; the operator is not symmetric, as under a follower pressure";
        outcome.failure = why.str();
      }
    return outcome;
  }
} // namespace isochor
