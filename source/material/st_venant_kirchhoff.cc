#include <isochor/material/deformation_range.h>
#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

#include <sstream>

namespace isochor
{
  // With C = F^T F, b = F F^T: P = 2 mu F E = mu (F C - F),
  // A_iJkL = mu [d_ik (C - 1)_LJ + F_iL F_kJ + b_ik d_JL].
  void StVenantKirchhoff::evaluate(const Deformation &deformation,
                                   const bool         with_tangent,
                                   Response          &response) const
  {
    const auto &F = deformation.F;
    Batch       twice_E[9], FE[9];
    right_square(F, twice_E);
    for (int k = 0; k < 9; k += 4)
      twice_E[k] -= 1.;
    multiply(F, twice_E, FE);

    response.energy = .25 * mu * contract(twice_E, twice_E);
    for (int k = 0; k < 9; ++k)
      response.P[k] = mu * FE[k];
    if (!with_tangent)
      return;

    Batch b[9];
    left_square(F, b);
    for (int k = 0; k < 9; ++k)
      {
        b[k] *= mu;
        twice_E[k] *= mu;
      }
    fill_tangent(
        [&](const int i, const int J, const int k, const int L) {
          Batch entry = mu * F[3 * i + L] * F[3 * k + J];
          if (i == k)
            entry += twice_E[3 * L + J];
          if (J == L)
            entry += b[3 * i + k];
          return entry;
        },
        response.A);
  }

  std::string StVenantKirchhoff::weakness(const DeformationRange &range) const
  {
    if (!(range.smallest_stretch < std::sqrt(.5)))
      return {};
    std::ostringstream text;
    text.precision(2);
    text << "St. Venant-Kirchhoff softens in compression, and somewhere the body is compressed to "
         << 100. * range.smallest_stretch
         << " % of its length: below 71 % it may lose its stiffness in shear, below 58 % more "
            "compression meets less resistance; choose stable neo-Hookean or neo-Hookean";
    return text.str();
  }
} // namespace isochor
