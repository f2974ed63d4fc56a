#pragma once

// Fill-reducing elimination order by METIS. Debian's MUMPS is built without METIS, and dissecting
// nodes instead of unknowns is both faster and better.

#include <isochor/algebra/sparse_matrix.h>

#include <vector>

namespace isochor
{
  /// Place of each unknown in the elimination order, counted from 0, by global index; on rank 0,
  /// empty elsewhere. The graph of nodes is dissected; the rows of a node are eliminated one after
  /// the other in ascending order. @p node_of_row gives the node of each locally owned row, in
  /// [0, @p n_nodes) over all ranks. Only rank 0 stores anything of the size of the whole matrix. Throws
  /// std::runtime_error if METIS fails. Collective.
  std::vector<int> nested_dissection(const SparseMatrix             &matrix,
                                     const std::vector<GlobalIndex> &node_of_row,
                                     GlobalIndex                     n_nodes);
} // namespace isochor
