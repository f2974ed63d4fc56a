#include <isochor/element/cell_quadrature.h>
#include <isochor/measure/probes.h>

#include <cmath>

namespace isochor
{
  template <int dim>
  double deformed_volume(const Discretisation<dim> &discretisation, const Vector &state)
  {
    const CellTables<dim>     &cells = discretisation.cells;
    const ShapeFunctions<dim> &shape = discretisation.x_shape;
    // det dx / dxi is of degree d (k - 1) on simplices, d k - 1 per coordinate on hypercubes.
    const unsigned int       k      = std::max(shape.degree(), cells.geometry_shape->degree());
    const unsigned int       degree = cells.kind == CellKind::simplex ? dim * (k - 1) : dim * k - 1;
    const auto               quadrature = cell_quadrature<dim>(cells.kind, std::max(1u, degree));
    const GeometryTable<dim> geometry(cells, quadrature.get_points());
    const ShapeTable<dim>    table(shape, quadrature.get_points());

    double volume = 0;
    for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          dealii::Tensor<2, dim> map = geometry.map(cell, q).jacobian; // dx / dxi
          for (unsigned int a = 0; a < cells.n_x; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              map[d]
                  += state.local_element(cells.x[cell * cells.n_x + a] + d) * table.gradient(q, a);
          volume += quadrature.weight(q) * dealii::determinant(map);
        }
    return dealii::Utilities::MPI::sum(volume, discretisation.communicator());
  }

  namespace
  {
    /// The pressure of a cell at quadrature points, and its smoothed companion.
    template <int dim>
    class Smoother
    {
    public:
      explicit Smoother(const Discretisation<dim> &discretisation)
        : discretisation(discretisation)
        , cells(discretisation.cells)
        , is_discontinuous(discretisation.element.has_discontinuous_pressure())
        , linear(make_shape_functions<dim>(cells.kind, {Family::lagrange, 1}))
        , smooth_shape(is_discontinuous ? *linear : discretisation.p_shape)
        , n_s(smooth_shape.n_nodes())
        , quadrature(cell_quadrature<dim>(
              cells.kind,
              std::max(discretisation.quadrature_degree(), 2 * discretisation.p_shape.degree())))
        , geometry(cells, quadrature.get_points())
        , p_table(discretisation.p_shape, quadrature.get_points())
        , s_table(smooth_shape, quadrature.get_points())
        , average(discretisation.make_vector())
      {
      }

      /// Average the means of the cells around each node; returns the mean over the body and the
      /// body's volume.
      std::pair<double, double> average_means(const Vector &state)
      {
        Vector weight(average);
        double integral = 0, volume = 0;
        for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
          {
            double of_cell = 0, cell_volume = 0;
            for (unsigned int q = 0; q < quadrature.size(); ++q)
              {
                of_cell += dV(cell, q) * pressure(state, cell, q);
                cell_volume += dV(cell, q);
              }
            for (unsigned int j = 0; j < n_s; ++j)
              {
                average.local_element(place(cell, j)) += of_cell;
                weight.local_element(place(cell, j)) += cell_volume;
              }
            if (cell < cells.n_owned)
              {
                integral += of_cell;
                volume += cell_volume;
              }
          }
        average.zero_out_ghost_values();
        for (LocalIndex i = 0; i < average.locally_owned_size(); ++i)
          if (weight.local_element(i) > 0)
            average.local_element(i) /= weight.local_element(i);
        average.update_ghost_values();

        const MPI_Comm communicator = discretisation.communicator();
        volume                      = dealii::Utilities::MPI::sum(volume, communicator);
        return {dealii::Utilities::MPI::sum(integral, communicator) / volume, volume};
      }

      double dV(const std::size_t cell, const unsigned int q) const
      {
        return quadrature.weight(q) * geometry.determinant(cell, q);
      }

      double pressure(const Vector &state, const std::size_t cell, const unsigned int q) const
      {
        double p = 0;
        for (unsigned int j = 0; j < cells.n_p; ++j)
          p += p_table.value(q, j) * state.local_element(cells.p[cell * cells.n_p + j]);
        return p;
      }

      double smoothed(const std::size_t cell, const unsigned int q) const
      {
        double p = 0;
        for (unsigned int j = 0; j < n_s; ++j)
          p += s_table.value(q, j) * average.local_element(place(cell, j));
        return p;
      }

      unsigned int n_points() const
      {
        return quadrature.size();
      }

    private:
      /// Where the average of a node is kept: with its pressure, or, if the pressure has no
      /// continuous nodes, with the first displacement component of a vertex.
      LocalIndex place(const std::size_t cell, const unsigned int j) const
      {
        return is_discontinuous ? cells.x[cell * cells.n_x + j] : cells.p[cell * cells.n_p + j];
      }

      const Discretisation<dim>                       &discretisation;
      const CellTables<dim>                           &cells;
      const bool                                       is_discontinuous;
      const std::unique_ptr<const ShapeFunctions<dim>> linear;
      const ShapeFunctions<dim>                       &smooth_shape;
      const unsigned int                               n_s;
      const dealii::Quadrature<dim>                    quadrature;
      const GeometryTable<dim>                         geometry;
      const ShapeTable<dim>                            p_table, s_table;
      Vector                                           average;
    };
  } // namespace

  template <int dim>
  std::optional<double> pressure_oscillation(const Discretisation<dim> &discretisation,
                                             const Vector              &state)
  {
    if (discretisation.n_pressures == 0)
      return {};
    Smoother<dim> smoother(discretisation);
    const auto [mean, volume] = smoother.average_means(state);

    double rough = 0, whole = 0;
    for (std::size_t cell = 0; cell < discretisation.cells.n_owned; ++cell)
      for (unsigned int q = 0; q < smoother.n_points(); ++q)
        {
          const double p = smoother.pressure(state, cell, q);
          rough += smoother.dV(cell, q) * std::pow(p - smoother.smoothed(cell, q), 2);
          whole += smoother.dV(cell, q) * std::pow(p - mean, 2);
        }
    rough = dealii::Utilities::MPI::sum(rough, discretisation.communicator());
    whole = dealii::Utilities::MPI::sum(whole, discretisation.communicator());
    // A constant pressure: what is left is noise over noise.
    if (!(whole > 1e-10 * mean * mean * volume))
      return {};
    return std::sqrt(rough / whole);
  }

  template double                deformed_volume(const Discretisation<2> &, const Vector &);
  template double                deformed_volume(const Discretisation<3> &, const Vector &);
  template std::optional<double> pressure_oscillation(const Discretisation<2> &, const Vector &);
  template std::optional<double> pressure_oscillation(const Discretisation<3> &, const Vector &);
} // namespace isochor
