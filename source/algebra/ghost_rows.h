#pragma once

// Where rows of other ranks are.

#include <isochor/algebra/sparse_matrix.h>

#include <deal.II/base/mpi.h>

namespace isochor
{
  /// Rank of each ghost, in their order: ghosts are sorted by rank.
  inline std::vector<unsigned int> ghost_owners(const SparseMatrix::Partitioner &partitioner)
  {
    std::vector<unsigned int> owners;
    for (const auto &[rank, n] : partitioner.ghost_targets())
      owners.insert(owners.end(), n, rank);
    return owners;
  }

  /// Number of the first row of this rank, and of all rows.
  inline std::pair<GlobalIndex, GlobalIndex> first_and_total(const std::size_t n,
                                                             MPI_Comm          communicator)
  {
    std::pair<GlobalIndex, GlobalIndex> result{0, 0};
    const unsigned int rank   = dealii::Utilities::MPI::this_mpi_process(communicator);
    const auto         counts = dealii::Utilities::MPI::all_gather(communicator, n);
    for (unsigned int r = 0; r < counts.size(); ++r)
      {
        result.first += r < rank ? counts[r] : 0;
        result.second += counts[r];
      }
    return result;
  }
} // namespace isochor
