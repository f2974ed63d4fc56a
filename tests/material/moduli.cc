// What the moduli mean. The tangent of the displacement form at F = I gives the strain of a bar
// under a small uniaxial stress, and with it Young's modulus and Poisson ratio: for every energy
// and volumetric strain those that were asked for, if the convention is the consistent one. The
// paper's choice, K with neo-Hookean (32), has small-strain lambda = K, hence
//   nu' = K / (2 (K + mu)), with K and mu of nu: 0.3 becomes 0.342, 0.45 becomes 0.453.
// Large strain: uniaxial stretch l of an incompressible bar, the pressure eliminated by the free
// sides, has the nominal stress mu (l - l^-2): 1.75 mu at l = 2.

#include <isochor/material/distortional_energy.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include "../common/report.h"

#include <cmath>

using namespace isochor;
using testing::below;

namespace
{
  constexpr double youngs_modulus = 266e3; // Pa

  struct Bar
  {
    double E, nu;
  };

  Deformation stretched(const double along, const double across)
  {
    Deformation deformation;
    for (int k = 0; k < 9; ++k)
      deformation.F[k] = batch(k == 0 ? along : k % 4 == 0 ? across : 0.);
    deformation.complete();
    return deformation;
  }

  Bar small_strain_bar(const Energy energy, const VolumetricStrain strain, const Moduli &moduli)
  {
    const Deformation rest       = stretched(1., 1.);
    const auto        volumetric = evaluate(strain, rest.J);
    Response          response;
    make_distortional_energy(energy, moduli.mu)->evaluate(rest, true, response);
    add_volumetric(rest, volumetric, moduli.kappa * volumetric.phi, moduli.kappa, true, response);

    // Normal stresses by normal strains; stress (1, 0, 0) gives the strains (1, -nu, -nu) / E.
    dealii::FullMatrix<double> stiffness(3);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        stiffness(i, k) = response.A[9 * (4 * i) + 4 * k][0];
    stiffness.gauss_jordan();
    return {1. / stiffness(0, 0), -stiffness(1, 0) / stiffness(0, 0)};
  }

  double uniaxial_stress(const Energy energy, const VolumetricStrain strain, const double stretch)
  {
    const Deformation deformation = stretched(stretch, 1. / std::sqrt(stretch));
    const auto        volumetric  = evaluate(strain, deformation.J);
    Response          response;
    make_distortional_energy(energy, 1.)->evaluate(deformation, false, response);
    const Batch p = -response.P[4] / (volumetric.d_phi * deformation.cofactor[4]);
    add_volumetric(deformation, volumetric, p, 0., false, response);
    return response.P[0][0];
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  auto                                    &out = testing::out();
  out.precision(10);
  for (const Energy energy : {Energy::neo_hookean, Energy::bonet_wood})
    for (const VolumetricStrain strain : {VolumetricStrain::linear, VolumetricStrain::logarithmic})
      {
        out << energy_names.name(energy) << ", " << volumetric_strain_names.name(strain) << "\n";
        double error = 0;
        for (const double nu : {-0.4, 0.05, 0.3, 0.45, 0.499})
          {
            const Bar bar = small_strain_bar(
                energy, strain, moduli(youngs_modulus, nu, energy, KappaConvention::consistent));
            for (const double now : {std::abs(bar.E / youngs_modulus - 1.), std::abs(bar.nu - nu)})
              error = std::isnan(error) || error >= now ? error : now;
          }
        out << "  E and nu of a bar, consistent convention: " << below(error, 1e-10) << "\n";
        for (const double nu : {0.3, 0.45})
          out << "  nu = " << nu << " with kappa = K shows "
              << small_strain_bar(
                     energy, strain, moduli(youngs_modulus, nu, energy, KappaConvention::bulk))
                     .nu
              << "\n";
        for (const double stretch : {0.5, 1.5, 2.})
          out << "  incompressible, stretch " << stretch << ": stress / mu "
              << uniaxial_stress(energy, strain, stretch) << "\n";
      }

  for (const KappaConvention convention :
       {KappaConvention::consistent, KappaConvention::lambda, KappaConvention::bulk})
    {
      const Moduli m = moduli(youngs_modulus, .5, Energy::neo_hookean, convention);
      out << "nu = 0.5, " << kappa_convention_names.name(convention) << ": mu " << m.mu
          << ", kappa " << m.kappa << ", compliance " << m.compliance() << "\n";
    }
  const Moduli steel = moduli(210e9, .25, Energy::neo_hookean, KappaConvention::consistent);
  out << "E = 210e9, nu = 0.25: mu " << steel.mu << ", lambda " << steel.kappa << ", K "
      << moduli(210e9, .25, Energy::bonet_wood, KappaConvention::consistent).kappa << "\n";
}
