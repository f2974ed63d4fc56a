// The hyperelastic term of every element, energy and volumetric strain at a random state of finite
// strain: residual against differences of the value, tangent against differences of the
// residual, symmetry of the tangent; and what is known by hand: nothing acts at rest, rigid motions
// change nothing, an affine state has the energy density times the volume.

#include "../common/difference.h"
#include "../common/fields.h"
#include "../common/meshes.h"
#include "../common/report.h"

#include <isochor/form/elasticity.h>

#include <deal.II/base/symmetric_tensor.h>

#include <functional>

using namespace isochor;
using namespace isochor::testing;
namespace MPI = dealii::Utilities::MPI;

namespace
{
  constexpr double mu = 2.;

  template <int dim>
  void set(const Discretisation<dim>                                       &discretisation,
           const std::function<dealii::Tensor<1, dim>(dealii::Point<dim>)> &displacement,
           const double                                                     pressure,
           Vector                                                          &state)
  {
    interpolate(
        discretisation, displacement, [&](const auto &) { return pressure; }, state);
  }

  /// u = G X.
  template <int dim>
  auto affine(const dealii::Tensor<2, dim> &G)
  {
    return [G](const dealii::Point<dim> &X) { return G * dealii::Tensor<1, dim>(X); };
  }

  template <int dim>
  dealii::Tensor<2, dim> stretch_and_shear()
  {
    dealii::Tensor<2, dim> G;
    G[0][0] = 0.3;
    G[0][1] = 0.25;
    G[1][1] = -0.1;
    G[dim - 1][0] -= 0.1;
    return G;
  }

  /// psi_d and Phi for F = I + G, plane strain in 2D, from the formulas of the paper.
  template <int dim>
  std::pair<double, double>
  by_hand(const dealii::Tensor<2, dim> &G, const Energy energy, const VolumetricStrain strain)
  {
    const auto   F  = G + dealii::unit_symmetric_tensor<dim>();
    const double J  = dealii::determinant(F);
    const double I1 = F.norm_square() + (3 - dim);
    return {energy == Energy::neo_hookean ? mu / 2 * (I1 - 3) - mu * std::log(J)
                                          : mu / 2 * (std::pow(J, -2. / 3) * I1 - 3),
            strain == VolumetricStrain::linear ? J - 1 : std::log(J)};
  }

  template <int dim>
  void test(const Discretisation<dim> &discretisation,
            const Energy               energy,
            const VolumetricStrain     strain,
            const double               kappa)
  {
    const Elasticity<dim> term(discretisation, energy, strain, {mu, kappa});
    SparseMatrix          matrix;
    const CellOffsets     offsets = make_pattern(discretisation, matrix);

    // Random shifts of the nodes by a few percent of their distance on top of a finite strain.
    Vector       state = discretisation.make_vector();
    const double p     = 0.7;
    set<dim>(discretisation, affine<dim>(stretch_and_shear<dim>()), p, state);
    const auto   noise = random_vector(state, 1);
    const double size  = 0.04 / discretisation.element.displacement.degree;
    for (LocalIndex i = 0; i < state.locally_owned_size(); ++i)
      state.local_element(i)
          += noise.local_element(i) * (i < discretisation.n_owned_displacements ? size / 2. : 1.);
    state.update_ghost_values();
    const double min_jacobian = MPI::min(term.add(state, 1., {}).min_jacobian, MPI_COMM_WORLD);
    const auto   errors       = derivative_errors(term,
                                          state,
                                          1.,
                                          1e-4,
                                          matrix,
                                          offsets,
                                          discretisation.n_owned_displacements,
                                          discretisation.element.is_mixed());

    // Affine state: value by hand; C by equation (18).
    set<dim>(discretisation, affine<dim>(stretch_and_shear<dim>()), p, state);
    const auto [psi, phi] = by_hand<dim>(stretch_and_shear<dim>(), energy, strain);
    const double density  = psi
                           + (discretisation.element.is_mixed() ? p * phi - p * p / (2 * kappa)
                                                                : kappa / 2 * phi * phi);
    const double by_value = value(term, state, 1.);

    // Rest, also after a rotation by 0.5 and a shift.
    set<dim>(discretisation, affine<dim>({}), 0., state);
    double                 rest = residual(term, state, 1.).l2_norm();
    dealii::Tensor<2, dim> rotation;
    rotation[0][0] = rotation[1][1] = std::cos(0.5) - 1.;
    rotation[1][0]                  = std::sin(0.5);
    rotation[0][1]                  = -std::sin(0.5);
    set<dim>(
        discretisation,
        [&](const dealii::Point<dim> &X) {
          return rotation * dealii::Tensor<1, dim>(X) + dealii::Point<dim>::unit_vector(0);
        },
        0.,
        state);
    raise(rest, residual(term, state, 1.).l2_norm());

    out() << "  " << energy_names.name(energy) << ", Phi = " << volumetric_strain_names.name(strain)
          << ", kappa = " << kappa << ": J > 0: " << yes(min_jacobian > 0.1) << ", residual "
          << below(errors.residual, 1e-8) << ", tangent " << below(errors.tangent, 1e-8)
          << ", asymmetry " << below(errors.asymmetry, 1e-13) << ", value of an affine state "
          << below(std::abs(by_value / density - 1.), 1e-12) << ", residual at rest "
          << below(rest, 1e-13) << '\n';
  }

  template <int dim>
  void test()
  {
    const DistortedBoxes<dim> meshes(2);
    for (const Element &element : element_table())
      {
        out() << element.name << " in " << dim << "D\n";
        const Discretisation<dim> discretisation(meshes[element.kind].triangulation, element);
        const double              infinite = std::numeric_limits<double>::infinity();
        for (const Energy energy : {Energy::neo_hookean, Energy::bonet_wood})
          for (const auto strain : {VolumetricStrain::linear, VolumetricStrain::logarithmic})
            test(discretisation, energy, strain, 10.);
        if (element.is_mixed())
          test(discretisation, Energy::neo_hookean, VolumetricStrain::linear, infinite);
      }
  }
} // namespace

int main(int argc, char **argv)
{
  const MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
  const auto              mesh = distorted_box<2>(2);
  const Discretisation<2> discretisation(mesh->triangulation, find_element("P2", ""));
  out() << "P2 with infinite kappa: " << message_of<std::logic_error>([&]() {
    Elasticity<2>(discretisation,
                  Energy::neo_hookean,
                  VolumetricStrain::linear,
                  {mu, std::numeric_limits<double>::infinity()});
  }) << '\n';
}
