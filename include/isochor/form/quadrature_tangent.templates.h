#pragma once

// The tangent of one cell from what its quadrature points have left behind, as a matrix and as its
// product with a direction. For the quadrature kernel.

#include <isochor/form/local_system.h>
#include <isochor/material/lanes.h>

#include <vector>

namespace isochor
{
  template <int dim, int n_x, int n_p>
  struct QuadratureTangent
  {
    static constexpr bool mixed = n_p > 0;
    using System                = LocalSystem<dim, n_x, n_p>;

    /// Reference shape tables at eight quadrature points.
    struct PointBatch
    {
      Batch x_gradient[n_x][dim];
      Batch p_value[System::n_q];
      Batch weight;
    };

    /// What the tangent needs of eight quadrature points, with the weight in it.
    struct PointTangent
    {
      Batch gradient[n_x][dim];    ///< dN_a / dX
      Batch A[dim][dim][dim][dim]; ///< weighted
      Batch d_phi[dim][dim];       ///< dPhi/dF, weighted
    };

    /// Values at the nodes of a cell.
    static void gather(const CellTables<dim> &cells,
                       const std::size_t      cell,
                       const double          *values,
                       double (&u)[n_x][dim],
                       double (&p)[System::n_q])
    {
      for (int a = 0; a < n_x; ++a)
        for (int c = 0; c < dim; ++c)
          u[a][c] = values[cells.x[cell * n_x + a] + c];
      for (int j = 0; j < n_p; ++j)
        p[j] = values[cells.p[cell * n_p + j]];
    }

    /// K and G of @p out.
    static void matrix(const bool                       is_symmetric,
                       const std::vector<PointBatch>   &points,
                       const std::vector<PointTangent> &tangents,
                       System                          &out)
    {
      // For one node b the products A : dN_b of all points stay in the first-level cache
      // while all nodes a run over them.
      std::vector<ProductBatch> products(tangents.size());
      for (int b = 0; b < n_x; ++b)
        {
          for (std::size_t k = 0; k < tangents.size(); ++k)
            {
              const PointTangent &at = tangents[k];
              for (int i = 0; i < dim; ++i)
                for (int J = 0; J < dim; ++J)
                  for (int l = 0; l < dim; ++l)
                    {
                      Batch product = at.A[i][J][l][0] * at.gradient[b][0];
                      for (int L = 1; L < dim; ++L)
                        product += at.A[i][J][l][L] * at.gradient[b][L];
                      products[k].B[J][i][l] = product;
                    }
              if constexpr (mixed)
                for (int i = 0; i < dim; ++i)
                  {
                    Batch normal = at.d_phi[i][0] * at.gradient[b][0];
                    for (int L = 1; L < dim; ++L)
                      normal += at.d_phi[i][L] * at.gradient[b][L];
                    products[k].normal[i] = normal;
                  }
            }

          for (int a = 0; a <= (is_symmetric ? b : n_x - 1); ++a)
            {
              Batch K[dim][dim] = {};
              for (std::size_t k = 0; k < tangents.size(); ++k)
                for (int J = 0; J < dim; ++J)
                  for (int i = 0; i < dim; ++i)
                    for (int l = 0; l < dim; ++l)
                      K[i][l] += products[k].B[J][i][l] * tangents[k].gradient[a][J];
              for (int i = 0; i < dim; ++i)
                for (int l = 0; l < dim; ++l)
                  {
                    const double entry              = sum(K[i][l]);
                    out.K[dim * a + i][dim * b + l] = entry;
                    if (is_symmetric)
                      out.K[dim * b + l][dim * a + i] = entry;
                  }
            }

          for (int j = 0; j < n_p; ++j)
            for (int i = 0; i < dim; ++i)
              {
                Batch G{};
                for (std::size_t k = 0; k < tangents.size(); ++k)
                  G += products[k].normal[i] * points[k].p_value[j];
                out.G[j][dim * b + i] = sum(G);
              }
        }
    }

    /// The change of the residual along a direction: dP = A : dF + dp dPhi/dF, without the cell's
    /// matrix. C of @p out is that of the cell; its residual is overwritten.
    static void product(const CellTables<dim>           &cells,
                        const std::size_t                cell,
                        const double                    *direction,
                        const std::vector<PointBatch>   &points,
                        const std::vector<PointTangent> &tangents,
                        System                          &out)
    {
      double du[n_x][dim], dp[System::n_q];
      gather(cells, cell, direction, du, dp);

      Batch r_u[n_x][dim] = {}, r_p[System::n_q] = {};
      for (std::size_t k = 0; k < points.size(); ++k)
        {
          const PointTangent &at           = tangents[k];
          Batch               dF[dim][dim] = {};
          for (int a = 0; a < n_x; ++a)
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                dF[i][J] += du[a][i] * at.gradient[a][J];
          Batch dq{}, strain{};
          for (int j = 0; j < n_p; ++j)
            dq += dp[j] * points[k].p_value[j];

          for (int i = 0; i < dim; ++i)
            for (int J = 0; J < dim; ++J)
              {
                Batch dP = dq * at.d_phi[i][J];
                for (int l = 0; l < dim; ++l)
                  for (int L = 0; L < dim; ++L)
                    dP += at.A[i][J][l][L] * dF[l][L];
                for (int a = 0; a < n_x; ++a)
                  r_u[a][i] += dP * at.gradient[a][J];
                strain += at.d_phi[i][J] * dF[i][J];
              }
          for (int j = 0; j < n_p; ++j)
            r_p[j] += strain * points[k].p_value[j];
        }

      for (int a = 0; a < n_x; ++a)
        for (int i = 0; i < dim; ++i)
          out.r_u[dim * a + i] = sum(r_u[a][i]);
      for (int j = 0; j < n_p; ++j)
        {
          out.r_p[j] = sum(r_p[j]);
          for (int l = 0; l < n_p; ++l)
            out.r_p[j] -= out.C[j][l] * dp[l];
        }
    }

  private:
    struct ProductBatch
    {
      Batch B[dim][dim][dim]; ///< [J][i][k] = A_iJkL dN_b/dX_L
      Batch normal[dim];      ///< dPhi/dF dN_b/dX
    };
  };
} // namespace isochor
