// Homogeneous deformations of a unit block, incompressible neo-Hookean (nu = 0.5), mixed elements on
// unstructured meshes: nominal and Cauchy stresses of VERIFICATION.md. The stress is taken from the
// reactions R at the supports alone: by virtual work with u = G X, sum_nodes R_i X_J = V P_iJ.
//   uniaxial, stretch l:      P_11 = mu (l - l^-2);  l = 2: 1.75 mu
//   equibiaxial:              P_11 = mu (l - l^-5);  l = 2: 1.96875 mu
//   pure shear:               P_11 = mu (l - l^-3);  l = 2: 1.875 mu
//   simple shear g:           s_12 = mu g, s_11 - s_22 = mu g^2;  g = 0.8: 0.8 mu, 0.64 mu
// Then a compressible bar stretched by 1e-7 must show the E and nu that were asked for, to 1e-6.

#include "../common/meshes.h"
#include "../common/report.h"
#include "../common/solve.h"
#include "../common/supports.h"

#include <deal.II/base/symmetric_tensor.h>

using namespace isochor;
using namespace isochor::testing;
namespace MPI = dealii::Utilities::MPI;

namespace
{
  template <int dim>
  dealii::Tensor<2, dim> nominal_stress(const Discretisation<dim> &discretisation,
                                        const Vector              &reactions)
  {
    const auto            &cells = discretisation.cells;
    std::vector<bool>      seen(discretisation.n_owned_displacements);
    dealii::Tensor<2, dim> P;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        {
          const LocalIndex head = cells.x[cell * cells.n_x + a];
          if (head >= cells.n_owned_unknowns || seen[head])
            continue;
          seen[head]   = true;
          const auto X = cells.position(cell, discretisation.x_shape.node(a));
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int J = 0; J < dim; ++J)
              P[i][J] += reactions.local_element(head + i) * X[J];
        }
    return MPI::sum(P, MPI_COMM_WORLD);
  }

  template <int dim>
  struct Case
  {
    std::string               name;
    dealii::Tensor<2, dim>    F;
    std::vector<Support<dim>> supports;
  };

  template <int dim>
  dealii::Tensor<2, dim> diagonal(const std::array<double, 3> &stretches)
  {
    dealii::Tensor<2, dim> F;
    for (unsigned int d = 0; d < dim; ++d)
      F[d][d] = stretches[d];
    return F;
  }

  /// Moves a side of the block as far as F asks.
  template <int dim>
  auto follows(const dealii::Tensor<2, dim> &F)
  {
    return [F](const dealii::Point<dim> &X, const double load) {
      const dealii::Tensor<1, dim> x(X);
      return load * (F * x - x);
    };
  }

  template <int dim>
  std::vector<Support<dim>> rollers()
  {
    std::vector<Support<dim>> supports{held<dim>("left", "x"), held<dim>("bottom", "y")};
    if (dim == 3)
      supports.push_back(held<dim>("back", "z"));
    return supports;
  }

  template <int dim>
  std::vector<Case<dim>> cases()
  {
    std::vector<Case<dim>> cases;
    if constexpr (dim == 2)
      cases.push_back({"pure shear", diagonal<dim>({{2., 0.5, 1.}}), rollers<dim>()});
    else
      {
        const double r = 1. / std::sqrt(2.);
        cases.push_back({"uniaxial", diagonal<dim>({{2., r, r}}), rollers<dim>()});
        cases.push_back({"equibiaxial", diagonal<dim>({{2., 2., 0.25}}), rollers<dim>()});
        cases.back().supports.push_back(held<dim>("top", "y", follows(cases.back().F)));
      }
    for (auto &c : cases)
      c.supports.push_back(held<dim>("right", "x", follows(c.F)));

    // The top may move up and down, which makes s_22 = 0.
    Case<dim> shear{"simple shear", diagonal<dim>({{1., 1., 1.}}), {}};
    shear.F[0][1] = 0.8;
    for (const std::string side : {"left", "right", "bottom"})
      shear.supports.push_back(held<dim>(side, "xy", follows(shear.F)));
    shear.supports.push_back(held<dim>("top", "x", follows(shear.F)));
    if (dim == 3)
      for (const std::string side : {"back", "front"})
        shear.supports.push_back(held<dim>(side, "z"));
    cases.push_back(shear);
    return cases;
  }

  template <int dim>
  void incompressible(const Mesh<dim> &mesh, const Element &element)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    for (const auto &c : cases<dim>())
      {
        Scene<dim> scene;
        scene.material.youngs_modulus = 6e5; // mu = 2e5 Pa
        scene.material.poisson_ratio  = 0.5;
        scene.supports                = c.supports;
        SolveOptions options;
        options.load_steps  = 4;
        const auto solution = solve(mesh, discretisation, scene, options);

        const auto P = nominal_stress(discretisation, solution.reactions) / 2e5;
        const auto s = P * dealii::transpose(c.F);
        const auto u = [&](const dealii::Point<dim> &X) { return follows(c.F)(X, 1.); };
        out() << "  " << c.name << ": " << run_status_names.name(solution.report.status)
              << solution.report.reason << ", field "
              << below(distance(discretisation, solution.state, u, 0.)[0], 1e-9);
        if (c.name == "simple shear")
          out() << ", s_12 / mu = " << s[0][1] << ", (s_11 - s_22) / mu = " << s[0][0] - s[1][1];
        else
          out() << ", P_11 / mu = " << P[0][0];
        if (c.name == "equibiaxial")
          out() << ", P_22 / mu = " << P[1][1];
        double lateral = 0;
        for (unsigned int d = c.name == "equibiaxial" ? 2 : 1; d < dim; ++d)
          raise(lateral, std::abs(P[d][d]));
        if (c.name != "simple shear")
          out() << ", on the free sides " << below(lateral, 1e-9);
        out() << '\n';
      }
  }

  void bar(const Mesh<3> &mesh, const Energy energy, const VolumetricStrain strain)
  {
    for (const std::string name : {"P1", "P2-P1"})
      for (const double nu : {0., 0.3, 0.45})
        {
          const Discretisation<3> discretisation(mesh.triangulation, find_element(name, ""));
          Scene<3>                scene;
          scene.material.youngs_modulus    = 6e5;
          scene.material.poisson_ratio     = nu;
          scene.material.energy            = energy;
          scene.material.volumetric_strain = strain;
          // A mixed element at nu = 0 has kappa = lambda = 0; that is not what it is for.
          if (name != "P1" && nu == 0. && energy == Energy::neo_hookean)
            continue;
          const double stretch = 1e-7;
          scene.supports       = rollers<3>();
          const auto F = diagonal<3>({{1. + stretch, 1. - nu * stretch, 1. - nu * stretch}});
          scene.supports.push_back(held<3>("right", "x", follows(F)));
          SolveOptions options;
          options.tolerance   = 1e-10;
          const auto solution = solve(mesh, discretisation, scene, options);
          const auto P        = nominal_stress(discretisation, solution.reactions);
          const auto u        = [&](const dealii::Point<3> &X) { return follows(F)(X, 1.); };
          out() << "  " << name << ", " << energy_names.name(energy) << ", "
                << volumetric_strain_names.name(strain) << ": "
                << run_status_names.name(solution.report.status) << solution.report.reason
                << ", E asked for " << below(std::abs(P[0][0] / stretch / 6e5 - 1.), 1e-6)
                << ", nu = " << nu << ' '
                << below(distance(discretisation, solution.state, u, 0.)[0] / stretch, 1e-6)
                << '\n';
        }
  }
} // namespace

int main(int argc, char **argv)
{
  const MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto                  square = gmsh_box<2>(0.25);
  const auto                  cube   = gmsh_box<3>(0.35);
  const auto                  quads  = distorted_box<2>(4, CellKind::hypercube);
  const auto                  hexes  = distorted_box<3>(3, CellKind::hypercube);
  for (const Element &element : element_table())
    // P1-P0 has more pressures than displacements can feel: singular at nu = 0.5.
    if (element.is_mixed() && element.name != "P1-P0")
      {
        out() << element.name << " in 2D\n";
        incompressible(element.kind == CellKind::simplex ? *square : *quads, element);
        out() << element.name << " in 3D\n";
        incompressible(element.kind == CellKind::simplex ? *cube : *hexes, element);
      }
  out() << "small strain, deviations\n";
  const auto block = distorted_box<3>(2);
  for (const Energy energy : {Energy::neo_hookean, Energy::bonet_wood})
    for (const auto strain : {VolumetricStrain::linear, VolumetricStrain::logarithmic})
      bar(*block, energy, strain);
}
