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
                      "Distortional energy. neo-Hookean: mu/2 (I1 - 3) - mu log J (equation 32 of "
                      "Francu et al. 2021); Bonet-Wood: mu/2 (J^(-2/3) I1 - 3) (equation 30).");
    prm.declare_entry("Volumetric strain",
                      volumetric_strain_names.name(defaults.volumetric_strain),
                      Patterns::Selection(volumetric_strain_names.selection()),
                      "Measure Phi of the change of volume J = det F: J - 1, or log J. No unit.");
    prm.declare_entry("Volumetric modulus",
                      kappa_convention_names.name(defaults.kappa),
                      Patterns::Selection(kappa_convention_names.selection()),
                      "Which modulus kappa multiplies Phi^2 / 2. consistent: the one with which a "
                      "bar stretched a little shows the E and nu given here; lambda: E nu / ((1 + "
                      "nu)(1 - 2 nu)); K: E / (3 (1 - 2 nu)), the choice of Francu et al., which "
                      "turns nu = 0.3 into 0.342 with the neo-Hookean energy.");
  }

  Material parse_material(dealii::ParameterHandler &prm)
  {
    // The patterns have checked what the numbers may be.
    Material   material;
    const auto number
        = [&](const std::string &key) { return parse_number(prm.get(key), "Scene/" + key); };
    material.youngs_modulus = number("Young's modulus");
    material.poisson_ratio  = number("Poisson ratio");
    material.density        = number("Density");
    material.energy         = energy_names.value(prm.get("Energy"), "Scene/Energy");
    material.volumetric_strain
        = volumetric_strain_names.value(prm.get("Volumetric strain"), "Scene/Volumetric strain");
    material.kappa
        = kappa_convention_names.value(prm.get("Volumetric modulus"), "Scene/Volumetric modulus");
    return material;
  }
} // namespace isochor::scene_parts
