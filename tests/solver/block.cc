// The block solver finds the equilibrium that MUMPS finds, to 1e-7 of it, near rest and at nu = 0.5,
// for the stable mixed elements and for a displacement element, on any number of ranks. Its iterations
// to 1e-8 in one linear solve (small strain) stay bounded, and grow by less than half from nu = 0.49 to
// 0.5 and from the middle to the finest of three meshes. It does not know negative pivots.

#include "../common/meshes.h"
#include "../common/solve.h"
#include "../common/supports.h"

#include <isochor/form/loads.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  Scene<dim> clamped_and_pulled(const double poisson_ratio, const bool is_linear)
  {
    Scene<dim> scene = isochor::testing::clamped_and_pulled<dim>(poisson_ratio);
    if (is_linear)
      {
        scene.material.energy            = Energy::linear;
        scene.material.volumetric_strain = VolumetricStrain::trace;
      }
    return scene;
  }

  template <int dim>
  Solution<dim> solved(const Mesh<dim>           &mesh,
                       const Discretisation<dim> &discretisation,
                       const LinearSolver         solver,
                       const double               poisson_ratio,
                       const bool                 is_linear)
  {
    SolveOptions options;
    options.tolerance     = is_linear ? 1e-8 : 1e-10;
    options.linear.solver = solver;
    return solve(mesh, discretisation, clamped_and_pulled<dim>(poisson_ratio, is_linear), options);
  }

  template <int dim>
  void compare(const Mesh<dim> &mesh, const Element &element, const double poisson_ratio)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    const auto direct = solved(mesh, discretisation, LinearSolver::direct, poisson_ratio, false);
    const auto block  = solved(mesh, discretisation, LinearSolver::block, poisson_ratio, false);
    Vector     apart(block.state);
    apart -= direct.state;
    out() << "  " << element.name << " in " << dim << "D, nu = " << poisson_ratio << ": "
          << run_status_names.name(block.report.status) << block.report.reason << ", states apart "
          << below(apart.linfty_norm() / direct.state.linfty_norm(), 1e-7)
          << ", preconditioners fewer than iterations of Newton "
          << yes(block.statistics.factorisations < block.report.newton_iterations)
          << ", pivots known " << yes(block.statistics.pivot_excess.has_value()) << '\n';
  }

  template <int dim>
  unsigned int iterations(const Element &element, const unsigned int n, const double poisson_ratio)
  {
    const auto                mesh = make_mesh<dim>(box_request<dim>(n), MPI_COMM_WORLD);
    const Discretisation<dim> discretisation(mesh->triangulation, element);
    return solved(*mesh, discretisation, LinearSolver::block, poisson_ratio, true)
        .statistics.krylov_iterations;
  }

  template <int dim>
  void check_flatness(const Element &element, const unsigned int n, const unsigned int bound)
  {
    const double by_mesh[] = {double(iterations<dim>(element, n / 2, 0.5)),
                              double(iterations<dim>(element, n, 0.5)),
                              double(iterations<dim>(element, 2 * n, 0.5))};
    const double by_nu[]   = {double(iterations<dim>(element, n, 0.3)),
                              double(iterations<dim>(element, n, 0.49)),
                              double(iterations<dim>(element, n, 0.4999))};
    double       most      = 0;
    for (const double count : {by_mesh[0], by_mesh[1], by_mesh[2], by_nu[0], by_nu[1], by_nu[2]})
      raise(most, count);
    out() << "  " << element.name << " in " << dim << "D: iterations at most " << bound << ' '
          << yes(most > 0 && most <= bound) << ", flat in the mesh "
          << yes(by_mesh[2] <= 1.5 * by_mesh[1]) << ", in nu "
          << yes(by_mesh[1] <= 1.5 * by_nu[1] && by_nu[2] <= 1.5 * by_nu[1]) << '\n';
    if (most > bound || by_mesh[2] > 1.5 * by_mesh[1])
      out() << "    " << by_mesh[0] << ' ' << by_mesh[1] << ' ' << by_mesh[2] << ", " << by_nu[0]
            << ' ' << by_nu[1] << ' ' << by_nu[2] << '\n';
  }

  template <int dim>
  void test()
  {
    const DistortedBoxes<dim> meshes(dim == 2 ? 8 : 3);
    for (const std::string name : {"P1-P1s", "MINI", "P2-P1"})
      for (const double poisson_ratio : {0.3, 0.5})
        compare(meshes[CellKind::simplex], find_element(name, ""), poisson_ratio);
    compare(meshes[CellKind::simplex], find_element("P2", ""), 0.3);
    compare(meshes[CellKind::hypercube], find_element("Q2-P1", ""), 0.4999);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
  check_flatness<2>(find_element("P1-P1s", ""), 16, 80);
  check_flatness<2>(find_element("MINI", ""), 16, 120);
  check_flatness<2>(find_element("P2-P1", ""), 20, 110); // coarser, one level is solved exactly
  check_flatness<3>(find_element("P1-P1s", ""), 4, 60);
  check_flatness<3>(find_element("MINI", ""), 4, 120);
  check_flatness<3>(find_element("P2-P1", ""), 2, 80);
}
