#include "ghost_rows.h"

#include <isochor/algebra/unknown_subset.h>

namespace isochor
{
  UnknownSubset make_subset(const std::shared_ptr<const SparseMatrix::Partitioner> &whole,
                            const std::vector<LocalIndex>                          &owned)
  {
    const MPI_Comm    communicator = whole->get_mpi_communicator();
    const std::size_t n_owned      = owned.size();
    const auto [first, total]      = first_and_total(n_owned, communicator);
    UnknownSubset subset;
    subset.n_owned = n_owned;
    subset.local.assign(whole->locally_owned_size() + whole->n_ghost_indices(),
                        UnknownSubset::outside);

    // A double holds whole numbers up to 2^53.
    Vector index(whole);
    index = -1.;
    for (std::size_t k = 0; k < n_owned; ++k)
      {
        subset.local[owned[k]]        = k;
        index.local_element(owned[k]) = double(first + k);
      }
    index.update_ghost_values();
    std::vector<GlobalIndex> foreign;
    // Ranks and their unknowns keep their order, so that ghosts stay ascending.
    for (LocalIndex i = whole->locally_owned_size(); i < subset.local.size(); ++i)
      if (const double global = index.local_element(i); global >= 0.)
        {
          subset.local[i] = n_owned + foreign.size();
          foreign.push_back(GlobalIndex(global));
        }
    dealii::IndexSet range(total), ghosts(total);
    range.add_range(first, first + n_owned);
    ghosts.add_indices(foreign.begin(), foreign.end());
    subset.partitioner
        = std::make_shared<const SparseMatrix::Partitioner>(range, ghosts, communicator);
    return subset;
  }
} // namespace isochor
