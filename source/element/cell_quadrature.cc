#include <isochor/element/cell_quadrature.h>

#include <deal.II/base/quadrature_lib.h>

#include <array>
#include <cmath>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    /// Witherden-Vincent rule of one degree: deal.II's argument pair, and the number of points
    /// that must come back.
    struct Rule
    {
      unsigned int degree;
      unsigned int n;
      bool         odd;
      unsigned int n_points;
    };

    template <int dim>
    std::array<Rule, 8> rules();

    template <>
    std::array<Rule, 8> rules<2>()
    {
      return {{{1, 1, true, 1},
               {2, 1, false, 3},
               {4, 2, false, 6},
               {5, 3, true, 7},
               {6, 3, false, 12},
               {7, 4, true, 15},
               {8, 4, false, 16},
               {9, 5, true, 19}}};
    }

    template <>
    std::array<Rule, 8> rules<3>()
    {
      return {{{1, 1, true, 1},
               {2, 1, false, 4},
               {3, 2, true, 8},
               {5, 3, true, 14},
               {6, 3, false, 24},
               {7, 4, true, 35},
               {8, 4, false, 46},
               {9, 5, true, 59}}};
    }
  } // namespace

  template <int dim>
  dealii::Quadrature<dim> cell_quadrature(const CellKind kind, const unsigned int degree)
  {
    if constexpr (dim > 1)
      if (kind == CellKind::simplex)
        {
          for (const Rule &rule : rules<dim>())
            if (rule.degree >= degree)
              {
                const dealii::QWitherdenVincentSimplex<dim> quadrature(rule.n, rule.odd);
                double                                      total = 0;
                for (const double weight : quadrature.get_weights())
                  total += weight;
                if (quadrature.size() != rule.n_points
                    || std::abs(total - reference_volume(kind, dim)) > 1e-12)
                  throw std::logic_error("deal.II returned another quadrature rule than expected");
                return quadrature;
              }
          throw std::logic_error("no simplex quadrature of this degree");
        }
    return dealii::QGauss<dim>(degree / 2 + 1);
  }

  template dealii::Quadrature<1> cell_quadrature<1>(CellKind, unsigned int);
  template dealii::Quadrature<2> cell_quadrature<2>(CellKind, unsigned int);
  template dealii::Quadrature<3> cell_quadrature<3>(CellKind, unsigned int);
} // namespace isochor
