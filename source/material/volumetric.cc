#include <isochor/material/distortional_energy.h>
#include <isochor/material/lanes.h>

#include <stdexcept>

namespace isochor
{
  VolumetricResponse evaluate(const VolumetricStrain strain, const Deformation &deformation)
  {
    const auto        &F = deformation.F;
    VolumetricResponse result;
    switch (strain)
      {
        case VolumetricStrain::linear:
          result.phi       = deformation.J - 1.;
          result.d_phi     = batch(1.);
          result.curvature = batch(0.);
          for (int k = 0; k < 9; ++k)
            result.gradient[k] = deformation.cofactor[k];
          return result;
        case VolumetricStrain::logarithmic:
          {
            const Batch J    = positive_or_nan(deformation.J);
            result.phi       = log(J);
            result.d_phi     = 1. / J;
            result.curvature = batch(-1.);
            for (int k = 0; k < 9; ++k)
              result.gradient[k] = result.d_phi * deformation.cofactor[k];
            return result;
          }
        case VolumetricStrain::trace:
          result.phi       = (F[0] - 1.) + (F[4] - 1.) + (F[8] - 1.);
          result.d_phi     = batch(0.);
          result.curvature = batch(0.);
          for (int k = 0; k < 9; ++k)
            result.gradient[k] = batch(k % 4 == 0 ? 1. : 0.);
          return result;
      }
    throw std::logic_error("a volumetric strain that is not known");
  }

  void add_volumetric(const Deformation        &deformation,
                      const VolumetricResponse &volumetric,
                      const Batch              &q,
                      const double              stiffness,
                      const bool                with_tangent,
                      Response                 &response)
  {
    const auto &gradient = volumetric.gradient;
    for (int k = 0; k < 9; ++k)
      response.P[k] += q * gradient[k];
    if (!with_tangent)
      return;

    const Batch modulus = q * volumetric.curvature + stiffness;
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k)
      {
        const Batch scaled = modulus * gradient[k];
#pragma GCC unroll 9
        for (int l = 0; l < 9; ++l)
          response.A[9 * k + l] += scaled * gradient[l];
      }
    add_second_derivative_of_J(q * volumetric.d_phi, deformation.F, response.A);
  }
} // namespace isochor
