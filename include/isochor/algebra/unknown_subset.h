#pragma once

// Some unknowns of every rank, the displacements or the pressures alone, numbered for themselves.

#include <isochor/algebra/sparse_matrix.h>

#include <limits>

namespace isochor
{
  struct UnknownSubset
  {
    static constexpr LocalIndex outside = std::numeric_limits<LocalIndex>::max();

    LocalIndex                                       n_owned = 0;
    std::shared_ptr<const SparseMatrix::Partitioner> partitioner;
    /// By local index of the whole, ghosts behind: local index in the subset, or `outside`.
    std::vector<LocalIndex> local;
  };

  /// @p owned: local indices of the subset's unknowns of this rank, ascending; of all ranks not none.
  /// Collective.
  UnknownSubset make_subset(const std::shared_ptr<const SparseMatrix::Partitioner> &whole,
                            const std::vector<LocalIndex>                          &owned);
} // namespace isochor
