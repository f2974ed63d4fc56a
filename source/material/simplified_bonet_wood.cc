#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  // With H = F^-T and m = mu J^(-2/3): P = m F, A_iJkL = m (d_ik d_JL - 2/3 F_iJ H_kL).
  void SimplifiedBonetWood::evaluate(const Deformation &deformation,
                                     const bool         with_tangent,
                                     Response          &response) const
  {
    const auto &F    = deformation.F;
    const Batch J    = positive_or_nan(deformation.J);
    const Batch root = cbrt(J);
    const Batch m    = mu / (root * root);

    response.energy = .5 * m * contract(F, F) - 1.5 * mu;
    for (int k = 0; k < 9; ++k)
      response.P[k] = m * F[k];
    if (!with_tangent)
      return;

    const Batch factor = -2. / 3. * m / J;
    Batch       H[9];
    for (int k = 0; k < 9; ++k)
      H[k] = factor * deformation.cofactor[k];
    fill_tangent(
        [&](const int i, const int J, const int k, const int L) {
          const Batch entry = F[3 * i + J] * H[3 * k + L];
          return i == k && J == L ? entry + m : entry;
        },
        response.A);
  }
} // namespace isochor
