#pragma once

// Polar decomposition F = R S at eight points, without eigenvectors and without branches.

#include <isochor/material/distortional_energy.h>

namespace isochor
{
  /// R is the rotation nearest to F, det R = 1; S is symmetric with at most one eigenvalue below
  /// zero, the smallest in size, and that where J < 0.
  struct PolarDecomposition
  {
    Batch R[9];
    Batch trace; ///< tr S
    /// det(tr(S) 1 - S), the product of the sums of two eigenvalues of S; R varies fast where it is
    /// small.
    Batch determinant;
  };

  /// NaN where two eigenvalues of S add up to zero: there the nearest rotation is not unique, and
  /// near there rounding decides. R has the error (t^3 / d)^2 times that of rounding, t = tr S and
  /// d = twice the determinant above; NaN if t^3 / d > 1e5, which at J > 0 takes a stretch 200,000
  /// times the two others.
  PolarDecomposition polar_decomposition(const Deformation &deformation);
} // namespace isochor
