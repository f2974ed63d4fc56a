#include "patch_recovery.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /// Of a body, per coefficient of a polynomial: one that fits all samples hides the error.
    constexpr unsigned int least_samples_per_coefficient = 6;
    /// Of the first normal equation's diagonal: keeps coefficients at zero that no sample tells of, as
    /// across a wall one cell thick.
    constexpr double ridge = 1e-6;
  } // namespace

  template <int dim>
  std::optional<PatchFit<dim>>
  PatchFit<dim>::choose(const CellKind kind, const unsigned int degree, const std::size_t n_samples)
  {
    const auto enough = [&](const Monomials<dim> &monomials) {
      return n_samples >= least_samples_per_coefficient * monomials.size();
    };
    const bool           is_simplex = kind == CellKind::simplex;
    const Monomials<dim> in_each(degree, false), total(degree, true);
    if (!is_simplex && enough(in_each))
      return PatchFit{in_each, in_each.size()};
    if (enough(total))
      return PatchFit{total, is_simplex ? total.size() : 2 * total.size()};
    return {};
  }

  template <int dim>
  PatchRecovery<dim>::PatchRecovery(const CellTables<dim> &cells,
                                    const Samples<dim>    &samples,
                                    const PatchFit<dim>   &how)
    : cells(cells)
    , n_fields(samples.n_fields)
    , hats(make_shape_functions<dim>(cells.kind, {Family::lagrange, 1}))
    , how(how)
  {
    collect_stars();
    const auto stars = patches;
    for (std::size_t k = 0; k < patches.size(); ++k)
      {
        if (patches[k].cells.size() * samples.n_points < how.least_samples)
          patches[k].cells = neighbours(stars[k].cells, stars);
        fit(samples, patches[k]);
      }
  }

  template <int dim>
  void PatchRecovery<dim>::evaluate(const std::size_t         cell,
                                    const dealii::Point<dim> &xi,
                                    const dealii::Point<dim> &position,
                                    std::vector<double>      &values) const
  {
    std::vector<double> terms;
    values.assign(n_fields, 0.);
    for (unsigned int v = 0; v < hats->n_nodes(); ++v)
      {
        const Patch &patch = patches[patch_of(cell, v)];
        const double hat   = hats->value(v, xi);
        how.monomials.evaluate((position - patch.centre) / patch.size, terms);
        for (unsigned int a = 0; a < how.monomials.size(); ++a)
          for (unsigned int f = 0; f < n_fields; ++f)
            values[f] += hat * terms[a] * patch.coefficients[a * n_fields + f];
      }
  }

  /// A patch for each vertex, of the cells around it.
  template <int dim>
  void PatchRecovery<dim>::collect_stars()
  {
    number.assign(cells.x.empty() ? 0 : 1 + *std::ranges::max_element(cells.x), -1);
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int v = 0; v < hats->n_nodes(); ++v)
        {
          int &patch = patch_of(cell, v);
          if (patch < 0)
            {
              patch = patches.size();
              patches.push_back({cells.vertex(cell, v), 0., {}, {}});
            }
          patches[patch].cells.push_back(cell);
        }
  }

  template <int dim>
  std::vector<LocalIndex> PatchRecovery<dim>::neighbours(const std::vector<LocalIndex> &of,
                                                         const std::vector<Patch>      &stars) const
  {
    std::vector<LocalIndex> all;
    for (const LocalIndex cell : of)
      for (unsigned int v = 0; v < hats->n_nodes(); ++v)
        {
          const auto &star = stars[patch_of(cell, v)].cells;
          all.insert(all.end(), star.begin(), star.end());
        }
    std::ranges::sort(all);
    const auto [first, last] = std::ranges::unique(all);
    all.erase(first, last);
    return all;
  }

  /// Least squares.
  template <int dim>
  void PatchRecovery<dim>::fit(const Samples<dim> &samples, Patch &patch) const
  {
    std::vector<std::size_t> points;
    for (const std::size_t cell : patch.cells)
      for (unsigned int q = 0; q < samples.n_points; ++q)
        points.push_back(cell * samples.n_points + q);
    for (const std::size_t point : points)
      patch.size = std::max(patch.size, samples.positions[point].distance(patch.centre));

    const unsigned int               n = how.monomials.size();
    dealii::LAPACKFullMatrix<double> normal(n, n), rhs(n, n_fields);
    std::vector<double>              terms;
    for (const std::size_t point : points)
      {
        how.monomials.evaluate((samples.positions[point] - patch.centre) / patch.size, terms);
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            normal(a, b) += terms[a] * terms[b];
        for (unsigned int f = 0; f < n_fields; ++f)
          for (unsigned int a = 0; a < n; ++a)
            rhs(a, f) += terms[a] * samples.values[point * n_fields + f];
      }
    for (unsigned int a = 0; a < n; ++a)
      normal(a, a) += ridge * points.size();
    normal.set_property(dealii::LAPACKSupport::symmetric);
    normal.compute_cholesky_factorization();
    normal.solve(rhs);
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int f = 0; f < n_fields; ++f)
        patch.coefficients.push_back(rhs(a, f));
  }

  template struct PatchFit<2>;
  template struct PatchFit<3>;
  template class PatchRecovery<2>;
  template class PatchRecovery<3>;
} // namespace isochor
