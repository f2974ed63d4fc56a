// Patch test, at finite strain: where the boundary asks for an affine displacement with J = 1, the
// affine displacement and a constant pressure are the exact solution for every element on
// every mesh.
// nu = 0.4999: all sides prescribed, p = 0. From any state the first Newton step moves all nodes
// to the affine field, the second gives mixed elements their pressure.
// nu = 0.5: left side prescribed and the tractions of the exact stress P N on all others, because
// with all sides prescribed nothing determines the constant of the pressure.

#include "../common/meshes.h"
#include "../common/report.h"
#include "../common/solve.h"
#include "../common/supports.h"

#include <deal.II/base/symmetric_tensor.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  /// det F = 1.
  template <int dim>
  dealii::Tensor<2, dim> deformation_gradient()
  {
    dealii::Tensor<2, dim> F;
    F[0][0] = 1.2;
    F[0][1] = 0.3;
    F[1][0] = 0.1;
    F[1][1] = (1. + 0.3 * 0.1) / 1.2;
    if constexpr (dim == 3)
      {
        F[0][2] = 0.2;
        F[1][2] = -0.1;
        F[2][2] = 1.;
      }
    return F;
  }

  template <int dim>
  dealii::Tensor<1, dim> affine(const dealii::Point<dim> &X)
  {
    const auto G = deformation_gradient<dim>() - dealii::unit_symmetric_tensor<dim>();
    return G * dealii::Tensor<1, dim>(X);
  }

  template <int dim>
  void report(const std::string         &title,
              const Discretisation<dim> &discretisation,
              const Solution<dim>       &solution,
              const double               pressure)
  {
    const auto error = distance(discretisation, solution.state, affine<dim>, pressure);
    out() << "  " << discretisation.element.name << ", " << title << ": "
          << run_status_names.name(solution.report.status) << ", displacement "
          << below(error[0], 1e-10);
    if (discretisation.element.is_mixed())
      out() << ", pressure " << below(error[1], 1e-9) << ", pivot excess "
            << solution.statistics.pivot_excess.value_or(-1);
    if (!solution.report.reason.empty())
      out() << ": " << solution.report.reason;
    out() << '\n';
  }

  template <int dim>
  void all_prescribed(const Mesh<dim> &mesh, const Element &element, const Energy energy)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    Scene<dim>                scene;
    scene.material.youngs_modulus = 3.;
    scene.material.poisson_ratio  = 0.4999;
    scene.material.energy         = energy;
    for (const std::string &side : box_sides<dim>)
      scene.supports.push_back(
          held<dim>(side, all_components<dim>, [](const dealii::Point<dim> &X, const double load) {
            return load * affine(X);
          }));
    // Exact solves: inexact Newton takes more iterations.
    SolveOptions options;
    options.linear.solver = LinearSolver::direct;
    const auto solution   = solve(mesh, discretisation, scene, options);
    report("nu = 0.4999, " + energy_names.name(energy), discretisation, solution, 0.);
    out() << "    one load step: " << yes(solution.report.load_steps == 1)
          << ", Newton iterations as expected, or one more for rounding: "
          << yes(solution.report.newton_iterations <= (element.is_mixed() ? 3 : 2)) << '\n';
  }

  template <int dim>
  void traction(const Mesh<dim> &mesh, const Element &element)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    Scene<dim>                scene;
    scene.material.youngs_modulus = 3.; // mu = 1
    scene.material.poisson_ratio  = 0.5;
    scene.supports.push_back(
        held<dim>("left", all_components<dim>, [](const dealii::Point<dim> &X, const double load) {
          return load * affine(X);
        }));

    // P = mu (F - F^-T) + p cof F, equation (32) with Phi = J - 1.
    const double pressure = 0.3;
    const auto   F        = deformation_gradient<dim>();
    const auto   cofactor = dealii::transpose(dealii::invert(F));
    const auto   P        = F - cofactor + pressure * cofactor;
    for (unsigned int side = 1; side < 2 * dim; ++side)
      {
        const auto normal = (side % 2 ? 1. : -1.) * dealii::Point<dim>::unit_vector(side / 2);
        const auto t      = P * dealii::Tensor<1, dim>(normal);
        std::vector<Expression<dim>> components;
        for (unsigned int c = 0; c < dim; ++c)
          {
            std::ostringstream text;
            text.precision(17);
            text << t[c];
            components.emplace_back(text.str(), "test");
          }
        scene.tractions.push_back({box_sides<dim>[side], components});
      }
    SolveOptions options;
    options.load_steps = 3;
    report("nu = 0.5", discretisation, solve(mesh, discretisation, scene, options), pressure);
  }

  template <int dim>
  void test()
  {
    const DistortedBoxes<dim> distorted(dim == 2 ? 4 : 3);
    const auto                by_gmsh = gmsh_box<dim>(dim == 2 ? 0.25 : 0.35);
    out() << dim << "D, distorted mesh\n";
    for (const Element &element : element_table())
      for (const Energy energy : {Energy::neo_hookean, Energy::bonet_wood})
        all_prescribed(distorted[element.kind], element, energy);
    out() << dim << "D, tetrahedra and triangles by gmsh, distorted hexahedra and quadrilaterals\n";
    for (const Element &element : element_table())
      // P1-P0 has more pressures than displacements can feel: singular at nu = 0.5.
      if (element.is_mixed() && element.name != "P1-P0")
        traction(element.kind == CellKind::simplex ? *by_gmsh : distorted[element.kind], element);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
}
