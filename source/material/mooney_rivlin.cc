#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  // With H = F^-T, C = F^T F, b = F F^T, Z = I1 F - F C = 1/2 dI2/dF, m_1 = 2 c1 J^(-2/3) and
  // m_2 = 2 c2 J^(-4/3):
  //   P = m_1 (F - I1/3 H) + m_2 (Z - 2/3 I2 H)
  //   A_iJkL = (m_1 + m_2 I1) d_ik d_JL - (X_iJ H_kL + H_iJ X_kL) + (m_1 I1 + 2 m_2 I2)/3 H_iL H_kJ
  //            + m_2 [2 F_iJ F_kL - F_iL F_kJ - d_ik C_JL - b_ik d_JL],
  //   X = 2/3 m_1 F + 4/3 m_2 Z - (m_1 I1 + 4 m_2 I2)/9 H.
  void MooneyRivlin::evaluate(const Deformation &deformation,
                              const bool         with_tangent,
                              Response          &response) const
  {
    const auto &F         = deformation.F;
    const Batch J         = positive_or_nan(deformation.J);
    const Batch inverse_J = 1. / J;
    const Batch root      = cbrt(J);
    const Batch factor    = 1. / (root * root);
    const Batch m_1 = mu_1 * factor, m_2 = mu_2 * factor * factor;
    Batch       C[9], FC[9];
    right_square(F, C);
    multiply(F, C, FC);
    const Batch I1 = C[0] + C[4] + C[8];
    const Batch I2
        = C[0] * C[4] - C[1] * C[1] + C[4] * C[8] - C[5] * C[5] + C[8] * C[0] - C[2] * C[2];
    const Batch a_1 = m_1 * I1, a_2 = m_2 * I2;

    response.energy = .5 * (a_1 - 3. * mu_1) + .5 * (a_2 - 3. * mu_2);
    Batch H[9], Z[9];
    for (int k = 0; k < 9; ++k)
      {
        H[k]          = deformation.cofactor[k] * inverse_J;
        Z[k]          = I1 * F[k] - FC[k];
        response.P[k] = m_1 * F[k] + m_2 * Z[k] - (a_1 + 2. * a_2) * (1. / 3.) * H[k];
      }
    if (!with_tangent)
      return;

    // Products taken out of the loops by hand: with fill_tangent it is 15 % slower.
    const Batch crossed = (a_1 + 2. * a_2) * (1. / 3.), diagonal = m_1 + m_2 * I1;
    Batch       X[9], b[9];
    left_square(F, b);
    for (int k = 0; k < 9; ++k)
      {
        X[k]
            = (2. / 3. * m_1) * F[k] + (4. / 3. * m_2) * Z[k] - (a_1 + 4. * a_2) * (1. / 9.) * H[k];
        b[k] *= m_2;
        C[k] *= m_2;
      }
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int J = 0; J < 3; ++J)
        {
          const Batch F_iJ = 2. * m_2 * F[3 * i + J];
#pragma GCC unroll 3
          for (int k = 0; k < 3; ++k)
            {
              const Batch H_kJ = crossed * H[3 * k + J], F_kJ = m_2 * F[3 * k + J];
#pragma GCC unroll 3
              for (int L = 0; L < 3; ++L)
                {
                  Batch entry = F_iJ * F[3 * k + L] - F_kJ * F[3 * i + L] + H_kJ * H[3 * i + L]
                                - (X[3 * i + J] * H[3 * k + L] + H[3 * i + J] * X[3 * k + L]);
                  if (i == k)
                    entry -= C[3 * J + L];
                  if (J == L)
                    entry -= b[3 * i + k];
                  if (i == k && J == L)
                    entry += diagonal;
                  response.A[9 * (3 * i + J) + 3 * k + L] = entry;
                }
            }
        }
  }
} // namespace isochor
