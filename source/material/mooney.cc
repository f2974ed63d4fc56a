#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  void Mooney::evaluate(const Deformation &deformation,
                        const bool         with_tangent,
                        Response          &response) const
  {
    const auto &F   = deformation.F;
    response.energy = .5 * mu * (contract(F, F) - 3.);
    for (int k = 0; k < 9; ++k)
      response.P[k] = mu * F[k];
    if (with_tangent)
      for (int k = 0; k < 81; ++k)
        response.A[k] = batch(k % 10 == 0 ? mu : 0.);
  }
} // namespace isochor
