#pragma once

// The map of one cell at eight quadrature points at a time.

#include <isochor/material/lanes.h>
#include <isochor/space/cell_tables.h>

#include <deal.II/base/quadrature.h>

#include <algorithm>
#include <array>

namespace isochor
{
  /// d xi / d X and det dX / d xi at eight points.
  template <int dim>
  struct BatchMap
  {
    Batch inverse[dim][dim];
    Batch determinant;
  };

  template <int dim>
  class BatchGeometry
  {
  public:
    /// The last point of @p quadrature is repeated in the lanes beyond it.
    BatchGeometry(const CellTables<dim> &cells, const dealii::Quadrature<dim> &quadrature)
    {
      if (cells.all_affine)
        return;
      for (unsigned int first = 0; first < quadrature.size(); first += n_lanes)
        for (unsigned int i = 0; i < cells.n_g; ++i)
          {
            gradients.emplace_back();
            for (unsigned int lane = 0; lane < n_lanes; ++lane)
              {
                const unsigned int q = std::min(first + lane, quadrature.size() - 1);
                const auto gradient  = cells.geometry_shape->gradient(i, quadrature.point(q));
                for (int d = 0; d < dim; ++d)
                  gradients.back()[d][lane] = gradient[d];
              }
          }
    }

    /// Of batch @p k of the points of a cell; @p cells as in the constructor.
    BatchMap<dim>
    map(const CellTables<dim> &cells, const std::size_t cell, const std::size_t k) const
    {
      BatchMap<dim> map;
      if (cells.is_affine[cell])
        {
          for (int d = 0; d < dim; ++d)
            for (int J = 0; J < dim; ++J)
              map.inverse[d][J] = batch(cells.inverse(cell)[d * dim + J]);
          map.determinant = batch(cells.determinant[cell]);
          return map;
        }

      Batch jacobian[dim][dim] = {}; // [J][d] = d X_J / d xi_d
      for (unsigned int i = 0; i < cells.n_g; ++i)
        {
          const auto &X = cells.geometry[cell * cells.n_g + i];
          const auto &g = gradients[k * cells.n_g + i];
          for (int J = 0; J < dim; ++J)
            for (int d = 0; d < dim; ++d)
              jacobian[J][d] += X[J] * g[d];
        }
      invert(jacobian, map);
      return map;
    }

  private:
    static void invert(const Batch (&A)[dim][dim], BatchMap<dim> &map)
    {
      Batch cofactor[dim][dim]; // of A
      if constexpr (dim == 2)
        {
          cofactor[0][0] = A[1][1];
          cofactor[0][1] = -A[1][0];
          cofactor[1][0] = -A[0][1];
          cofactor[1][1] = A[0][0];
        }
      else
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            {
              const int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
              cofactor[i][j] = A[k][m] * A[l][n] - A[k][n] * A[l][m];
            }
      map.determinant = A[0][0] * cofactor[0][0];
      for (int j = 1; j < dim; ++j)
        map.determinant += A[0][j] * cofactor[0][j];
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          map.inverse[j][i] = cofactor[i][j] / map.determinant;
    }

    std::vector<std::array<Batch, dim>> gradients; ///< [batch * n_g + i], if not all are affine
  };
} // namespace isochor
