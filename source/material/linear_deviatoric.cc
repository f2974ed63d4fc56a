#include <isochor/material/deformation_range.h>
#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>

#include <sstream>

namespace isochor
{
  // P = 2 shear eps + lambda tr(eps), A_iJkL = shear (d_ik d_JL + d_iL d_kJ) + lambda d_iJ d_kL.
  void LinearDeviatoric::evaluate(const Deformation &deformation,
                                  const bool         with_tangent,
                                  Response          &response) const
  {
    const auto &F = deformation.F;
    Batch       strain[9];
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        strain[3 * i + J] = i == J ? F[4 * i] - 1. : .5 * (F[3 * i + J] + F[3 * J + i]);
    const Batch trace = strain[0] + strain[4] + strain[8];

    response.energy = shear * contract(strain, strain) + .5 * lambda * trace * trace;
    for (int k = 0; k < 9; ++k)
      {
        response.P[k] = 2. * shear * strain[k];
        if (k % 4 == 0)
          response.P[k] += lambda * trace;
      }
    if (with_tangent)
      fill_tangent(
          [&](const int i, const int J, const int k, const int L) {
            return batch((i == k && J == L ? shear : 0.) + (i == L && k == J ? shear : 0.)
                         + (i == J && k == L ? lambda : 0.));
          },
          response.A);
  }

  std::string LinearDeviatoric::weakness(const DeformationRange &range) const
  {
    const double false_strain = 1. - std::cos(range.largest_rotation);
    if (!(false_strain > 0.01))
      return {};
    std::ostringstream text;
    text.precision(2);
    text << "small-strain elasticity takes rotations for strains, and the body turns by up to "
         << range.largest_rotation * 180. / 3.14159265358979 << " degrees: false strains up to "
         << 100. * false_strain << " %; choose neo-Hookean or corotational";
    return text.str();
  }
} // namespace isochor
