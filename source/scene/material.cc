#include "parts.h"

#include <isochor/core/patterns.h>

namespace isochor::scene_parts
{
  namespace Patterns = dealii::Patterns;

  void declare_material(dealii::ParameterHandler &prm)
  {
    const Material defaults;

    prm.declare_entry("Young's modulus",
                      to_text(defaults.youngs_modulus),
                      NumberPattern::above(0),
                      "Stiffness E of a bar stretched a little, in Pa, greater than 0. Example: "
                      "266e3");
    prm.declare_entry("Poisson ratio",
                      to_text(defaults.poisson_ratio),
                      NumberPattern::above(-1).and_at_most(0.5),
                      "Poisson ratio nu at small strain, greater than -1 and at most 0.5 "
                      "(incompressible; mixed elements only). No unit. Example: 0.4999");
    prm.declare_entry("Density",
                      to_text(defaults.density),
                      NumberPattern::at_least(0),
                      "Mass per reference volume in kg/m^3, at least 0. Example: 1070");
    prm.declare_entry("Energy",
                      energy_names.name(defaults.energy),
                      Patterns::Selection(energy_names.selection()),
                      "Distortional energy psi_d; equation numbers of Francu et al. 2021. "
                      "neo-Hookean: mu/2 (I1 - 3) - mu log J (32). "
                      "Bonet-Wood: mu/2 (J^(-2/3) I1 - 3) (30). "
                      "Mooney: mu/2 (I1 - 3) (29), a stress mu at rest, for Poisson ratio = 0.5. "
                      "simplified Bonet-Wood: stress mu J^(-2/3) F of no energy (31), a stress mu "
                      "at rest, for Poisson ratio = 0.5. "
                      "stable neo-Hookean: mu/2 (I1 - 3) - mu (J - 1), equations 1 and 14 of "
                      "Macklin and Mueller 2021 with gamma = 1 + mu / kappa. "
                      "Mooney-Rivlin: c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3), uncoupled, see "
                      "Mooney-Rivlin ratio; FEBio's with Volumetric strain = log J. "
                      "St. Venant-Kirchhoff: mu E : E, E = (F^T F - 1) / 2; softens in "
                      "compression. "
                      "corotational: mu |F - R|^2, R the rotation nearest to F. "
                      "linear: small strain, mu (eps : eps - tr(eps)^2 / 3) (28); with Volumetric "
                      "strain = trace, Hooke's law in one Newton iteration. "
                      "linear as printed: mu/2 eps : eps - 2/3 mu tr(eps)^2, which is (28) with "
                      "its misprints.");
    prm.declare_entry(
        "Mooney-Rivlin ratio",
        to_text(defaults.mooney_rivlin_ratio),
        NumberPattern::at_least(0).and_at_most(1),
        "Share c2 / (c1 + c2) of the second invariant in the Mooney-Rivlin energy, "
        "between 0 (which is Bonet-Wood) and 1; E and nu give c1 + c2 = mu / 2. Other "
        "energies do not read it. No unit. Example: 0.2");
    prm.declare_entry("Volumetric strain",
                      "automatic",
                      Patterns::Selection("automatic|" + volumetric_strain_names.selection()),
                      "Measure Phi of the change of volume, J = det F: J - 1, log J, or, for small "
                      "strain, trace: tr(F - 1) = div u. automatic: trace for the linear energies, "
                      "J - 1 for all others. No unit.");
    prm.declare_entry("Volumetric modulus",
                      kappa_convention_names.name(defaults.kappa),
                      Patterns::Selection(kappa_convention_names.selection()),
                      "Which modulus kappa multiplies Phi^2 / 2. consistent: the one with which a "
                      "bar stretched a little shows the E and nu given here; lambda: E nu / ((1 + "
                      "nu)(1 - 2 nu)), the choice of Macklin and Mueller, which turns nu = 0.3 "
                      "into 0.167 with stable neo-Hookean; K: E / (3 (1 - 2 nu)), the choice of "
                      "Francu et al., which turns nu = 0.3 into 0.342 with neo-Hookean.");
  }

  Material parse_material(dealii::ParameterHandler &prm)
  {
    // The patterns have checked what the numbers may be.
    Material   material;
    const auto number
        = [&](const std::string &key) { return parse_number(prm.get(key), "Scene/" + key); };
    material.youngs_modulus  = number("Young's modulus");
    material.poisson_ratio   = number("Poisson ratio");
    material.density         = number("Density");
    material.energy          = energy_names.value(prm.get("Energy"), "Scene/Energy");
    const std::string strain = prm.get("Volumetric strain");
    material.volumetric_strain
        = strain == "automatic" ? usual_volumetric_strain(material.energy)
                                : volumetric_strain_names.value(strain, "Scene/Volumetric strain");
    material.mooney_rivlin_ratio = number("Mooney-Rivlin ratio");
    material.kappa
        = kappa_convention_names.value(prm.get("Volumetric modulus"), "Scene/Volumetric modulus");
    return material;
  }
} // namespace isochor::scene_parts
