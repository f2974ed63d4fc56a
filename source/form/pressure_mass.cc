#include <isochor/element/cell_quadrature.h>
#include <isochor/form/pressure_mass.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/solver_cg.h>

namespace isochor
{
  template <int dim>
  PressureMass<dim>::PressureMass(const Discretisation<dim> &discretisation)
    : discretisation(discretisation)
    , diagonal_(discretisation.make_vector())
  {
    const CellTables<dim> &cells      = discretisation.cells;
    const auto             quadrature = cell_quadrature<dim>(
        cells.kind,
        std::max(discretisation.quadrature_degree(), 2 * discretisation.p_shape.degree()));
    const GeometryTable<dim> geometry(cells, quadrature.get_points());
    const ShapeTable<dim>    shape(discretisation.p_shape, quadrature.get_points());

    local.resize(cells.n_cells * cells.n_p * cells.n_p, 0.);
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int j = 0; j < cells.n_p; ++j)
        {
          double *row = &local[(cell * cells.n_p + j) * cells.n_p];
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              const double share
                  = quadrature.weight(q) * geometry.determinant(cell, q) * shape.value(q, j);
              for (unsigned int k = 0; k < cells.n_p; ++k)
                row[k] += share * shape.value(q, k);
            }
          diagonal_.local_element(cells.p[cell * cells.n_p + j]) += row[j];
        }
    diagonal_.zero_out_ghost_values();
  }

  template <int dim>
  void PressureMass<dim>::vmult(Vector &dst, const Vector &src) const
  {
    const CellTables<dim> &cells = discretisation.cells;
    src.update_ghost_values();
    dst = 0.;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int j = 0; j < cells.n_p; ++j)
        {
          const double *row = &local[(cell * cells.n_p + j) * cells.n_p];
          double        sum = 0;
          for (unsigned int k = 0; k < cells.n_p; ++k)
            sum += row[k] * src.local_element(cells.p[cell * cells.n_p + k]);
          dst.local_element(cells.p[cell * cells.n_p + j]) += sum;
        }
    // The rows owned here are complete: a rank computes all cells that touch them.
    dst.zero_out_ghost_values();
  }

  template <int dim>
  void PressureMass<dim>::solve(Vector &dst, const Vector &src) const
  {
    Vector rhs(src);
    for (LocalIndex i = 0; i < discretisation.n_owned_displacements; ++i)
      rhs.local_element(i) = 0.;
    rhs.zero_out_ghost_values();
    dst               = 0.;
    const double size = rhs.l2_norm();
    if (size == 0.)
      return;

    dealii::DiagonalMatrix<Vector> inverse_diagonal;
    inverse_diagonal.get_vector() = diagonal_;
    for (LocalIndex i = 0; i < diagonal_.locally_owned_size(); ++i)
      inverse_diagonal.get_vector().local_element(i)
          = i < discretisation.n_owned_displacements ? 1. : 1. / diagonal_.local_element(i);
    dealii::SolverControl    control(200, 1e-10 * size, false, false);
    dealii::SolverCG<Vector> cg(control);
    cg.solve(*this, dst, rhs, inverse_diagonal);
  }

  template <int dim>
  void PressureMass<dim>::add_to(SparseMatrix &matrix, const double factor) const
  {
    const CellTables<dim> &cells = discretisation.cells;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int j = 0; j < cells.n_p; ++j)
        if (const LocalIndex row = cells.p[cell * cells.n_p + j]; row < cells.n_owned_unknowns)
          for (unsigned int k = 0; k < cells.n_p; ++k)
            matrix.values()[matrix.position(row, cells.p[cell * cells.n_p + k])]
                += factor * local[(cell * cells.n_p + j) * cells.n_p + k];
  }

  template class PressureMass<2>;
  template class PressureMass<3>;
} // namespace isochor
