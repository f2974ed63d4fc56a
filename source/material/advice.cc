#include <isochor/material/advice.h>
#include <isochor/material/distortional_energy.h>

#include <cmath>
#include <sstream>

namespace isochor
{
  std::vector<std::string> advice(const MaterialParameters &material)
  {
    std::vector<std::string> sentences;
    const Moduli             m      = moduli(material);
    const SmallStrain        bar    = small_strain(material.energy, m);
    const auto               energy = make_distortional_energy(material.energy, m);
    const std::string        name   = energy_names.name(material.energy);

    if (std::isnan(bar.youngs_modulus))
      sentences.push_back("Scene/Energy: " + name
                          + " has a stress at rest, so that the body shrinks before any load acts; "
                            "at Poisson ratio = 0.5 it does not");
    else if (std::abs(bar.youngs_modulus / material.youngs_modulus - 1.) > 1e-3
             || std::abs(bar.poisson_ratio - material.poisson_ratio) > 1e-3)
      {
        std::ostringstream text;
        text.precision(4);
        text << "Scene/Energy: a bar of " << name
             << " with Scene/Volumetric modulus = " << kappa_convention_names.name(material.kappa)
             << ", stretched a little, shows Young's modulus " << bar.youngs_modulus
             << " Pa and Poisson ratio " << bar.poisson_ratio << ", not " << material.youngs_modulus
             << " Pa and " << material.poisson_ratio;
        sentences.push_back(text.str());
      }
    if (!energy->is_symmetric())
      sentences.push_back("Scene/Energy: the stress of " + name
                          + " is the gradient of no energy: its tangent is not symmetric, work "
                            "depends on the path, and the energies written are those of "
                            "Bonet-Wood");
    if (material.volumetric_strain == VolumetricStrain::trace && !energy->is_linear())
      sentences.push_back("Scene/Volumetric strain: trace changes when the body turns, which "
                          + name + " does not; choose J - 1, or Scene/Energy = linear");
    return sentences;
  }
} // namespace isochor
