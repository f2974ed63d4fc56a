#pragma once

// The matrix and residual of one cell, and how they go into the global ones.

#include <isochor/form/term.h>
#include <isochor/space/discretisation.h>
#include <isochor/space/matrix_pattern.h>

namespace isochor
{
  template <int dim, int n_x, int n_p>
  struct LocalSystem
  {
    static constexpr int n_u = dim * n_x;
    // No zero-sized arrays for displacement elements.
    static constexpr int n_q = n_p > 0 ? n_p : 1;

    double K[n_u][n_u]; ///< d2L/du2
    double G[n_q][n_u]; ///< d2L/dp du
    double C[n_q][n_q]; ///< -d2L/dp2
    double r_u[n_u];
    double r_p[n_q];

    void add_residual(const CellTables<dim> &cells, const std::size_t cell, double *residual) const
    {
      for (int a = 0; a < n_x; ++a)
        for (int c = 0; c < dim; ++c)
          residual[cells.x[cell * n_x + a] + c] += r_u[dim * a + c];
      for (int j = 0; j < n_p; ++j)
        residual[cells.p[cell * n_p + j]] += r_p[j];
    }

    void add_tangent(const CellTables<dim> &cells,
                     const std::size_t      cell,
                     const CellOffsets     &offsets,
                     SparseMatrix          &matrix) const
    {
      double            *values    = matrix.values().data();
      const std::size_t *row_start = matrix.row_start().data();
      for (int a = 0; a < n_x; ++a)
        {
          const LocalIndex head = cells.x[cell * n_x + a];
          if (head >= cells.n_owned_unknowns)
            continue;
          const std::uint32_t *offset = offsets.row(cell, a);
          for (int c = 0; c < dim; ++c)
            {
              double *row = values + row_start[head + c];
              for (int b = 0; b < n_x; ++b)
                for (int d = 0; d < dim; ++d)
                  row[offset[b] + d] += K[dim * a + c][dim * b + d];
              for (int j = 0; j < n_p; ++j)
                row[offset[n_x + j]] += G[j][dim * a + c];
            }
        }
      for (int j = 0; j < n_p; ++j)
        {
          const LocalIndex head = cells.p[cell * n_p + j];
          if (head >= cells.n_owned_unknowns)
            continue;
          const std::uint32_t *offset = offsets.row(cell, n_x + j);
          double              *row    = values + row_start[head];
          for (int b = 0; b < n_x; ++b)
            for (int d = 0; d < dim; ++d)
              row[offset[b] + d] += G[j][dim * b + d];
          for (int k = 0; k < n_p; ++k)
            row[offset[n_x + k]] -= C[j][k];
        }
    }
  };
} // namespace isochor
