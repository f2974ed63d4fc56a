#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  // P = mu (F - cof F).
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

    for (int k = 0; k < 81; ++k)
      response.A[k] = batch(k % 10 == 0 ? mu : 0.);
    add_second_derivative_of_J(batch(-mu), F, response.A);
  }
} // namespace isochor
