#pragma once

// Conjugate residuals and conjugate gradients (Saad 2003, algorithms 6.20 and 6.18) of a symmetric
// operator that need not be definite, without a preconditioner: scale the operator instead.
// Neither is safe on an indefinite one; where a step divides by nothing, they say so.

#include <isochor/core/types.h>

#include <functional>
#include <string>

namespace isochor
{
  enum class KrylovMethod
  {
    conjugate_residuals,
    conjugate_gradients
  };

  struct KrylovSolve
  {
    bool         succeeded = false;
    std::string  failure;               ///< why not, in words; empty if it succeeded
    double       relative_residual = 0; ///< |b - A x| / |b|, computed anew
    unsigned int iterations        = 0; ///< = products, two or three more for residuals
  };

  /// Solve A x = b from x = 0. @p product: dst = A src. Collective.
  KrylovSolve symmetric_krylov(KrylovMethod                                               method,
                               const std::function<void(Vector &dst, const Vector &src)> &product,
                               Vector                                                    &x,
                               const Vector                                              &b,
                               double                                                     tolerance,
                               unsigned int max_iterations);
} // namespace isochor
