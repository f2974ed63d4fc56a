#include <isochor/material/lanes.h>
#include <isochor/material/polar.h>

namespace isochor
{
  // The trace t = s1 + s2 + s3 of S is the largest root of the quartic with the roots s1 + s2 + s3,
  // s1 - s2 - s3, -s1 + s2 - s3, -s1 - s2 + s3 (Lin, Chitalu and Komura 2022), where s3 has the
  // sign of J:
  //   t^4 - 2 I t^2 - 8 J t + 2 tr(C^2) - I^2 = 0,  I = tr C.
  // As t = max R : F over all rotations, R = dt/dF, which the quartic gives by implicit
  // differentiation. All roots are real, so that Newton's method descends to the largest from any
  // bound above it, such as sqrt(3 I). It is a simple root as long as R is unique:
  //   t^3 - I t - 2 J = 2 (s1 + s2) (s2 + s3) (s3 + s1).
  PolarDecomposition polar_decomposition(const Deformation &deformation)
  {
    const auto &F = deformation.F;
    Batch       C[9], FC[9];
    right_square(F, C);
    multiply(F, C, FC);
    const Batch I        = C[0] + C[4] + C[8];
    const Batch J        = deformation.J;
    const Batch constant = 2. * contract(C, C) - I * I;

    Batch t = sqrt(3. * I);
    Batch slope;
    for (unsigned int iteration = 0; iteration < 60; ++iteration)
      {
        slope            = (t * t - I) * t - 2. * J;
        const Batch step = .25 * (((t * t - 2. * I) * t - 8. * J) * t + constant) / slope;
        t -= step;
        // From here on it is rounding that moves it, up as well as down; the order of convergence
        // is two. A NaN is at its end, too.
        bool moves = false;
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          moves = moves || step[lane] > 1e-9 * t[lane];
        if (!moves)
          break;
      }
    slope = (t * t - I) * t - 2. * J;
    slope = slope > 1e-5 * t * t * t ? slope : batch(std::numeric_limits<double>::quiet_NaN());

    PolarDecomposition result;
    result.trace       = t;
    result.determinant = .5 * slope;
    const Batch scale  = 1. / slope;
    const Batch by_F = (t * t + I) * scale, by_FC = -2. * scale, by_cofactor = 2. * t * scale;
    for (int k = 0; k < 9; ++k)
      result.R[k] = by_F * F[k] + by_FC * FC[k] + by_cofactor * deformation.cofactor[k];
    return result;
  }
} // namespace isochor
