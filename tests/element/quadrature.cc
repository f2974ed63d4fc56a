// Each rule integrates every monomial up to its degree, and misses one of the first degree that
// it does not promise. Exact: int prod_d x_d^(a_d) = prod_d a_d! / (sum_d a_d + dim)!. The degree
// that fails is derived from what exists: Witherden and Vincent 2015 have no triangle rule of
// degree 3 and no tetrahedron rule of degree 4, where the next one serves; n Gauss points on a
// line are exact to 2 n - 1.

#include "../common/report.h"

#include <isochor/element/cell_quadrature.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  /// Largest error of any monomial of @p degree, relative to the monomial's integral.
  template <int dim>
  double worst_error(const dealii::Quadrature<dim> &quadrature, const unsigned int degree)
  {
    double worst = 0;
    for (unsigned int a = 0; a <= degree; ++a)
      for (unsigned int b = 0; b <= (dim > 1 ? degree - a : 0); ++b)
        {
          std::array<unsigned int, 3> power{{a, b, degree - a - b}};
          if (dim == 1 && a != degree)
            continue;
          if (dim == 2 && a + b != degree)
            continue;
          double exact = 1. / std::tgamma(degree + dim + 1.), sum = 0;
          for (unsigned int d = 0; d < dim; ++d)
            exact *= std::tgamma(power[d] + 1.);
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              double term = quadrature.weight(q);
              for (unsigned int d = 0; d < dim; ++d)
                term *= std::pow(quadrature.point(q)[d], power[d]);
              sum += term;
            }
          raise(worst, std::abs(sum - exact) / exact);
        }
    return worst;
  }

  template <int dim>
  void test()
  {
    std::cout << dim << "D\n";
    for (unsigned int degree = 1; degree <= 9; ++degree)
      {
        const auto   quadrature = cell_quadrature<dim>(CellKind::simplex, degree);
        double       error = 0, outside = 0;
        unsigned int fails = 0;
        for (; worst_error(quadrature, fails) < 1e-9; ++fails)
          raise(error, worst_error(quadrature, fails));
        for (const auto &point : quadrature.get_points())
          {
            double rest = 1.;
            for (unsigned int d = 0; d < dim; ++d)
              {
                raise(outside, -point[d]);
                rest -= point[d];
              }
            raise(outside, -rest);
          }
        std::cout << "  degree " << degree << ": " << quadrature.size() << " points, fails at "
                  << fails << ", before that errors " << below(error, 1e-12)
                  << ", all points inside: " << yes(outside <= 0.) << '\n';
      }
  }
} // namespace

int main()
{
  test<1>();
  test<2>();
  test<3>();
  std::cout << "degree 10: " << message_of<std::logic_error>([]() {
    cell_quadrature<2>(CellKind::simplex, 10);
  }) << '\n' << "degree 10: "
            << message_of<std::logic_error>([]() { cell_quadrature<3>(CellKind::simplex, 10); })
            << '\n';
}
