#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>
#include <isochor/material/polar.h>

namespace isochor
{
  // P = 2 mu (F - R). From R^T dF - dF^T R = W S + S W with dR = R W, W = [w]x, follows
  // (tr(S) 1 - S) w = a, [a]x the left side, that is dR/dF = sum_mn B_m (tr(S) 1 - S)^-1_mn B_n
  // with B_m = R [e_m]x.
  void Corotational::evaluate(const Deformation &deformation,
                              const bool         with_tangent,
                              Response          &response) const
  {
    const auto &F      = deformation.F;
    const auto  polar  = polar_decomposition(deformation);
    const auto &R      = polar.R;
    Batch       square = batch(0.);
    for (int k = 0; k < 9; ++k)
      {
        const Batch stretched = F[k] - R[k];
        square += stretched * stretched;
        response.P[k] = 2. * mu * stretched;
      }
    response.energy = mu * square;
    if (!with_tangent)
      return;

    // G = tr(S) 1 - S with S = R^T F, and 2 mu G^-1 by cofactors; both symmetric.
    Batch G[6]; // 11, 22, 33, 23, 13, 12
    for (int m = 0; m < 3; ++m)
      {
        const int a = (m + 1) % 3, b = (m + 2) % 3;
        G[m]     = polar.trace - (R[m] * F[m] + R[3 + m] * F[3 + m] + R[6 + m] * F[6 + m]);
        G[3 + m] = -.5
                   * (R[a] * F[b] + R[3 + a] * F[3 + b] + R[6 + a] * F[6 + b] + R[b] * F[a]
                      + R[3 + b] * F[3 + a] + R[6 + b] * F[6 + a]);
      }
    const Batch scale = 2. * mu / polar.determinant;
    Batch       inverse[3][3];
    for (int m = 0; m < 3; ++m)
      {
        const int a = (m + 1) % 3, b = (m + 2) % 3;
        inverse[m][m] = scale * (G[a] * G[b] - G[3 + m] * G[3 + m]);
        inverse[a][b] = inverse[b][a] = scale * (G[3 + a] * G[3 + b] - G[m] * G[3 + m]);
      }

    // (B_m)_iJ is zero for J = m, R_ib for J = a and -R_ia for J = b, with (m, a, b) cyclic.
    Batch T[3][9]; // 2 mu sum_n G^-1_mn B_n
#pragma GCC unroll 3
    for (int m = 0; m < 3; ++m)
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
        for (int J = 0; J < 3; ++J)
          {
            const int a = (J + 1) % 3, b = (J + 2) % 3;
            T[m][3 * i + J] = inverse[m][b] * R[3 * i + a] - inverse[m][a] * R[3 * i + b];
          }
    fill_tangent(
        [&](const int i, const int J, const int k, const int L) {
          const int   a = (J + 1) % 3, b = (J + 2) % 3;
          const Batch entry = R[3 * i + b] * T[a][3 * k + L] - R[3 * i + a] * T[b][3 * k + L];
          return i == k && J == L ? entry + 2. * mu : entry;
        },
        response.A);
  }
} // namespace isochor
