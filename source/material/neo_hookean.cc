#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  // With H = F^-T: P = mu (F - H), dH_iJ / dF_kL = -H_iL H_kJ.
  void NeoHookean::evaluate(const Deformation &deformation,
                            const bool         with_tangent,
                            Response          &response) const
  {
    const auto &F         = deformation.F;
    const Batch J         = positive_or_nan(deformation.J);
    const Batch inverse_J = 1. / J;

    response.energy = .5 * mu * (contract(F, F) - 3.) - mu * log(J);
    Batch H[9];
    for (int k = 0; k < 9; ++k)
      {
        H[k]          = deformation.cofactor[k] * inverse_J;
        response.P[k] = mu * (F[k] - H[k]);
      }
    if (!with_tangent)
      return;

    fill_tangent(
        [&](const int i, const int J, const int k, const int L) {
          const Batch entry = mu * H[3 * i + L] * H[3 * k + J];
          return i == k && J == L ? entry + mu : entry;
        },
        response.A);
  }
} // namespace isochor
