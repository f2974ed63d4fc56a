#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  // P = mu (F - cof F), A_iJkL = mu (d_ik d_JL - eps_ikm eps_JLM F_mM).
  void StableNeoHookean::evaluate(const Deformation &deformation,
                                  const bool         with_tangent,
                                  Response          &response) const
  {
    const auto &F   = deformation.F;
    response.energy = .5 * mu * (contract(F, F) - 3.) - mu * (deformation.J - 1.);
    for (int k = 0; k < 9; ++k)
      response.P[k] = mu * (F[k] - deformation.cofactor[k]);
    if (!with_tangent)
      return;

    Batch plus[9], minus[9];
    for (int k = 0; k < 9; ++k)
      {
        plus[k]  = mu * F[k];
        minus[k] = -plus[k];
      }
    fill_tangent(
        [&](const int i, const int J, const int k, const int L) {
          if (i == k || J == L)
            return batch(i == k && J == L ? mu : 0.);
          const int  rest       = 3 * (3 - i - k) + 3 - J - L;
          const bool same_sense = (i + 1) % 3 == k ? (J + 1) % 3 == L : (L + 1) % 3 == J;
          return same_sense ? minus[rest] : plus[rest];
        },
        response.A);
  }
} // namespace isochor
