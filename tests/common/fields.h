#pragma once

// Fields on a discretisation for any kind of shape functions: coefficients from values, and back.

#include <isochor/space/discretisation.h>

#include <functional>

namespace isochor::testing
{
  /// Coefficients of a function of the reference point: exact for what the shape functions hold if
  /// they are nodal, for linear functions if not (a bubble is what the others leave at its node; a
  /// discontinuous linear field has a mean and slopes).
  template <int dim>
  std::vector<double> coefficients(const ShapeFunctions<dim>                               &shape,
                                   const std::function<double(const dealii::Point<dim> &)> &f)
  {
    std::vector<double> c;
    for (unsigned int i = 0; i < shape.n_nodes(); ++i)
      {
        const auto node = shape.node(i);
        if (shape.value(i, node) == 0.)
          {
            const auto half  = 0.5 * dealii::Point<dim>::unit_vector(i - 1);
            const auto lower = dealii::Point<dim>(node - half);
            c.push_back(f(node + half) - f(lower));
            continue;
          }
        double rest = f(node);
        for (unsigned int j = 0; j < i; ++j)
          rest -= c[j] * shape.value(j, node);
        c.push_back(rest);
      }
    return c;
  }

  /// Fill @p state, ghosts included, with a displacement and a pressure given by reference positions.
  template <int dim, typename Displacement, typename Pressure>
  void interpolate(const Discretisation<dim> &discretisation,
                   const Displacement        &displacement,
                   const Pressure            &pressure,
                   Vector                    &state)
  {
    const auto &cells = discretisation.cells;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      {
        for (unsigned int c = 0; c < dim; ++c)
          {
            const auto u
                = coefficients<dim>(discretisation.x_shape, [&](const dealii::Point<dim> &xi) {
                    return dealii::Tensor<1, dim>(displacement(cells.position(cell, xi)))[c];
                  });
            for (unsigned int a = 0; a < cells.n_x; ++a)
              state.begin()[cells.x[cell * cells.n_x + a] + c] = u[a];
          }
        if (cells.n_p == 0)
          continue;
        const auto p = coefficients<dim>(discretisation.p_shape, [&](const dealii::Point<dim> &xi) {
          return pressure(cells.position(cell, xi));
        });
        for (unsigned int j = 0; j < cells.n_p; ++j)
          state.begin()[cells.p[cell * cells.n_p + j]] = p[j];
      }
    state.update_ghost_values();
  }

  template <int dim>
  dealii::Tensor<1, dim> displacement_at(const Discretisation<dim> &discretisation,
                                         const Vector              &state,
                                         const std::size_t          cell,
                                         const dealii::Point<dim>  &xi)
  {
    const auto            &cells = discretisation.cells;
    dealii::Tensor<1, dim> u;
    for (unsigned int a = 0; a < cells.n_x; ++a)
      for (unsigned int c = 0; c < dim; ++c)
        u[c] += discretisation.x_shape.value(a, xi)
                * state.local_element(cells.x[cell * cells.n_x + a] + c);
    return u;
  }

  template <int dim>
  double pressure_at(const Discretisation<dim> &discretisation,
                     const Vector              &state,
                     const std::size_t          cell,
                     const dealii::Point<dim>  &xi)
  {
    const auto &cells = discretisation.cells;
    double      p     = 0;
    for (unsigned int j = 0; j < cells.n_p; ++j)
      p += discretisation.p_shape.value(j, xi) * state.local_element(cells.p[cell * cells.n_p + j]);
    return p;
  }
} // namespace isochor::testing
