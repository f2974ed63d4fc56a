// Lagrange polynomials on simplices: the nodal property, partition of unity, all polynomials of
// the degree, gradients against differences, counts by the binomial (k + dim choose dim), and the
// order of nodes against deal.II's own elements where it has them (degrees 1 and 2).

#include "../common/report.h"

#include <isochor/element/lagrange_simplex.h>
#include <isochor/element/nodal_element.h>

#include <deal.II/fe/fe_simplex_p.h>

#include <random>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  dealii::Point<dim> random_point(std::mt19937 &random)
  {
    // Inside, and a little outside, where a formula must hold as well.
    std::uniform_real_distribution<double> coordinate(-0.2, 0.8);
    dealii::Point<dim>                     xi;
    for (unsigned int d = 0; d < dim; ++d)
      xi[d] = coordinate(random);
    return xi;
  }

  template <int dim>
  double polynomial(const dealii::Point<dim> &xi, const unsigned int degree)
  {
    double sum = 0.3;
    for (unsigned int d = 0; d < dim; ++d)
      sum += (0.7 - 0.9 * d) * xi[d];
    return std::pow(sum, degree);
  }

  template <int dim>
  void test_functions(const LagrangeSimplex<dim> &shape)
  {
    std::mt19937 random(1);
    double       nodal = 0, unity = 0, gradient_sum = 0, slope = 0, reproduced = 0;
    for (unsigned int i = 0; i < shape.n_nodes(); ++i)
      for (unsigned int j = 0; j < shape.n_nodes(); ++j)
        raise(nodal, std::abs(shape.value(i, shape.node(j)) - (i == j)));

    for (unsigned int sample = 0; sample < 20; ++sample)
      {
        const auto             xi  = random_point<dim>(random);
        double                 sum = 0, interpolant = 0;
        dealii::Tensor<1, dim> sum_of_gradients;
        for (unsigned int i = 0; i < shape.n_nodes(); ++i)
          {
            sum += shape.value(i, xi);
            sum_of_gradients += shape.gradient(i, xi);
            interpolant += shape.value(i, xi) * polynomial(shape.node(i), shape.degree());
            for (unsigned int d = 0; d < dim; ++d)
              {
                // Fourth order: exact for cubics but for rounding.
                const auto   step       = 1e-2 * dealii::Point<dim>::unit_vector(d);
                const auto   at         = [&](double s) { return shape.value(i, xi + s * step); };
                const double difference = (8. * (at(1) - at(-1)) - (at(2) - at(-2))) / (12. * 1e-2);
                raise(slope, std::abs(difference - shape.gradient(i, xi)[d]));
              }
          }
        raise(unity, std::abs(sum - 1.));
        raise(gradient_sum, sum_of_gradients.norm());
        raise(reproduced, std::abs(interpolant - polynomial(xi, shape.degree())));
      }
    std::cout << "  nodal property " << below(nodal, 1e-13) << ", sum " << below(unity, 1e-13)
              << ", sum of gradients " << below(gradient_sum, 1e-12) << "\n  gradients "
              << below(slope, 1e-11) << ", polynomial of the degree " << below(reproduced, 1e-13)
              << '\n';
  }

  template <int dim>
  void test_layout(const LagrangeSimplex<dim> &shape)
  {
    std::cout << "  " << shape.n_nodes() << " nodes; per vertex, edge, face, cell:";
    for (const unsigned int n : shape.nodes_per_object())
      std::cout << ' ' << n;
    std::cout << "; on faces:";
    bool on_plane = true;
    for (unsigned int face = 0; face <= dim; ++face)
      {
        const auto nodes = shape.nodes_on_face(face);
        std::cout << ' ' << nodes.size();
        // A face's points have a zero barycentric coordinate: that of the opposite vertex.
        unsigned int opposite = (dim + 1) * dim / 2;
        for (const unsigned int v : reference_faces<dim>(CellKind::simplex)[face])
          opposite -= v;
        for (const unsigned int node : nodes)
          on_plane = on_plane && std::abs(barycentric(shape.node(node))[opposite]) < 1e-15;
      }
    std::cout << ", in its plane: " << yes(on_plane);

    // The cubic's edge nodes are a third of the way from the vertices they are paired with.
    const auto vertex = [](const unsigned int v) {
      return v == 0 ? dealii::Point<dim>() : dealii::Point<dim>::unit_vector(v - 1);
    };
    double third = 0;
    for (const auto &edge : shape.edge_nodes())
      for (unsigned int n = 0; n < 2; ++n)
        {
          const auto near = vertex(edge.vertices[n]), far = vertex(edge.vertices[1 - n]);
          raise(third, shape.node(edge.nodes[n]).distance(near + (far - near) / 3.));
        }
    std::cout << "\n  cubic edges: " << shape.edge_nodes().size() << ", nodes at thirds "
              << below(third, 1e-15) << '\n';

    const NodalElement<dim> element(shape);
    double                  moved = 0;
    for (unsigned int i = 0; i < shape.n_nodes(); ++i)
      raise(moved, element.unit_support_point(i).distance(shape.node(i)));
    std::cout << "  deal.II element with " << element.n_dofs_per_cell()
              << " DoFs, support points moved " << below(moved, 1e-15);
    if (shape.degree() == 1 || shape.degree() == 2)
      {
        const dealii::FE_SimplexP<dim> theirs(shape.degree());
        double                         apart = 0;
        for (unsigned int i = 0; i < shape.n_nodes(); ++i)
          raise(apart, theirs.unit_support_point(i).distance(shape.node(i)));
        std::cout << ", nodes apart from FE_SimplexP's " << below(apart, 1e-15);
      }
    std::cout << '\n';
  }

  template <int dim>
  void test()
  {
    for (unsigned int degree = 0; degree <= 3; ++degree)
      {
        std::cout << "degree " << degree << " in " << dim << "D\n";
        const LagrangeSimplex<dim> shape(degree);
        test_layout(shape);
        test_functions(shape);
      }
  }
} // namespace

int main()
{
  test<2>();
  test<3>();
  std::cout << "degree 4: " << message_of<std::logic_error>([]() { LagrangeSimplex<2> shape(4); })
            << '\n';
}
