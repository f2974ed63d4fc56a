#pragma once

// Functions of a Batch that the language extension does not have.

#include <isochor/core/batch.h>

#include <cmath>
#include <limits>

namespace isochor
{
  /// NaN in the lanes where @p x is not above zero, so that what is computed from it is NaN too.
  inline Batch positive_or_nan(const Batch &x)
  {
    return x > batch(0.) ? x : batch(std::numeric_limits<double>::quiet_NaN());
  }

  inline Batch log(const Batch &x)
  {
    Batch result;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      result[lane] = std::log(x[lane]);
    return result;
  }

  inline Batch cbrt(const Batch &x)
  {
    Batch result;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      result[lane] = std::cbrt(x[lane]);
    return result;
  }

  /// A : B of two tensors with nine entries.
  inline Batch contract(const Batch (&A)[9], const Batch (&B)[9])
  {
    Batch sum = A[0] * B[0];
    for (int k = 1; k < 9; ++k)
      sum += A[k] * B[k];
    return sum;
  }
} // namespace isochor
