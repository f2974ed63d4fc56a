#include <isochor/element/cell_quadrature.h>
#include <isochor/measure/trust_figures.h>

namespace isochor
{
  namespace
  {
    template <int dim>
    std::size_t clamped_cells(const Equilibrium<dim> &equilibrium)
    {
      const CellTables<dim> &cells = equilibrium.discretisation().cells;
      std::size_t            n     = 0;
      for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
        {
          bool all = true;
          for (unsigned int v = 0; v < n_vertices(cells.kind, dim); ++v)
            for (unsigned int c = 0; c < dim; ++c)
              all = all
                    && equilibrium.prescribed().is_prescribed(cells.x[cell * cells.n_x + v] + c);
          n += all;
        }
      return dealii::Utilities::MPI::sum(n, equilibrium.discretisation().communicator());
    }

    template <int dim>
    DeformationRange deformation_range(const Discretisation<dim> &discretisation,
                                       const Vector              &state)
    {
      const CellTables<dim> &cells = discretisation.cells;
      const auto quadrature = cell_quadrature<dim>(cells.kind, discretisation.quadrature_degree());
      const GeometryTable<dim> geometry(cells, quadrature.get_points());
      const ShapeTable<dim>    shape(discretisation.x_shape, quadrature.get_points());

      // Points of several cells fill one batch.
      DeformationRange range;
      Deformation      batch;
      unsigned int     lane  = 0;
      const auto       flush = [&]() {
        for (unsigned int empty = lane; empty < n_lanes; ++empty)
          for (int k = 0; k < 9; ++k)
            batch.F[k][empty] = k % 4 == 0;
        batch.complete();
        range.include(batch, lane);
        lane = 0;
      };
      for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const auto map = geometry.map(cell, q);
            for (int k = 0; k < 9; ++k)
              batch.F[k][lane] = k % 4 == 0;
            for (unsigned int a = 0; a < cells.n_x; ++a)
              {
                const auto gradient = shape.gradient(q, a) * map.inverse;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int J = 0; J < dim; ++J)
                    batch.F[3 * i + J][lane]
                        += state.local_element(cells.x[cell * cells.n_x + a] + i) * gradient[J];
              }
            if (++lane == n_lanes)
              flush();
          }
      if (lane > 0)
        flush();

      const MPI_Comm communicator = discretisation.communicator();
      range.smallest_stretch = dealii::Utilities::MPI::min(range.smallest_stretch, communicator);
      range.largest_rotation = dealii::Utilities::MPI::max(range.largest_rotation, communicator);
      return range;
    }
  } // namespace

  template <int dim>
  TrustFigures trust_figures(const Equilibrium<dim> &equilibrium, const Vector &state)
  {
    state.update_ghost_values();
    return {clamped_cells(equilibrium), deformation_range(equilibrium.discretisation(), state)};
  }

  template TrustFigures trust_figures(const Equilibrium<2> &, const Vector &);
  template TrustFigures trust_figures(const Equilibrium<3> &, const Vector &);
} // namespace isochor
