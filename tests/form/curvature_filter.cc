// The filter of dP/dF on matrices whose eigenvalues are known by construction: sum of s_k v_k v_k^T
// with v_k the columns of a reflection I - 2 w w^T / w.w, so that the filtered matrix is known too.

#include "../common/report.h"

#include <isochor/form/curvature_filter.h>

#include <cmath>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  /// Entry (k, l) of the matrix with eigenvalues @p s.
  double entry(const std::vector<double> &s, const unsigned int k, const unsigned int l)
  {
    const unsigned int n     = s.size();
    const auto         w     = [](const unsigned int i) { return std::sin(1. + i); };
    double             total = 0, sum = 0;
    for (unsigned int i = 0; i < n; ++i)
      total += w(i) * w(i);
    const auto v = [&](const unsigned int i, const unsigned int m) {
      return (i == m ? 1. : 0.) - 2. * w(i) * w(m) / total;
    };
    for (unsigned int m = 0; m < n; ++m)
      sum += s[m] * v(k, m) * v(l, m);
    return sum;
  }

  void check(const unsigned int         dim,
             const CurvatureFilter      filter,
             const std::vector<double> &before,
             const std::vector<double> &after)
  {
    // Rows and columns of F_iJ beyond dim are not to be touched; an antisymmetric part is dropped.
    constexpr double elsewhere = -7.;
    Response         response;
    for (Batch &a : response.A)
      a = batch(elsewhere);
    const auto at = [&](const unsigned int k, const unsigned int l) -> Batch & {
      const auto index = [dim](const unsigned int m) { return 3 * (m / dim) + m % dim; };
      return response.A[9 * index(k) + index(l)];
    };
    const unsigned int n    = dim * dim;
    const double       skew = filter == CurvatureFilter::none ? 0. : 0.5;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          at(k, l)[lane] = (1. + lane) * entry(before, k, l) + skew * (double(k) - double(l));

    filter_curvature(filter, dim, response);

    double error = 0, largest = 0;
    for (const double eigenvalue : before)
      raise(largest, n_lanes * std::abs(eigenvalue));
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = 0; l < n; ++l)
        {
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            raise(error, std::abs(at(k, l)[lane] - (1. + lane) * entry(after, k, l)));
          at(k, l) = batch(elsewhere);
        }
    for (const Batch &a : response.A)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        raise(error, std::abs(a[lane] - elsewhere));
    std::cout << "  " << dim << "D, " << curvature_filter_names.name(filter) << ": "
              << below(error / largest, 1e-13) << '\n';
  }
} // namespace

int main()
{
  const std::vector<double> mixed_2d{3, -2, 0, 1e-3}, mixed_3d{4, -1, 2, 0, -3, 1e-3, 5, 1, -1e-3};
  std::cout << "positive, zero and negative eigenvalues\n";
  check(2, CurvatureFilter::none, mixed_2d, mixed_2d);
  check(2, CurvatureFilter::projected, mixed_2d, {3, 0, 0, 1e-3});
  check(2, CurvatureFilter::absolute, mixed_2d, {3, 2, 0, 1e-3});
  check(3, CurvatureFilter::none, mixed_3d, mixed_3d);
  check(3, CurvatureFilter::projected, mixed_3d, {4, 0, 2, 0, 0, 1e-3, 5, 1, 0});
  check(3, CurvatureFilter::absolute, mixed_3d, {4, 1, 2, 0, 3, 1e-3, 5, 1, 1e-3});
  const std::vector<double> definite{1, 2, 3, 4, 5, 5, 5, 6, 1e3};
  std::cout << "only positive ones, some of them equal\n";
  check(3, CurvatureFilter::projected, definite, definite);
}
