#pragma once

// Deformations at eight points, and what is done to them, for tests of energies.

#include <isochor/material/distortional_energy.h>

#include "../common/report.h"

#include <cmath>

namespace isochor::testing
{
  /// Eight deformations, J between 0.4 and 2.5; or flipped, J between -1 and -0.16.
  inline Deformation samples(const bool flipped = false)
  {
    Deformation deformation;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      for (int k = 0; k < 9; ++k)
        {
          deformation.F[k][lane]
              = (k % 4 == 0 ? 0.8 + 0.08 * lane : 0.) + 0.3 * std::sin(1. + 2.7 * k + 1.3 * lane);
          if (flipped && k < 3)
            deformation.F[k][lane] *= -0.4;
        }
    deformation.complete();
    return deformation;
  }

  inline Deformation diagonal(const double x, const double y, const double z)
  {
    const double stretch[3] = {x, y, z};
    Deformation  deformation;
    for (int k = 0; k < 9; ++k)
      deformation.F[k] = batch(k % 4 == 0 ? stretch[k / 4] : 0.);
    deformation.complete();
    return deformation;
  }

  struct Matrix
  {
    double entry[9];
  };

  /// Rotation about (1, 2, 2) / 3 by @p angle.
  inline Matrix rotation(const double angle)
  {
    const double axis[3] = {1. / 3., 2. / 3., 2. / 3.}, c = std::cos(angle), s = std::sin(angle);
    Matrix       Q;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        Q.entry[3 * i + j] = (i == j ? c : 0.) + (1 - c) * axis[i] * axis[j]
                             + (i == j ? 0. : ((j - i + 3) % 3 == 1 ? -s : s) * axis[3 - i - j]);
    return Q;
  }

  /// Q T
  inline void from_left(const Matrix &Q, const Batch (&T)[9], Batch (&product)[9])
  {
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        product[3 * i + J]
            = Q.entry[3 * i] * T[J] + Q.entry[3 * i + 1] * T[3 + J] + Q.entry[3 * i + 2] * T[6 + J];
  }

  /// T Q^T
  inline void from_right(const Matrix &Q, const Batch (&T)[9], Batch (&product)[9])
  {
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        product[3 * i + J] = T[3 * i] * Q.entry[3 * J] + T[3 * i + 1] * Q.entry[3 * J + 1]
                             + T[3 * i + 2] * Q.entry[3 * J + 2];
  }

  /// Raise @p error to the largest lane of |@p difference| / @p scale.
  inline void raise_by(double &error, const Batch &difference, const double scale = 1.)
  {
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      raise(error, std::abs(difference[lane]) / scale);
  }

  inline double largest(const Batch &x)
  {
    double most = 0;
    raise_by(most, x);
    return most;
  }
} // namespace isochor::testing
