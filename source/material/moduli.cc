#include <isochor/material/moduli.h>

namespace isochor
{
  Moduli moduli(const double          youngs_modulus,
                const double          poisson_ratio,
                const Energy          energy,
                const KappaConvention convention)
  {
    // At nu = 1/2 both denominators are exactly 0 and both moduli infinite.
    const double mu   = youngs_modulus / (2. * (1. + poisson_ratio));
    const double bulk = youngs_modulus / (3. * (1. - 2. * poisson_ratio));
    const double lambda
        = youngs_modulus * poisson_ratio / ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    switch (convention)
      {
        case KappaConvention::lambda:
          return {mu, lambda};
        case KappaConvention::bulk:
          return {mu, bulk};
        case KappaConvention::consistent:
          switch (energy)
            {
              case Energy::neo_hookean:
                return {mu, lambda};
              case Energy::bonet_wood:
                return {mu, bulk};
            }
      }
    throw std::logic_error("moduli: an energy or a convention that is not known");
  }
} // namespace isochor
