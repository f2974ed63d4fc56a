#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  // With H = F^-T and D = F - I1/3 H, the part of F that keeps volume: P = m D, m = mu J^(-2/3),
  // A_iJkL = m [d_ik d_JL - 2/3 (D_iJ H_kL + H_iJ F_kL) + I1/3 H_iL H_kJ].
  void BonetWood::evaluate(const Deformation &deformation,
                           const bool         with_tangent,
                           Response          &response) const
  {
    const auto &F         = deformation.F;
    const Batch J         = positive_or_nan(deformation.J);
    const Batch inverse_J = 1. / J;
    const Batch root      = cbrt(J);
    const Batch m         = mu / (root * root);
    const Batch third_I1  = contract(F, F) * (1. / 3.);

    response.energy = 1.5 * (m * third_I1 - mu);
    Batch H[9], D[9];
    for (int k = 0; k < 9; ++k)
      {
        H[k]          = deformation.cofactor[k] * inverse_J;
        D[k]          = F[k] - third_I1 * H[k];
        response.P[k] = m * D[k];
      }
    if (!with_tangent)
      return;

    const Batch a = -2. / 3. * m, b = m * third_I1;
    fill_tangent(
        [&](const int i, const int J, const int k, const int L) {
          const Batch entry = a * D[3 * i + J] * H[3 * k + L] + a * H[3 * i + J] * F[3 * k + L]
                              + b * H[3 * k + J] * H[3 * i + L];
          return i == k && J == L ? entry + m : entry;
        },
        response.A);
  }
} // namespace isochor
