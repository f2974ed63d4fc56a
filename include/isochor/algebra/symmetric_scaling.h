#pragma once

// S A S with a positive diagonal S: metres and cubic metres, newtons and pascals side by side in one
// matrix become numbers of one size, which single precision and norms of residuals need.

#include <isochor/algebra/sparse_matrix.h>

namespace isochor
{
  class SymmetricScaling
  {
  public:
    /// The first @p n_definite owned rows of each rank, @p n_together that follow each other with the
    /// same factor, get a mean diagonal of 1; the others (pressures) a largest coupling with those of
    /// 1, or, where there is none but rounding's, a diagonal of 1. Collective.
    void
    compute(const SparseMatrix &matrix, LocalIndex n_definite, unsigned int n_together);

    /// matrix = S matrix S
    void apply(SparseMatrix &matrix) const;

    /// vector = S vector, the owned entries; ghosts are zeroed.
    void apply(Vector &vector) const;

  private:
    Vector factors; ///< ghosts up to date
  };
} // namespace isochor
