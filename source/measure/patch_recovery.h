#pragma once

// Continuous fields from samples of discontinuous ones: superconvergent patch recovery (Zienkiewicz and
// Zhu 1992).

#include <isochor/space/cell_tables.h>

#include <optional>

namespace isochor
{
  /// Monomials up to a degree, the total one or that in each coordinate.
  template <int dim>
  class Monomials
  {
  public:
    Monomials(const unsigned int degree, const bool is_total)
      : degree(degree)
      , is_total(is_total)
    {
      std::vector<double> values;
      evaluate({}, values);
      n = values.size();
    }

    unsigned int size() const
    {
      return n;
    }

    void evaluate(const dealii::Tensor<1, dim> &x, std::vector<double> &values) const
    {
      values.clear();
      double first = 1.;
      for (unsigned int i = 0; i <= degree; ++i, first *= x[0])
        {
          double second = first;
          for (unsigned int j = 0; j + (is_total ? i : 0) <= degree; ++j, second *= x[1])
            if constexpr (dim == 2)
              values.push_back(second);
            else
              {
                double third = second;
                for (unsigned int k = 0; k + (is_total ? i + j : 0) <= degree; ++k, third *= x[2])
                  values.push_back(third);
              }
        }
    }

  private:
    unsigned int degree;
    bool         is_total;
    unsigned int n = 0;
  };

  /// What is sampled at the points of the cells: [(cell * n_points + q) * n_fields + field].
  template <int dim>
  struct Samples
  {
    unsigned int                    n_points = 0, n_fields = 0;
    std::vector<double>             values;
    std::vector<dealii::Point<dim>> positions; ///< [cell * n_points + q], reference, m
  };

  /// How samples are fitted.
  template <int dim>
  struct PatchFit
  {
    Monomials<dim> monomials;
    unsigned int   least_samples; ///< of a patch, if there are cells enough

    /// For a body with @p n_samples: monomials up to @p degree in each coordinate on hypercubes, whose
    /// derivatives have them; up to the total degree on simplices and on few hypercubes, there in
    /// larger patches, which errs on the safe side. None where samples are too few.
    static std::optional<PatchFit>
    choose(CellKind kind, unsigned int degree, std::size_t n_samples);
  };

  /// Around every vertex a polynomial fitted to the samples of the cells there, blended by the hat
  /// functions of the vertices.
  template <int dim>
  class PatchRecovery
  {
  public:
    /// @p cells must outlive this.
    PatchRecovery(const CellTables<dim> &cells,
                  const Samples<dim>    &samples,
                  const PatchFit<dim>   &how);

    /// Values of all fields at @p xi of a cell, which is at @p position. Not collective.
    void evaluate(std::size_t               cell,
                  const dealii::Point<dim> &xi,
                  const dealii::Point<dim> &position,
                  std::vector<double>      &values) const;

  private:
    struct Patch
    {
      dealii::Point<dim>      centre;
      double                  size = 0;     ///< of the coordinates in it, m
      std::vector<LocalIndex> cells;        ///< this rank's
      std::vector<double>     coefficients; ///< [monomial * n_fields + field]
    };

    int &patch_of(const std::size_t cell, const unsigned int v)
    {
      return number[cells.x[cell * cells.n_x + v]];
    }
    int patch_of(const std::size_t cell, const unsigned int v) const
    {
      return number[cells.x[cell * cells.n_x + v]];
    }

    void                    collect_stars();
    std::vector<LocalIndex> neighbours(const std::vector<LocalIndex> &of,
                                       const std::vector<Patch>      &stars) const;
    void                    fit(const Samples<dim> &samples, Patch &patch) const;

    const CellTables<dim>                           &cells;
    const unsigned int                               n_fields;
    const std::unique_ptr<const ShapeFunctions<dim>> hats;
    const PatchFit<dim>                              how;
    std::vector<Patch>                               patches;
    std::vector<int>                                 number; ///< by the vertex' first unknown
  };
} // namespace isochor
