// Interpolation from one mesh to another: polynomials that the element holds must come out exactly,
// on a mesh that has nothing in common with the first, however both are shared by ranks. On a curved
// body, where nodes of the fine mesh lie outside the coarse one, this holds for linear fields.

#include "../common/meshes.h"
#include "../common/report.h"

#include <isochor/mesh/mesh.h>
#include <isochor/space/interpolation.h>

#include <deal.II/base/mpi.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &X, const unsigned int degree)
  {
    dealii::Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = 0.1 * (d + 1) - X[d] + 0.5 * std::pow(X[(d + 1) % dim] - 0.3 * X[d], degree);
    return u;
  }

  template <int dim>
  double pressure(const dealii::Point<dim> &X)
  {
    return 3. - 2. * X[0] + X[dim - 1];
  }

  /// The exact state. Discontinuous pressures stay zero.
  template <int dim>
  Vector exact(const Discretisation<dim> &discretisation, const unsigned int degree)
  {
    Vector state = discretisation.make_vector();
    set_displacements<dim>(
        discretisation, [&](const auto &X) { return displacement(X, degree); }, state);
    const CellTables<dim> &cells = discretisation.cells;
    if (!discretisation.element.has_discontinuous_pressure())
      for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
        for (unsigned int j = 0; j < cells.n_p; ++j)
          if (const LocalIndex unknown = cells.p[cell * cells.n_p + j];
              unknown < cells.n_owned_unknowns)
            state.local_element(unknown)
                = pressure(cells.position(cell, discretisation.p_shape.node(j)));
    state.update_ghost_values();
    return state;
  }

  template <int dim>
  double error(const std::string &element_name,
               const Mesh<dim>   &coarse_mesh,
               const Mesh<dim>   &fine_mesh,
               const unsigned int degree)
  {
    const Element             element = find_element(element_name, "element");
    const Discretisation<dim> coarse(coarse_mesh.triangulation, element, coarse_mesh.geometry);
    const Discretisation<dim> fine(fine_mesh.triangulation, element, fine_mesh.geometry);
    Vector                    state = fine.make_vector();
    interpolate(coarse, exact(coarse, degree), fine, state);
    state -= exact(fine, degree);
    return state.linfty_norm();
  }

  template <int dim>
  std::unique_ptr<Mesh<dim>> shell(const unsigned int n)
  {
    MeshRequest request;
    request.source = "sphere_octant(0.5, 1)";
    request.cells  = {n, n};
    return make_mesh<dim>(request, MPI_COMM_WORLD);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const auto coarse = gmsh_box<3>(0.5), fine = distorted_box<3>(3);
  for (const auto &[name, degree] : {std::pair("P1", 1u),
                                     std::pair("P1-P1", 1u),
                                     std::pair("MINI", 1u),
                                     std::pair("P2-P0", 2u),
                                     std::pair("P2-P1", 2u),
                                     std::pair("P3-P2", 3u)})
    out() << name << ": degree " << degree << ", error "
          << below(error<3>(name, *coarse, *fine, degree), 1e-12) << "\n";

  const auto coarse_square = distorted_box<2>(3, CellKind::hypercube),
             fine_square   = distorted_box<2>(4, CellKind::hypercube);
  for (const char *name : {"Q1", "Q2-P1"})
    out() << name << ": degree 1, error "
          << below(error<2>(name, *coarse_square, *fine_square, 1), 1e-9) << "\n";

  out() << "outside the coarse body: error "
        << below(error<3>("P2-P1", *shell<3>(2), *shell<3>(5), 1), 1e-12) << "\n";
}
