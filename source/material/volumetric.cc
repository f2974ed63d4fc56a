#include <isochor/material/distortional_energy.h>
#include <isochor/material/lanes.h>

#include <stdexcept>

namespace isochor
{
  VolumetricResponse evaluate(const VolumetricStrain strain, const Batch &J)
  {
    switch (strain)
      {
        case VolumetricStrain::linear:
          return {J - 1., batch(1.), batch(0.)};
        case VolumetricStrain::logarithmic:
          {
            const Batch positive = positive_or_nan(J);
            const Batch inverse  = 1. / positive;
            return {log(positive), inverse, -inverse * inverse};
          }
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
    const auto &F        = deformation.F;
    const auto &cofactor = deformation.cofactor;
    const Batch pressure = q * volumetric.d_phi;
    for (int k = 0; k < 9; ++k)
      response.P[k] += pressure * cofactor[k];
    if (!with_tangent)
      return;

    const Batch modulus = q * volumetric.d2_phi + stiffness * volumetric.d_phi * volumetric.d_phi;
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k)
      {
        const Batch scaled = modulus * cofactor[k];
#pragma GCC unroll 9
        for (int l = 0; l < 9; ++l)
          response.A[9 * k + l] += scaled * cofactor[l];
      }

      // d2J / dF_iJ dF_kL = eps_ikm eps_JLM F_mM holds at J = 0, too. For each (m, M) four entries;
      // (i, k, m) and (J, L, M) are cyclic.
#pragma GCC unroll 3
    for (int m = 0; m < 3; ++m)
#pragma GCC unroll 3
      for (int M = 0; M < 3; ++M)
        {
          const Batch term = pressure * F[3 * m + M];
          const int   i = (m + 1) % 3, k = (m + 2) % 3, J = (M + 1) % 3, L = (M + 2) % 3;
          response.A[9 * (3 * i + J) + 3 * k + L] += term;
          response.A[9 * (3 * k + L) + 3 * i + J] += term;
          response.A[9 * (3 * i + L) + 3 * k + J] -= term;
          response.A[9 * (3 * k + J) + 3 * i + L] -= term;
        }
  }
} // namespace isochor
