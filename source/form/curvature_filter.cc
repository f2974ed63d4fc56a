#include <isochor/form/curvature_filter.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    constexpr unsigned int largest = 9;
    using Matrix                   = double[largest][largest];

    /// Cyclic Jacobi: @p A, symmetric n x n, becomes diagonal up to rounding; the columns of @p Q
    /// are its eigenvectors.
    void diagonalise(const unsigned int n, Matrix &A, Matrix &Q)
    {
      constexpr unsigned int max_sweeps = 30;
      double                 scale      = 0;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            Q[i][j] = i == j ? 1. : 0.;
            scale += A[i][j] * A[i][j];
          }
      for (unsigned int sweep = 0; sweep < max_sweeps; ++sweep)
        {
          double off = 0;
          for (unsigned int p = 0; p < n; ++p)
            for (unsigned int q = p + 1; q < n; ++q)
              off += A[p][q] * A[p][q];
          // Written so that NaN ends it.
          if (!(off > 1e-30 * scale))
            return;
          for (unsigned int p = 0; p < n; ++p)
            for (unsigned int q = p + 1; q < n; ++q)
              {
                if (A[p][q] == 0.)
                  continue;
                const double theta = 0.5 * (A[q][q] - A[p][p]) / A[p][q];
                const double t = (theta < 0 ? -1. : 1.) / (std::abs(theta) + std::hypot(theta, 1.));
                const double c = 1. / std::hypot(t, 1.), s = t * c;
                for (unsigned int k = 0; k < n; ++k)
                  {
                    const double a = A[k][p], b = A[k][q];
                    A[k][p] = c * a - s * b;
                    A[k][q] = s * a + c * b;
                  }
                for (unsigned int k = 0; k < n; ++k)
                  {
                    const double a = A[p][k], b = A[q][k];
                    A[p][k] = c * a - s * b;
                    A[q][k] = s * a + c * b;
                  }
                for (unsigned int k = 0; k < n; ++k)
                  {
                    const double a = Q[k][p], b = Q[k][q];
                    Q[k][p] = c * a - s * b;
                    Q[k][q] = s * a + c * b;
                  }
              }
        }
    }

    double filtered(const CurvatureFilter filter, const double eigenvalue)
    {
      if (eigenvalue >= 0.)
        return eigenvalue;
      return filter == CurvatureFilter::absolute ? -eigenvalue : 0.;
    }
  } // namespace

  void filter_curvature(const CurvatureFilter filter, const unsigned int dim, Response &response)
  {
    if (filter == CurvatureFilter::none)
      return;
    const unsigned int n = dim * dim;
    unsigned int       index[largest]; // of dF_iJ, in 3 i + J
    for (unsigned int k = 0; k < n; ++k)
      index[k] = 3 * (k / dim) + k % dim;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        Matrix A, Q;
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int l = 0; l < n; ++l)
            A[k][l] = 0.5
                      * (response.A[9 * index[k] + index[l]][lane]
                         + response.A[9 * index[l] + index[k]][lane]);
        diagonalise(n, A, Q);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int l = 0; l < n; ++l)
            {
              double sum = 0;
              for (unsigned int m = 0; m < n; ++m)
                sum += Q[k][m] * filtered(filter, A[m][m]) * Q[l][m];
              response.A[9 * index[k] + index[l]][lane] = sum;
            }
      }
  }
} // namespace isochor
