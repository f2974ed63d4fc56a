// What the moduli mean. The tangent of the displacement form at F = I gives the strain of a bar
// under a small uniaxial stress, and with it Young's modulus and Poisson ratio: for every energy
// and volumetric strain those that were asked for, if the convention is the consistent one. Other
// conventions show, with K and mu of nu:
//   (32) with kappa = K, the first paper's choice: nu' = K / (2 (K + mu)), 0.3 becomes 0.342,
//   second paper (1, 14) with lambda: Lame's second parameter lambda - mu, 0.3 becomes 1/6,
//   (28) as printed with K: Lame's parameters mu / 2 and K - 4/3 mu.
// Large strain: uniaxial stretch l of an incompressible bar, the pressure eliminated by the free
// sides, has the nominal stress dpsi(l, l^-1/2, l^-1/2)/dl, of which each energy has its closed
// form; its slope at l = 1 is E. And what is refused, and what is said of a material.

#include <isochor/material/advice.h>

#include "deformations.h"

#include <deal.II/lac/full_matrix.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  constexpr double youngs_modulus = 266e3; // Pa

  SmallStrain bar(const Energy energy, const VolumetricStrain strain, const Moduli &moduli)
  {
    const Deformation rest       = diagonal(1., 1., 1.);
    const auto        volumetric = evaluate(strain, rest);
    Response          response;
    make_distortional_energy(energy, moduli)->evaluate(rest, true, response);
    add_volumetric(rest, volumetric, moduli.kappa * volumetric.phi, moduli.kappa, true, response);

    // Normal stresses by normal strains; stress (1, 0, 0) gives the strains (1, -nu, -nu) / E.
    dealii::FullMatrix<double> stiffness(3);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        stiffness(i, k) = response.A[9 * (4 * i) + 4 * k][0];
    stiffness.gauss_jordan();
    return {1. / stiffness(0, 0), -stiffness(1, 0) / stiffness(0, 0)};
  }

  double error_of(const SmallStrain &bar, const double E, const double nu)
  {
    double error = 0;
    raise(error, std::abs(bar.youngs_modulus / E - 1.));
    raise(error, std::abs(bar.poisson_ratio - nu));
    return error;
  }

  /// mu = 1, Mooney-Rivlin ratio 0.3
  double uniaxial_stress(const Energy energy, const VolumetricStrain strain, const double stretch)
  {
    const Deformation deformation
        = diagonal(stretch, 1. / std::sqrt(stretch), 1. / std::sqrt(stretch));
    const auto volumetric = evaluate(strain, deformation);
    Response   response;
    make_distortional_energy(energy, {1., 1., 0.3})->evaluate(deformation, false, response);
    const Batch p = -response.P[4] / volumetric.gradient[4];
    add_volumetric(deformation, volumetric, p, 0., false, response);
    return response.P[0][0];
  }

  /// The same by hand. With the principal stresses P_1, P_2 of psi_d: P_1 - l^-3/2 P_2 if the
  /// volume is that of J, P_1 - P_2 if it is the trace.
  double uniaxial_by_hand(const Energy energy, const double l)
  {
    const double across = 1. / std::sqrt(l);
    switch (energy)
      {
        case Energy::neo_hookean:
        case Energy::bonet_wood:
        case Energy::mooney:
        case Energy::simplified_bonet_wood:
        case Energy::stable_neo_hookean:
          return l - 1. / (l * l);
        case Energy::mooney_rivlin:
          return (0.7 + 0.3 / l) * (l - 1. / (l * l));
        case Energy::st_venant_kirchhoff: // mu E : E = mu/4 [(l^2 - 1)^2 + 2 (1/l - 1)^2]
          return l * (l * l - 1.) - (1. / l - 1.) / (l * l);
        case Energy::corotational: // mu [(l - 1)^2 + 2 (l^-1/2 - 1)^2]
          return 2. * (l - 1.) - 2. * (across - 1.) * across / l;
        case Energy::linear: // P_1 - P_2 = 2 mu (e_1 - e_2)
          return 2. * (l - across);
        case Energy::linear_as_printed:
          return l - across;
      }
    throw std::logic_error("an energy without a formula");
  }

  void energy_by_energy()
  {
    for (const std::string &name : energy_names.names())
      {
        const Energy energy  = energy_names.value(name, "");
        const bool   at_rest = energy != Energy::mooney && energy != Energy::simplified_bonet_wood;
        out() << name << "\n";
        if (at_rest && energy != Energy::linear_as_printed)
          {
            double error = 0, told = 0;
            for (const std::string &strain : volumetric_strain_names.names())
              for (const double nu : {-0.4, 0., 0.05, 0.3, 0.45, 0.499})
                {
                  const Moduli m
                      = moduli({youngs_modulus, nu, energy, {}, KappaConvention::consistent, 0.3});
                  const auto strain_kind = volumetric_strain_names.value(strain, "");
                  raise(error, error_of(bar(energy, strain_kind, m), youngs_modulus, nu));
                  raise(told, error_of(small_strain(energy, m), youngs_modulus, nu));
                }
            out() << "  E and nu of a bar, consistent convention: " << below(error, 1e-10)
                  << ", told " << below(told, 1e-10) << "\n";
          }
        if (at_rest)
          for (const auto convention : {KappaConvention::lambda, KappaConvention::bulk})
            {
              const Moduli m     = moduli({youngs_modulus, 0.3, energy, {}, convention});
              const auto   shown = bar(energy, usual_volumetric_strain(energy), m);
              const auto   told  = small_strain(energy, m);
              out() << "  nu = 0.3 with kappa = " << kappa_convention_names.name(convention)
                    << " shows E " << shown.youngs_modulus << ", nu " << shown.poisson_ratio
                    << ", told "
                    << below(error_of(told, shown.youngs_modulus, shown.poisson_ratio), 1e-10)
                    << "\n";
            }

        const VolumetricStrain strain = usual_volumetric_strain(energy);
        double                 large = 0, logarithmic = 0;
        for (const double stretch : {0.5, 0.8, 1.5, 2.})
          {
            const double by_hand = uniaxial_by_hand(energy, stretch);
            raise(large, std::abs(uniaxial_stress(energy, strain, stretch) / by_hand - 1.));
            if (strain == VolumetricStrain::linear)
              raise(
                  logarithmic,
                  std::abs(uniaxial_stress(energy, VolumetricStrain::logarithmic, stretch) / by_hand
                           - 1.));
          }
        const double h = 1e-4;
        out() << "  incompressible: stress of a bar " << below(large, 1e-13) << ", log J "
              << below(logarithmic, 1e-13) << ", E / mu "
              << (uniaxial_stress(energy, strain, 1. + h) - uniaxial_stress(energy, strain, 1. - h))
                     / (2. * h)
              << ", told "
              << small_strain(energy, {1., std::numeric_limits<double>::infinity()}).youngs_modulus
              << "\n";
      }
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  out().precision(7);
  energy_by_energy();

  for (const auto convention :
       {KappaConvention::consistent, KappaConvention::lambda, KappaConvention::bulk})
    {
      const Moduli m = moduli({youngs_modulus, .5, Energy::neo_hookean, {}, convention});
      out() << "nu = 0.5, " << kappa_convention_names.name(convention) << ": mu " << m.mu
            << ", kappa " << m.kappa << ", compliance " << m.compliance() << "\n";
    }
  out() << "nu = 0.5, Mooney: compliance "
        << moduli({1., .5, Energy::mooney, {}, KappaConvention::consistent}).compliance() << "\n";
  out() << "E = 210e9, nu = 0.25: mu "
        << moduli({210e9, .25, Energy::neo_hookean, {}, KappaConvention::consistent}).mu
        << ", lambda "
        << moduli({210e9, .25, Energy::neo_hookean, {}, KappaConvention::consistent}).kappa
        << ", lambda + mu "
        << moduli({210e9, .25, Energy::stable_neo_hookean, {}, KappaConvention::consistent}).kappa
        << ", K " << moduli({210e9, .25, Energy::bonet_wood, {}, KappaConvention::consistent}).kappa
        << "\n";

  out() << "Refused\n";
  for (const auto energy :
       {Energy::mooney, Energy::simplified_bonet_wood, Energy::linear_as_printed})
    try
      {
        moduli({1., .3, energy, {}, KappaConvention::consistent});
        out() << "  not refused\n";
      }
    catch (const UserError &error)
      {
        out() << "  " << error.what() << "\n";
      }

  out() << "Said\n";
  const auto say = [](const MaterialParameters &material) {
    const auto sentences = advice(material);
    out() << "  " << energy_names.name(material.energy) << ", " << material.poisson_ratio << ", "
          << volumetric_strain_names.name(material.volumetric_strain) << ", "
          << kappa_convention_names.name(material.kappa) << ":"
          << (sentences.empty() ? " nothing" : "") << "\n";
    for (const std::string &sentence : sentences)
      out() << "    " << sentence << "\n";
  };
  say({});
  say({1e6, .3, Energy::linear, VolumetricStrain::trace});
  say({1e6, .3, Energy::neo_hookean, VolumetricStrain::linear, KappaConvention::bulk});
  say({1e6, .3, Energy::neo_hookean, VolumetricStrain::trace});
  say({1e6, .3, Energy::stable_neo_hookean, VolumetricStrain::linear, KappaConvention::lambda});
  say({1e6, .5, Energy::mooney});
  say({1e6, .3, Energy::mooney, VolumetricStrain::linear, KappaConvention::lambda});
  say({1e6, .5, Energy::simplified_bonet_wood});
  say({1e6, .3, Energy::linear_as_printed, VolumetricStrain::trace, KappaConvention::bulk});
}
