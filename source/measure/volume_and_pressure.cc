#include <isochor/element/simplex_quadrature.h>
#include <isochor/measure/probes.h>

#include <array>
#include <cmath>

namespace isochor
{
  template <int dim>
  double deformed_volume(const Discretisation<dim> &discretisation, const Vector &state)
  {
    const CellTables<dim>      &cells = discretisation.cells;
    const LagrangeSimplex<dim> &shape = discretisation.x_shape;
    const auto quadrature = simplex_quadrature<dim>(std::max(1u, dim * (shape.degree() - 1)));

    // gradients[q * n_x + a]
    std::vector<dealii::Tensor<1, dim>> gradients;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        gradients.push_back(shape.gradient(a, quadrature.point(q)));

    double volume = 0;
    for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          // dx / dxi of the deformed cell
          dealii::Tensor<2, dim> map;
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int k = 0; k < dim; ++k)
              map[d][k] = cells.vertices[cell * (dim + 1) + k + 1][d]
                          - cells.vertices[cell * (dim + 1)][d];
          for (unsigned int a = 0; a < cells.n_x; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              map[d] += state.local_element(cells.x[cell * cells.n_x + a] + d)
                        * gradients[q * cells.n_x + a];
          volume += quadrature.weight(q) * dealii::determinant(map);
        }
    return dealii::Utilities::MPI::sum(volume, discretisation.communicator());
  }

  template <int dim>
  std::optional<double> pressure_oscillation(const Discretisation<dim> &discretisation,
                                             const Vector              &state)
  {
    if (discretisation.n_pressures == 0)
      return {};
    const CellTables<dim>      &cells      = discretisation.cells;
    const LagrangeSimplex<dim> &shape      = discretisation.p_shape;
    const auto                  quadrature = simplex_quadrature<dim>(2 * shape.degree());
    const unsigned int          n_p        = cells.n_p;

    std::vector<double> value; // [q * n_p + j]
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      for (unsigned int j = 0; j < n_p; ++j)
        value.push_back(shape.value(j, quadrature.point(q)));

    // Nodal average of the means of the cells around each node.
    Vector       average  = discretisation.make_vector(), weight(average);
    double       integral = 0, volume = 0;
    const double total_weight = dim == 2 ? 0.5 : 1. / 6;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      {
        double mean = 0;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          for (unsigned int j = 0; j < n_p; ++j)
            mean += quadrature.weight(q) * value[q * n_p + j]
                    * state.local_element(cells.p[cell * n_p + j]);
        mean /= total_weight;
        const double cell_volume = total_weight * cells.determinant[cell];
        for (unsigned int j = 0; j < n_p; ++j)
          {
            average.local_element(cells.p[cell * n_p + j]) += cell_volume * mean;
            weight.local_element(cells.p[cell * n_p + j]) += cell_volume;
          }
        if (cell < cells.n_owned)
          {
            integral += cell_volume * mean;
            volume += cell_volume;
          }
      }
    average.zero_out_ghost_values();
    for (LocalIndex i = discretisation.n_owned_displacements; i < average.locally_owned_size(); ++i)
      average.local_element(i) /= weight.local_element(i);
    average.update_ghost_values();

    const MPI_Comm communicator = discretisation.communicator();
    const double   total_volume = dealii::Utilities::MPI::sum(volume, communicator);
    const double   mean = dealii::Utilities::MPI::sum(integral, communicator) / total_volume;

    double rough = 0, whole = 0;
    for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          double p = 0, smooth = 0;
          for (unsigned int j = 0; j < n_p; ++j)
            {
              p += value[q * n_p + j] * state.local_element(cells.p[cell * n_p + j]);
              smooth += value[q * n_p + j] * average.local_element(cells.p[cell * n_p + j]);
            }
          const double at = quadrature.weight(q) * cells.determinant[cell];
          rough += at * (p - smooth) * (p - smooth);
          whole += at * (p - mean) * (p - mean);
        }
    rough = dealii::Utilities::MPI::sum(rough, communicator);
    whole = dealii::Utilities::MPI::sum(whole, communicator);
    // A constant pressure: what is left is noise over noise.
    const double constant = mean * mean * total_volume;
    if (!(whole > 1e-10 * constant))
      return {};
    return std::sqrt(rough / whole);
  }

  template double                deformed_volume(const Discretisation<2> &, const Vector &);
  template double                deformed_volume(const Discretisation<3> &, const Vector &);
  template std::optional<double> pressure_oscillation(const Discretisation<2> &, const Vector &);
  template std::optional<double> pressure_oscillation(const Discretisation<3> &, const Vector &);
} // namespace isochor
