// Dual ascent ends in Newton's equilibrium: displacements and pressures, every kind of pair, finite and
// infinite kappa. At most 6 iterations to a volume error of 1 %, as the paper found (section 8.3).
// Acceleration takes fewer iterations; without augmentation the same solution where there is one.

#include "../common/meshes.h"
#include "../common/solve.h"
#include "../common/supports.h"

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  Solution<dim> solved(const Mesh<dim>                  &mesh,
                       const Discretisation<dim>        &discretisation,
                       const double                      poisson_ratio,
                       const std::optional<DualOptions> &dual)
  {
    SolveOptions options;
    options.tolerance = 1e-9;
    options.dual      = dual;
    return solve(mesh, discretisation, clamped_and_pulled<dim>(poisson_ratio), options);
  }

  double difference(const Vector &a, const Vector &b)
  {
    Vector d(a.get_partitioner());
    d = a;
    d -= b;
    return d.linfty_norm() / a.linfty_norm();
  }

  DualOptions with(const double augmentation, const DualAcceleration acceleration)
  {
    DualOptions options;
    options.augmentation_poisson_ratio = augmentation;
    options.acceleration               = acceleration;
    options.max_iterations             = 1000;
    return options;
  }

  template <int dim>
  void same_as_newton(const Mesh<dim> &mesh, const Element &element, const double poisson_ratio)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    const auto                newton = solved(mesh, discretisation, poisson_ratio, {});
    out() << "  " << element.name << " in " << dim << "D, nu = " << poisson_ratio << '\n';
    std::array<unsigned int, 3> iterations;
    // The test of three dimensions is to be short.
    for (const double augmentation :
         dim == 2 ? std::vector<double>{0.4, 0.} : std::vector<double>{0.4})
      {
        for (const auto acceleration :
             {DualAcceleration::none, DualAcceleration::cg, DualAcceleration::anderson})
          {
            const auto dual
                = solved(mesh, discretisation, poisson_ratio, with(augmentation, acceleration));
            iterations[static_cast<unsigned int>(acceleration)] = dual.dual.iterations;
            out() << "    " << (augmentation > 0. ? "augmented" : "not augmented") << ", "
                  << dual_acceleration_names.name(acceleration) << ": "
                  << run_status_names.name(dual.report.status) << dual.report.reason
                  << ", states apart " << below(difference(newton.state, dual.state), 1e-6)
                  << ", at most 6 iterations to 1 %: "
                  << yes(dual.dual.to_one_percent > 0 && dual.dual.to_one_percent <= 6)
                  << ", certified " << yes(dual.statistics.pivot_excess == 0) << '\n';
          }
        out() << "    acceleration takes fewer iterations: "
              << yes(iterations[1] < iterations[0] && iterations[2] < iterations[0]) << '\n';
      }
  }

  template <int dim>
  void test()
  {
    const DistortedBoxes<dim> meshes(dim == 2 ? 5 : 2);
    for (const auto &[name, nu] : {std::pair("P1-P1", 0.49),
                                   std::pair("P1-P1s", 0.5),
                                   std::pair("P2-P1", 0.5),
                                   std::pair("Q2-P1", 0.49)})
      {
        const Element &element = find_element(name, "");
        same_as_newton(meshes[element.kind], element, nu);
      }
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
}
