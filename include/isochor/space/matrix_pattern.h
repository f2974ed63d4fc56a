#pragma once

// The tangent's sparsity pattern, and where in it each pair of nodes of a cell writes.

#include <isochor/algebra/sparse_matrix.h>
#include <isochor/space/discretisation.h>

namespace isochor
{
  /// Cell matrices go into SparseMatrix::values() by these offsets, without a search. A local
  /// node is a displacement node (0 .. n_x - 1) or a pressure node (n_x .. n_x + n_p - 1).
  struct CellOffsets
  {
    unsigned int n_local = 0; ///< n_x + n_p
    /// [(cell * n_local + r) * n_local + s]: position, counted from the start of any row of local
    /// node r, of the first column of local node s; a displacement node has dim rows and
    /// dim consecutive columns. Only filled where the rows are on this rank.
    std::vector<std::uint32_t> offset;

    const std::uint32_t *row(const std::size_t cell, const unsigned int r) const
    {
      return &offset[(cell * n_local + r) * n_local];
    }
  };

  /// Every unknown couples with all unknowns of the cells around it. Fills @p matrix with zeros.
  template <int dim>
  CellOffsets make_pattern(const Discretisation<dim> &discretisation, SparseMatrix &matrix);
} // namespace isochor
