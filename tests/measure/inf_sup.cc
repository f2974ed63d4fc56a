// The inf-sup test on the unit cube with all faces held, split into 6 tetrahedra per block, n = 2, 4:
// figures of VERIFICATION.md (computed by another code with dense eigenvalues). And in 2D.

#include "../common/meshes.h"
#include "../common/report.h"
#include "../common/supports.h"

#include <isochor/measure/inf_sup.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  void test(const Element &element, const std::vector<unsigned int> &sizes, const bool all_sides)
  {
    for (const unsigned int n : sizes)
      {
        const auto mesh = make_mesh<dim>(box_request<dim>(n, element.kind), MPI_COMM_WORLD);
        const Discretisation<dim> discretisation(mesh->triangulation, element);
        std::vector<Support<dim>> supports;
        for (const std::string &side : box_sides<dim>)
          if (all_sides || side == "left")
            supports.push_back(
                held<dim>(side, all_components<dim>, [](const dealii::Point<dim> &, double) {
                  return dealii::Tensor<1, dim>();
                }));
        const PrescribedDisplacements<dim> prescribed(
            discretisation, supports, [&](const std::string &name, const std::string &what) {
              return mesh->boundary_id(name, what);
            });
        const auto result = inf_sup(
            discretisation, prescribed, VolumetricStrain::linear, 1., discretisation.make_vector());
        out() << "  " << element.name << " in " << dim << "D, n = " << n << ": ";
        if (!result)
          out() << "no pressure\n";
        else
          out() << "beta = " << result->constant << ", spurious modes " << result->spurious_modes
                << ", hydrostatic " << yes(result->has_hydrostatic_mode) << '\n';
      }
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  out().precision(3);
  out() << "all sides held\n";
  for (const Element &element : element_table())
    {
      test<2>(element, {4, 8}, true);
      if (element.displacement.degree < 3)
        test<3>(element, {2, 4}, true);
    }
  out() << "one side held\n";
  for (const std::string name : {"P1-P1", "P1-P1s", "MINI", "P2-P1"})
    test<3>(find_element(name, ""), {2, 4}, false);
}
