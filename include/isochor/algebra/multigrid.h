#pragma once

// Algebraic multigrid by smoothed aggregation (Trilinos ML) for an elastic body: nodes are
// aggregated whole, and the coarse levels hold the rigid motions exactly.

#include <isochor/algebra/sparse_matrix.h>

namespace isochor
{
  class Multigrid
  {
  public:
    Multigrid();
    ~Multigrid();

    /// @p matrix: symmetric positive definite, @p n_components rows of a node follow each other; it is
    /// copied. @p modes: vectors that it hardly resists, by owned rows. Throws std::runtime_error if
    /// ML fails. Collective.
    void build(const SparseMatrix                     &matrix,
               unsigned int                            n_components,
               const std::vector<std::vector<double>> &modes);

    /// @p out = one W-cycle on @p in, owned rows. Collective.
    void apply(double *out, const double *in) const;

  private:
    struct Trilinos;
    std::unique_ptr<Trilinos> trilinos;
  };
} // namespace isochor
