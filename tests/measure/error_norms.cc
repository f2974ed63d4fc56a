// Error norms against formulas, on distorted unit squares and cubes. A state that interpolates a
// polynomial of the element's degrees has no error. For a state at rest the norms are integrals
// done by hand: with u = (x, y, z) int |u|^2 = dim/3 and int |grad u|^2 = dim; with
// u_x = sin(pi x) 1/2 and pi^2/2; with p = x 1/3, and 1/12 less its mean. A displacement element
// at u_x = load x has the pressure kappa (J - 1) = kappa load.

#include "../common/fields.h"
#include "../common/meshes.h"
#include "../common/report.h"

#include <isochor/measure/error_norms.h>

#include <deal.II/base/numbers.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  std::vector<Expression<dim>> formulas(const std::vector<std::string> &texts)
  {
    std::vector<Expression<dim>> parsed;
    for (unsigned int c = 0; c < dim; ++c)
      parsed.emplace_back(texts[c], "test");
    return parsed;
  }

  double relative(const double found, const double expected)
  {
    return std::abs(found / expected - 1.);
  }

  template <int dim>
  void test(const Mesh<dim> &mesh, const std::string_view name)
  {
    const Discretisation<dim> discretisation(mesh.triangulation,
                                             find_element(std::string(name), ""));
    Material                  material;
    material.poisson_ratio = 0.3;
    const ErrorNorms<dim> norms(discretisation, material);
    const Element        &element = discretisation.element;
    // Distorted hypercubes and the bubble hold linear functions only.
    const bool is_plain = element.kind == CellKind::simplex && !element.has_bubble();

    // x^k, y^k, z^k with lower terms; a pressure of its degree.
    const std::string power = std::to_string(is_plain ? element.displacement.degree : 1);
    const auto        u     = formulas<dim>(
        {"load*x^" + power + " - 2*y", "x + 3*y^" + power + "*load", "z^" + power + " - load*x"});
    // A discontinuous linear pressure is one in reference coordinates, which distort.
    const unsigned int p_degree
        = element.pressure && element.kind == CellKind::simplex ? element.pressure->degree : 0;
    const Expression<dim> p(p_degree == 0   ? "load"
                            : p_degree == 1 ? "2 - 3*x + load*y"
                                            : "2 - x*y + load*y^2",
                            "test");
    const auto interpolated = [&](const std::vector<Expression<dim>> &displacement) {
      Vector state = discretisation.make_vector();
      interpolate(
          discretisation,
          [&](const dealii::Point<dim> &X) {
            dealii::Tensor<1, dim> at;
            for (unsigned int c = 0; c < dim; ++c)
              at[c] = displacement[c].value(X, 0.5);
            return at;
          },
          [&](const dealii::Point<dim> &X) { return p.value(X, 0.5); },
          state);
      return state;
    };
    const Vector exact = interpolated(u);
    out() << dim << "D " << name << ": polynomial: u "
          << below(norms.displacement_l2(exact, u, 0.5), 1e-12) << ", grad u "
          << below(norms.displacement_h1(exact, u, 0.5), 1e-11);
    if (element.is_mixed())
      out() << ", p " << below(norms.pressure_l2(exact, p, 0.5, false), 1e-12);
    else
      {
        const auto   stretch = formulas<dim>({"load*x", "0", "0"});
        const double kappa
            = moduli({material.youngs_modulus, 0.3, material.energy, {}, material.kappa}).kappa;
        const Vector stretched = interpolated(stretch);
        out() << ", kappa (J - 1) "
              << below(norms.pressure_l2(stretched,
                                         Expression<dim>(std::to_string(kappa) + "*load", "test"),
                                         0.5,
                                         false)
                           / kappa,
                       1e-9);
      }

    Vector rest = discretisation.make_vector();
    rest.update_ghost_values();
    const auto identity = formulas<dim>({"x", "y", "z"});
    const auto wave     = formulas<dim>({"2*load*sin(pi*x)", "0", "0"});
    out() << "\n  by hand: u "
          << below(relative(norms.displacement_l2(rest, identity, 1.), std::sqrt(dim / 3.)), 1e-12)
          << ", grad u "
          << below(relative(norms.displacement_h1(rest, identity, 1.), std::sqrt(dim)), 1e-12)
          << ", sine: u "
          << below(relative(norms.displacement_l2(rest, wave, 0.5), std::sqrt(0.5)), 1e-6)
          << ", grad u "
          << below(relative(norms.displacement_h1(rest, wave, 0.5),
                            dealii::numbers::PI * std::sqrt(0.5)),
                   1e-6)
          << "\n  p "
          << below(relative(norms.pressure_l2(rest, Expression<dim>("x", "test"), 1., false),
                            std::sqrt(1. / 3)),
                   1e-12)
          << ", without mean "
          << below(relative(norms.pressure_l2(rest, Expression<dim>("5 + x", "test"), 1., true),
                            std::sqrt(1. / 12)),
                   1e-12)
          << '\n';

    // A formula that fails in one corner, on one rank, ends all.
    out() << "  " << message_of<UserError>([&]() {
                       norms.pressure_l2(
                           rest, Expression<dim>("sqrt(0.99 - x)*0 + 1", "entry 'p'"), 1., false);
                     }).substr(0, 62)
          << '\n';
  }

  template <int dim>
  void test()
  {
    const auto simplices  = distorted_box<dim>(3);
    const auto hypercubes = distorted_box<dim>(3, CellKind::hypercube);
    for (const Element &element : element_table())
      test(element.kind == CellKind::simplex ? *simplices : *hypercubes, element.name);
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
}
