#include <isochor/material/moduli.h>

#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    /// An energy at small strain is shear mu eps : eps + 1/2 lambda mu tr(eps)^2; with kappa / 2
    /// tr(eps)^2 of the volumetric term, Lame's second parameter is lambda mu + kappa.
    struct Linearised
    {
      double shear, lambda;
      bool   stress_at_rest = false; ///< balanced by a pressure if kappa is infinite
    };

    Linearised linearised(const Energy energy)
    {
      switch (energy)
        {
          // Shear only: what Patterson et al. 2012 take of each energy (section 5). It vanishes at
          // rotations alone, and at nu = 0 these are the energies of the textbooks as they are.
          case Energy::neo_hookean:
          case Energy::st_venant_kirchhoff:
          case Energy::corotational:
            return {1., 0.};
          case Energy::bonet_wood:
          case Energy::mooney_rivlin:
          case Energy::linear:
            return {1., -2. / 3.};
          // mu (J - 1) takes mu tr(eps) off, and half of mu tr(eps)^2 with it. Hence kappa = lambda
          // + mu, and the second paper's gamma = 1 + mu / kappa.
          case Energy::stable_neo_hookean:
            return {1., -1.};
          // With the pressure that holds the body at rest: of (29) that of the one above.
          case Energy::mooney:
            return {1., -1., true};
          case Energy::simplified_bonet_wood:
            return {1., -5. / 3., true};
          case Energy::linear_as_printed:
            return {.5, -4. / 3.};
        }
      throw std::logic_error("an energy without moduli");
    }

    double
    consistent_kappa(const Energy energy, const double mu, const double lambda, const double bulk)
    {
      const std::string name = energy_names.name(energy);
      const Linearised  part = linearised(energy);
      if (part.shear != 1.)
        throw UserError("Scene/Energy: '" + name
                        + "' has half the shear modulus: no volumetric modulus makes a bar show "
                          "the E and nu given; choose linear, or, to compute what the paper "
                          "prints, Scene/Volumetric modulus = K");
      if (part.stress_at_rest && std::isfinite(bulk))
        throw UserError("Scene/Energy: '" + name
                        + "' has a stress at rest, which only an incompressible body can balance: "
                          "below Poisson ratio = 0.5 no volumetric modulus makes a bar show the E "
                          "and nu given; choose "
                        + (energy == Energy::mooney ? "stable neo-Hookean" : "Bonet-Wood")
                        + ", or Poisson ratio = 0.5, or, to compute what the paper prints, "
                          "Scene/Volumetric modulus = "
                        + (energy == Energy::mooney ? "lambda or K" : "K"));
      // K and lambda as they are: a sum would lose digits, and the zero of lambda.
      if (part.lambda == 0.)
        return lambda;
      if (part.lambda == -2. / 3.)
        return bulk;
      return lambda - part.lambda * mu;
    }
  } // namespace

  VolumetricStrain usual_volumetric_strain(const Energy energy)
  {
    return energy == Energy::linear || energy == Energy::linear_as_printed
               ? VolumetricStrain::trace
               : VolumetricStrain::linear;
  }

  Moduli moduli(const MaterialParameters &material)
  {
    const double E = material.youngs_modulus, nu = material.poisson_ratio;
    // At nu = 1/2 both denominators are exactly 0 and both moduli infinite.
    const double mu     = E / (2. * (1. + nu));
    const double bulk   = E / (3. * (1. - 2. * nu));
    const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
    switch (material.kappa)
      {
        case KappaConvention::lambda:
          return {mu, lambda, material.mooney_rivlin_ratio};
        case KappaConvention::bulk:
          return {mu, bulk, material.mooney_rivlin_ratio};
        case KappaConvention::consistent:
          return {mu,
                  consistent_kappa(material.energy, mu, lambda, bulk),
                  material.mooney_rivlin_ratio};
      }
    throw std::logic_error("moduli: a convention that is not known");
  }

  SmallStrain small_strain(const Energy energy, const Moduli &moduli)
  {
    const Linearised part   = linearised(energy);
    const double     shear  = part.shear * moduli.mu;
    const double     lambda = part.lambda * moduli.mu + moduli.kappa;
    if (std::isinf(lambda))
      return {3. * shear, .5};
    if (part.stress_at_rest)
      {
        const double none = std::numeric_limits<double>::quiet_NaN();
        return {none, none};
      }
    return {shear * (3. * lambda + 2. * shear) / (lambda + shear),
            lambda / (2. * (lambda + shear))};
  }
} // namespace isochor
