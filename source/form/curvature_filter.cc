#include <isochor/form/curvature_filter.h>
#include <isochor/material/lanes.h>

namespace isochor
{
  namespace
  {
    constexpr unsigned int largest = 9;
    using Matrix                   = Batch[largest][largest]; // eight matrices, one in each lane

    /// Rows or columns p, q of a matrix, entry by entry, turned by cosine and sine.
    void turn(const Batch &c, const Batch &s, Batch &p, Batch &q)
    {
      const Batch a = p, b = q;
      p = c * a - s * b;
      q = s * a + c * b;
    }

    /// Cyclic Jacobi: @p A, symmetric n x n, becomes diagonal up to rounding; the columns of @p Q
    /// are its eigenvectors.
    void diagonalise(const unsigned int n, Matrix &A, Matrix &Q)
    {
      constexpr unsigned int max_sweeps = 30;
      const Batch            zero = batch(0.), one = batch(1.);
      Batch                  scale = zero;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          {
            Q[i][j] = i == j ? one : zero;
            scale += A[i][j] * A[i][j];
          }
      for (unsigned int sweep = 0; sweep < max_sweeps; ++sweep)
        {
          Batch off = zero;
          for (unsigned int p = 0; p < n; ++p)
            for (unsigned int q = p + 1; q < n; ++q)
              off += A[p][q] * A[p][q];
          bool goes_on = false;
          for (unsigned int lane = 0; lane < n_lanes; ++lane) // written so that NaN ends it
            goes_on = goes_on || off[lane] > 1e-30 * scale[lane];
          if (!goes_on)
            return;
          for (unsigned int p = 0; p < n; ++p)
            for (unsigned int q = p + 1; q < n; ++q)
              {
                // theta may be infinite, and is none where the entry is zero already.
                const Batch theta = 0.5 * (A[q][q] - A[p][p]) / A[p][q];
                const Batch size  = theta < zero ? -theta : theta;
                Batch       t     = (theta < zero ? -one : one) / (size + sqrt(theta * theta + 1.));
                t                 = A[p][q] == zero ? zero : t;
                const Batch c = 1. / sqrt(t * t + 1.), s = t * c;
                for (unsigned int k = 0; k < n; ++k)
                  turn(c, s, A[k][p], A[k][q]);
                for (unsigned int k = 0; k < n; ++k)
                  turn(c, s, A[p][k], A[q][k]);
                for (unsigned int k = 0; k < n; ++k)
                  turn(c, s, Q[k][p], Q[k][q]);
              }
        }
    }

    Batch filtered(const CurvatureFilter filter, const Batch &eigenvalue)
    {
      const Batch zero    = batch(0.);
      const Batch instead = filter == CurvatureFilter::absolute ? -eigenvalue : zero;
      return eigenvalue < zero ? instead : eigenvalue;
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
    Matrix A, Q;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        A[k][l] = 0.5 * (response.A[9 * index[k] + index[l]] + response.A[9 * index[l] + index[k]]);
    diagonalise(n, A, Q);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        {
          Batch sum = batch(0.);
          for (unsigned int m = 0; m < n; ++m)
            sum += Q[k][m] * filtered(filter, A[m][m]) * Q[l][m];
          response.A[9 * index[k] + index[l]] = sum;
        }
  }
} // namespace isochor
