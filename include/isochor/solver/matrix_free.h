#pragma once

// Newton's linear systems without a matrix, the iterative path of "Locking-Proof Tetrahedra"
// (section 8): conjugate residuals or conjugate gradients, products by force differentials, diagonal
// scaling that brings the constraints to the size of the forces. Little memory and many iterations: to
// compare with factors.

#include <isochor/algebra/symmetric_krylov.h>
#include <isochor/form/equilibrium.h>

namespace isochor
{
  template <int dim>
  class MatrixFreeSolver
  {
  public:
    /// @p equilibrium must outlive this.
    MatrixFreeSolver(const Equilibrium<dim> &equilibrium, KrylovMethod method);

    /// dst = S A S src: A the tangent at a state with rows and columns of the prescribed unknowns
    /// replaced by those of a diagonal matrix, S^-2 the diagonal at rest. Collective.
    void vmult(Vector &dst, const Vector &src, const Vector &state, double load) const;

    /// @p step solves tangent step = @p rhs with step = @p gap on the prescribed unknowns, to a
    /// relative residual of @p tolerance in the scaled system. Collective.
    KrylovSolve solve(const Vector &state,
                      double        load,
                      const Vector &rhs,
                      const Vector &gap,
                      double        tolerance,
                      Vector       &step) const;

  private:
    void scale(Vector &vector) const;

    const Equilibrium<dim> &equilibrium;
    KrylovMethod            method;
    Vector                  factors; ///< diagonal of S
  };
} // namespace isochor
