// Eliminating bubbles, discontinuous pressures or a lumped continuous pressure first is the same as
// keeping them: the same Newton iterations, states and inertia, for every element and on several
// ranks. With the lumped compliance matrix the solution itself is another one, by a little.

#include "../common/meshes.h"
#include "../common/solve.h"
#include "../common/supports.h"

#include <isochor/form/loads.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  Solution<dim> solved(const Mesh<dim>           &mesh,
                       const Discretisation<dim> &discretisation,
                       const Condensation         condensation,
                       const bool                 lumped,
                       const double               poisson_ratio)
  {
    SolveOptions options;
    options.linear.condensation = condensation;
    options.compliance.lumped   = lumped;
    return solve(mesh, discretisation, clamped_and_pulled<dim>(poisson_ratio), options);
  }

  double difference(const Vector &a, const Vector &b)
  {
    Vector d(a.get_partitioner());
    d = a;
    d -= b;
    return d.linfty_norm() / a.linfty_norm();
  }

  template <int dim>
  double displacement_difference(const Discretisation<dim> &discretisation, Vector a, Vector b)
  {
    for (LocalIndex i = discretisation.n_owned_displacements; i < a.locally_owned_size(); ++i)
      a.local_element(i) = b.local_element(i) = 0.;
    return difference(a, b);
  }

  template <int dim>
  void compare(const Mesh<dim>   &mesh,
               const Element     &element,
               const Condensation condensation,
               const bool         lumped,
               const double       poisson_ratio)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    const auto kept      = solved(mesh, discretisation, Condensation::none, lumped, poisson_ratio);
    const auto condensed = solved(mesh, discretisation, condensation, lumped, poisson_ratio);
    out() << "  " << element.name << " in " << dim << "D, nu = " << poisson_ratio << ", "
          << condensation_names.name(condensation) << ": "
          << run_status_names.name(condensed.report.status) << condensed.report.reason
          << ", states apart " << below(difference(kept.state, condensed.state), 1e-9)
          << ", same iterations "
          << yes(kept.report.newton_iterations == condensed.report.newton_iterations)
          << ", pivot excess " << kept.statistics.pivot_excess.value_or(-1) << ' '
          << condensed.statistics.pivot_excess.value_or(-1) << '\n';
    if (lumped)
      {
        const auto consistent
            = solved(mesh, discretisation, Condensation::none, false, poisson_ratio);
        const double apart = displacement_difference(discretisation, consistent.state, kept.state);
        out() << "    the consistent matrix gives another displacement, by a little: "
              << yes(apart > 1e-6 && apart < 0.1) << '\n';
      }
  }

  template <int dim>
  void test()
  {
    const DistortedBoxes<dim> meshes(dim == 2 ? 6 : 3);
    for (const Element &element : element_table())
      if (element.has_bubble() || element.has_discontinuous_pressure())
        compare(meshes[element.kind], element, Condensation::cells, false, 0.4999);
    for (const std::string name : {"P1-P1", "MINI", "P2-P1"})
      compare(
          meshes[CellKind::simplex], find_element(name, ""), Condensation::pressure, true, 0.45);
    // At nu = 0.5 the bubble is eliminated, a discontinuous pressure kept.
    for (const std::string name : {"MINI", "P2-P0"})
      if (dim == 2 || name == "MINI")
        compare(meshes[CellKind::simplex], find_element(name, ""), Condensation::cells, false, 0.5);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
}
