#include <isochor/material/energies.h>

#include <stdexcept>

namespace isochor
{
  void Deformation::complete()
  {
    // Row i of the cofactor is the cross product of the two other rows of F, in cyclic order.
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        {
          const int j = (i + 1) % 3, k = (i + 2) % 3, K = (J + 1) % 3, L = (J + 2) % 3;
          cofactor[3 * i + J] = F[3 * j + K] * F[3 * k + L] - F[3 * j + L] * F[3 * k + K];
        }
    J = F[0] * cofactor[0] + F[1] * cofactor[1] + F[2] * cofactor[2];
  }

  std::unique_ptr<const DistortionalEnergy> make_distortional_energy(const Energy  energy,
                                                                     const Moduli &moduli)
  {
    const double mu = moduli.mu;
    switch (energy)
      {
        case Energy::neo_hookean:
          return std::make_unique<const NeoHookean>(mu);
        case Energy::bonet_wood:
          return std::make_unique<const BonetWood>(mu);
        case Energy::mooney:
          return std::make_unique<const Mooney>(mu);
        case Energy::simplified_bonet_wood:
          return std::make_unique<const SimplifiedBonetWood>(mu);
        case Energy::stable_neo_hookean:
          return std::make_unique<const StableNeoHookean>(mu);
        case Energy::mooney_rivlin:
          return std::make_unique<const MooneyRivlin>(mu, moduli.mooney_rivlin_ratio);
        case Energy::st_venant_kirchhoff:
          return std::make_unique<const StVenantKirchhoff>(mu);
        case Energy::corotational:
          return std::make_unique<const Corotational>(mu);
        case Energy::linear:
          return std::make_unique<const LinearDeviatoric>(mu, -2. / 3. * mu);
        case Energy::linear_as_printed:
          return std::make_unique<const LinearDeviatoric>(.5 * mu, -4. / 3. * mu);
      }
    throw std::logic_error("an energy that cannot be made");
  }
} // namespace isochor
