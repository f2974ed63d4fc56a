#include <isochor/core/error.h>
#include <isochor/element/cell_quadrature.h>
#include <isochor/measure/error_norms.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /// The square of a cubic's error is, to leading order, a polynomial of degree 8.
    constexpr unsigned int quadrature_degree = 9;

    /// d formula / d X_direction by sixth-order central differences with step @p h.
    template <int dim>
    double derivative(const Expression<dim>    &formula,
                      const dealii::Point<dim> &position,
                      const double              load,
                      const unsigned int        direction,
                      const double              h)
    {
      const auto at = [&](const int k) {
        dealii::Point<dim> moved = position;
        moved[direction] += k * h;
        return formula.value(moved, load);
      };
      return (45. * (at(1) - at(-1)) - 9. * (at(2) - at(-2)) + (at(3) - at(-3))) / (60. * h);
    }
  } // namespace

  template <int dim>
  ErrorNorms<dim>::ErrorNorms(const Discretisation<dim> &discretisation, const Material &material)
    : discretisation(discretisation)
    , material(material)
    , quadrature(cell_quadrature<dim>(discretisation.cells.kind, quadrature_degree))
    , geometry(discretisation.cells, quadrature.get_points())
    , shape(discretisation.x_shape, quadrature.get_points())
  {
  }

  template <int dim>
  template <typename Action>
  void ErrorNorms<dim>::for_each_point(const Action &action) const
  {
    const CellTables<dim> &cells = discretisation.cells;
    collectively(discretisation.communicator(), [&]() {
      for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const PointMap<dim> map = geometry.map(cell, q);
            action(At{
                cell, q, geometry.position(cell, q), map, quadrature.weight(q) * map.determinant});
          }
    });
  }

  template <int dim>
  double ErrorNorms<dim>::root_of_sum(const double squares) const
  {
    return std::sqrt(dealii::Utilities::MPI::sum(squares, discretisation.communicator()));
  }

  template <int dim>
  double ErrorNorms<dim>::displacement_l2(const Vector                       &state,
                                          const std::vector<Expression<dim>> &exact,
                                          const double                        load) const
  {
    const CellTables<dim> &cells   = discretisation.cells;
    double                 squares = 0;
    for_each_point([&](const At &at) {
      for (unsigned int c = 0; c < dim; ++c)
        {
          double error = -exact[c].value(at.position, load);
          for (unsigned int a = 0; a < cells.n_x; ++a)
            error
                += shape.value(at.q, a) * state.local_element(cells.x[at.cell * cells.n_x + a] + c);
          squares += at.weight * error * error;
        }
    });
    return root_of_sum(squares);
  }

  template <int dim>
  double ErrorNorms<dim>::displacement_h1(const Vector                       &state,
                                          const std::vector<Expression<dim>> &exact,
                                          const double                        load) const
  {
    const CellTables<dim> &cells   = discretisation.cells;
    double                 squares = 0;
    for_each_point([&](const At &at) {
      const double h = std::pow(at.map.determinant, 1. / dim) / 64.;
      for (unsigned int c = 0; c < dim; ++c)
        {
          dealii::Tensor<1, dim> by_xi;
          for (unsigned int a = 0; a < cells.n_x; ++a)
            by_xi += state.local_element(cells.x[at.cell * cells.n_x + a] + c)
                     * shape.gradient(at.q, a);
          for (unsigned int J = 0; J < dim; ++J)
            {
              double error = -derivative(exact[c], at.position, load, J, h);
              for (unsigned int k = 0; k < dim; ++k)
                error += by_xi[k] * at.map.inverse[k][J];
              squares += at.weight * error * error;
            }
        }
    });
    return root_of_sum(squares);
  }

  template <int dim>
  double ErrorNorms<dim>::pressure_l2(const Vector          &state,
                                      const Expression<dim> &exact,
                                      const double           load,
                                      const bool             without_mean) const
  {
    const CellFields<dim>         cell_fields(discretisation, material);
    const auto                    points = cell_fields.tabulate(quadrature.get_points());
    std::vector<PointFields<dim>> fields;
    std::vector<double>           errors, weights; // at all points
    for_each_point([&](const At &at) {
      if (at.q == 0)
        cell_fields.evaluate(at.cell, points, state.begin(), fields);
      errors.push_back(fields[at.q].pressure - exact.value(at.position, load));
      weights.push_back(at.weight);
    });

    double mean = 0;
    if (without_mean)
      {
        double integral = 0, volume = 0;
        for (std::size_t k = 0; k < errors.size(); ++k)
          {
            integral += weights[k] * errors[k];
            volume += weights[k];
          }
        const MPI_Comm communicator = discretisation.communicator();
        mean                        = dealii::Utilities::MPI::sum(integral, communicator)
               / dealii::Utilities::MPI::sum(volume, communicator);
      }
    double squares = 0;
    for (std::size_t k = 0; k < errors.size(); ++k)
      squares += weights[k] * (errors[k] - mean) * (errors[k] - mean);
    return root_of_sum(squares);
  }

  template <int dim>
  double ErrorNorms<dim>::measure(const ProbeRequest<dim> &probe,
                                  const Vector            &state,
                                  const double             load) const
  {
    switch (probe.kind)
      {
        case ProbeKind::displacement_l2_error:
          return displacement_l2(state, probe.exact, load);
        case ProbeKind::displacement_h1_error:
          return displacement_h1(state, probe.exact, load);
        case ProbeKind::pressure_l2_error:
          return pressure_l2(state, probe.exact.at(0), load, probe.without_mean);
        default:
          throw std::logic_error("not an error norm");
      }
  }

  template <int dim>
  std::string ErrorNorms<dim>::unit(const ProbeKind kind)
  {
    switch (kind)
      {
        case ProbeKind::displacement_l2_error:
          return dim == 2 ? "m^2" : "m^2.5";
        case ProbeKind::displacement_h1_error:
          return dim == 2 ? "m" : "m^1.5";
        case ProbeKind::pressure_l2_error:
          return dim == 2 ? "Pa m" : "Pa m^1.5";
        default:
          throw std::logic_error("not an error norm");
      }
  }

  template class ErrorNorms<2>;
  template class ErrorNorms<3>;
} // namespace isochor
