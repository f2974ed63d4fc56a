// Shape functions of hypercubes, the bubble and discontinuous pressures. Known beforehand: nodes in
// deal.II's order (compared with FE_Q's), functions 1 at their own node and 0 at the others
// (bubble: at the vertices; discontinuous: mean and slopes), sums of 1, gradients against differences,
// zero on faces that a node is not on, the bubble's integral 4!/8! 4^4 3! and 2!/5! 3^3 2!, in units of
// the cell's volume (lambda_v are Dirichlet distributed).

#include "../common/report.h"

#include <isochor/element/bubble_simplex.h>
#include <isochor/element/cell_quadrature.h>
#include <isochor/element/element_table.h>
#include <isochor/element/nodal_element.h>

#include <deal.II/fe/fe_q.h>

#include <random>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  dealii::Point<dim> random_point(std::mt19937 &random, const CellKind kind)
  {
    std::uniform_real_distribution<double> number(0.05, 0.95);
    while (true)
      {
        dealii::Point<dim> xi;
        double             sum = 0;
        for (unsigned int d = 0; d < dim; ++d)
          sum += xi[d] = number(random);
        if (kind == CellKind::hypercube || sum < 0.95)
          return xi;
      }
  }

  template <int dim>
  void test_gradients(const ShapeFunctions<dim> &shape)
  {
    std::mt19937 random(3);
    double       slope = 0;
    for (unsigned int sample = 0; sample < 10; ++sample)
      {
        const auto xi = random_point<dim>(random, shape.kind());
        for (unsigned int i = 0; i < shape.n_nodes(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            {
              // Fourth order: exact up to degree 4 but for rounding.
              const auto   step       = 1e-2 * dealii::Point<dim>::unit_vector(d);
              const auto   at         = [&](double s) { return shape.value(i, xi + s * step); };
              const double difference = (8. * (at(1) - at(-1)) - (at(2) - at(-2))) / (12. * 1e-2);
              raise(slope, std::abs(difference - shape.gradient(i, xi)[d]));
            }
      }
    std::cout << "  gradients " << below(slope, 1e-10) << '\n';
  }

  /// Continuous across a face: only its own nodes are not zero there.
  template <int dim>
  void test_faces(const ShapeFunctions<dim> &shape)
  {
    const auto  &faces  = reference_faces<dim>(shape.kind());
    double       others = 0;
    std::mt19937 random(5);
    for (unsigned int face = 0; face < faces.size(); ++face)
      {
        const auto nodes = shape.nodes_on_face(face);
        for (unsigned int sample = 0; sample < 5; ++sample)
          {
            // A convex combination of the face's vertices.
            std::vector<double> weights;
            double              total = 0;
            for (std::size_t v = 0; v < faces[face].size(); ++v)
              total += weights.emplace_back(1. + random() % 100);
            dealii::Point<dim> xi;
            for (std::size_t v = 0; v < faces[face].size(); ++v)
              xi += weights[v] / total * reference_vertex<dim>(shape.kind(), faces[face][v]);
            for (unsigned int i = 0; i < shape.n_nodes(); ++i)
              if (std::find(nodes.begin(), nodes.end(), i) == nodes.end())
                raise(others, std::abs(shape.value(i, xi)));
          }
      }
    std::cout << "  zero on other faces " << below(others, 1e-14) << '\n';
  }

  template <int dim>
  void test_hypercube(const unsigned int degree)
  {
    const auto shape = make_shape_functions<dim>(CellKind::hypercube, {Family::lagrange, degree});
    const dealii::FE_Q<dim> theirs(degree);
    const NodalElement<dim> layout(*shape);
    double                  apart = 0, nodal = 0, unity = 0, values = 0;
    std::mt19937            random(4);
    const auto              xi = random_point<dim>(random, CellKind::hypercube);
    for (unsigned int i = 0; i < shape->n_nodes(); ++i)
      {
        raise(apart, theirs.unit_support_point(i).distance(shape->node(i)));
        raise(apart, layout.unit_support_point(i).distance(shape->node(i)));
        raise(values, std::abs(theirs.shape_value(i, xi) - shape->value(i, xi)));
        raise(values, (theirs.shape_grad(i, xi) - shape->gradient(i, xi)).norm());
        for (unsigned int j = 0; j < shape->n_nodes(); ++j)
          raise(nodal, std::abs(shape->value(i, shape->node(j)) - (i == j)));
        unity += shape->value(i, xi);
      }
    std::cout << "Q" << degree << " in " << dim << "D: " << shape->n_nodes() << " nodes, of FE_Q "
              << yes(theirs.n_dofs_per_cell() == shape->n_nodes()) << ", apart "
              << below(apart, 1e-15) << ", values and gradients apart " << below(values, 1e-13)
              << ", nodal property " << below(nodal, 1e-14) << ", sum "
              << below(std::abs(unity - 1.), 1e-14) << '\n';
    test_gradients(*shape);
    test_faces(*shape);
  }

  template <int dim>
  void test_bubble()
  {
    const BubbleSimplex<dim> bubble;
    const unsigned int       b        = dim + 1;
    double                   vertices = 0;
    for (unsigned int v = 0; v <= dim; ++v)
      raise(vertices, std::abs(bubble.value(b, bubble.node(v))));
    const auto quadrature = cell_quadrature<dim>(CellKind::simplex, dim + 1);
    double     integral   = 0;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      integral += quadrature.weight(q) * bubble.value(b, quadrature.point(q));
    integral /= reference_volume(CellKind::simplex, dim);
    const double known = dim == 2 ? 27. * 2 / 120 : 256. * 6 / 5040;
    std::cout << "bubble in " << dim << "D: " << bubble.n_nodes() << " nodes, interior "
              << bubble.n_interior_nodes() << ", at the vertices " << below(vertices, 1e-15)
              << ", at the centroid " << bubble.value(b, bubble.node(b)) << ", mean off by "
              << below(std::abs(integral - known), 1e-13) << '\n';
    test_gradients(bubble);
    test_faces(bubble);
  }

  template <int dim>
  void test_discontinuous(const CellKind kind, const unsigned int degree)
  {
    const auto shape      = make_shape_functions<dim>(kind, {Family::discontinuous, degree});
    const auto quadrature = cell_quadrature<dim>(kind, 2 * degree + 1);
    // The functions are orthogonal: 1 and xi_k - 1/2, with squares 1 and 1/12 on the unit cube.
    double off = 0;
    for (unsigned int i = 0; i < shape->n_nodes(); ++i)
      for (unsigned int j = 0; j < shape->n_nodes(); ++j)
        {
          double product = 0;
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            product += quadrature.weight(q) * shape->value(i, quadrature.point(q))
                       * shape->value(j, quadrature.point(q)) / reference_volume(kind, dim);
          raise(off, std::abs(product - (i != j ? 0. : i == 0 ? 1. : 1. / 12)));
        }
    std::cout << "discontinuous degree " << degree << " on " << cells_name(kind, dim) << ": "
              << shape->n_nodes() << " functions, discontinuous " << yes(shape->is_discontinuous())
              << ", products off by " << below(off, 1e-14) << '\n';
    test_gradients(*shape);
  }

  template <int dim>
  void test()
  {
    test_hypercube<dim>(1);
    test_hypercube<dim>(2);
    test_bubble<dim>();
    test_discontinuous<dim>(CellKind::simplex, 0);
    test_discontinuous<dim>(CellKind::hypercube, 0);
    test_discontinuous<dim>(CellKind::hypercube, 1);
    for (const Element &element : element_table())
      {
        const auto x = make_shape_functions<dim>(element.kind, element.displacement);
        std::cout << element.name << " in " << dim << "D: " << x->n_nodes();
        if (element.is_mixed())
          {
            const auto p = make_shape_functions<dim>(element.kind, *element.pressure);
            std::cout << " + " << p->n_nodes() << (p->is_discontinuous() ? " discontinuous" : "");
          }
        std::cout << ", quadrature points "
                  << cell_quadrature<dim>(element.kind, element.quadrature_degree).size() << '\n';
      }
  }
} // namespace

int main()
{
  test<2>();
  test<3>();
  std::cout << "Q3: " << message_of<std::logic_error>([]() {
    make_shape_functions<2>(CellKind::hypercube, {Family::lagrange, 3});
  })
            << "\nbubble on a cube: " << message_of<std::logic_error>([]() {
                 make_shape_functions<3>(CellKind::hypercube, {Family::bubble, 1});
               })
            << '\n';
}
