#include <isochor/solver/matrix_free.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    // Without rounding both end after as many iterations as there are unknowns.
    constexpr GlobalIndex iterations_per_unknown = 10, most_iterations = 20000;
  } // namespace

  template <int dim>
  MatrixFreeSolver<dim>::MatrixFreeSolver(const Equilibrium<dim> &equilibrium,
                                          const KrylovMethod      method)
    : equilibrium(equilibrium)
    , method(method)
    , factors(equilibrium.diagonal())
  {
    for (LocalIndex i = 0; i < factors.locally_owned_size(); ++i)
      factors.local_element(i) = 1. / std::sqrt(factors.local_element(i));
  }

  template <int dim>
  void MatrixFreeSolver<dim>::scale(Vector &vector) const
  {
    for (LocalIndex i = 0; i < vector.locally_owned_size(); ++i)
      vector.local_element(i) *= factors.local_element(i);
  }

  template <int dim>
  void MatrixFreeSolver<dim>::vmult(Vector       &dst,
                                    const Vector &src,
                                    const Vector &state,
                                    const double  load) const
  {
    Vector direction(src);
    equilibrium.prescribed().set_zero(direction);
    scale(direction);
    equilibrium.tangent_product(state, load, direction, dst);
    scale(dst);
    for (const LocalIndex unknown : equilibrium.prescribed().unknowns())
      dst.local_element(unknown) = src.local_element(unknown);
  }

  template <int dim>
  KrylovSolve MatrixFreeSolver<dim>::solve(const Vector &state,
                                           const double  load,
                                           const Vector &rhs,
                                           const Vector &gap,
                                           const double  tolerance,
                                           Vector       &step) const
  {
    // The step is the gap and a rest that is zero at the prescribed unknowns.
    Vector b(rhs), moved(rhs);
    equilibrium.tangent_product(state, load, gap, moved);
    b -= moved;
    equilibrium.prescribed().set_zero(b);
    scale(b);
    const KrylovSolve outcome = symmetric_krylov(
        method,
        [&](Vector &dst, const Vector &src) { vmult(dst, src, state, load); },
        step,
        b,
        tolerance,
        std::min(iterations_per_unknown * equilibrium.discretisation().n_unknowns(),
                 most_iterations));
    scale(step);
    step += gap;
    return outcome;
  }

  template class MatrixFreeSolver<2>;
  template class MatrixFreeSolver<3>;
} // namespace isochor
