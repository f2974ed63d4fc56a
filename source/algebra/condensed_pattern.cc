// Static condensation, symbolic part: which rows of which ranks each eliminated block adds to.

#include "ghost_rows.h"

#include <isochor/algebra/condensed_solver.h>

#include <algorithm>
#include <stdexcept>

namespace isochor
{
  CondensedSolver::Partition CondensedSolver::make_blocks(const SparseMatrix &matrix)
  {
    using Columns = std::vector<GlobalIndex>;

    const auto    &whole        = *matrix.partitioner();
    const MPI_Comm communicator = whole.get_mpi_communicator();

    // Columns of the blocks, and which ranks' rows they add to.
    blocks.clear();
    std::vector<Columns>                         columns;
    std::map<unsigned int, std::vector<Columns>> outgoing;
    const std::vector<unsigned int>              ghost_owner = ghost_owners(whole);

    sent.clear();
    for (const auto &[first, n] : groups)
      {
        Block   block{first, n, {}, {}, {}, {}, {}};
        Columns of_block;
        for (LocalIndex row = first; row < first + n; ++row)
          for (std::size_t k = matrix.row_start()[row]; k < matrix.row_start()[row + 1]; ++k)
            {
              const LocalIndex column = matrix.columns()[k];
              if (reduced_index[column] < 0)
                continue;
              block.entries.push_back(k);
              if (row > first)
                continue;
              of_block.push_back(reduced_index[column]);
              if (column < matrix.n_rows())
                continue;
              auto &to_rank = sent[ghost_owner[column - matrix.n_rows()]];
              if (to_rank.empty() || to_rank.back() != blocks.size())
                to_rank.push_back(blocks.size());
            }
        if (block.entries.size() != n * of_block.size())
          throw std::logic_error("the rows of a group have different columns");
        block.inverse.resize(n * n);
        blocks.push_back(std::move(block));
        columns.push_back(std::move(of_block));
      }
    for (const auto &[rank, numbers] : sent)
      for (const std::size_t number : numbers)
        outgoing[rank].push_back(columns[number]);
    const auto incoming = dealii::Utilities::MPI::some_to_some(communicator, outgoing);

    // Ghosts of the reduced system: what its rows couple with, before or after the elimination.
    std::vector<GlobalIndex> ghosts;
    const auto               begin = first_and_total(retained.size(), communicator);
    dealii::IndexSet         owned(begin.second), relevant(begin.second);
    owned.add_range(begin.first, begin.first + retained.size());
    for (std::size_t k = matrix.n_rows(); k < reduced_index.size(); ++k)
      if (reduced_index[k] >= 0)
        ghosts.push_back(reduced_index[k]);
    for (const auto &[rank, lists] : incoming)
      for (const Columns &list : lists)
        ghosts.insert(ghosts.end(), list.begin(), list.end());
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    relevant.add_indices(ghosts.begin(), ghosts.end());
    relevant.subtract_set(owned);
    const auto partitioner
        = std::make_shared<SparseMatrix::Partitioner>(owned, relevant, communicator);

    const auto to_local = [&](const Columns &global) {
      std::vector<LocalIndex> local;
      for (const GlobalIndex g : global)
        local.push_back(partitioner->global_to_local(g));
      return local;
    };
    for (std::size_t b = 0; b < blocks.size(); ++b)
      blocks[b].columns = to_local(columns[b]);
    received.clear();
    for (const auto &[rank, lists] : incoming)
      for (const Columns &list : lists)
        received[rank].push_back(to_local(list));
    return partitioner;
  }

  void CondensedSolver::make_pattern(const SparseMatrix &matrix, const Partition &partitioner)
  {
    const LocalIndex n = retained.size();

    // Lists of columns that are added to each row.
    std::vector<std::vector<const std::vector<LocalIndex> *>> added(n);
    const auto add = [&](const std::vector<LocalIndex> &columns) {
      for (const LocalIndex row : columns)
        if (row < n)
          added[row].push_back(&columns);
    };
    for (const Block &block : blocks)
      add(block.columns);
    for (const auto &[rank, lists] : received)
      for (const Foreign &list : lists)
        add(list);

    std::vector<LocalIndex> to_reduced(reduced_index.size());
    for (std::size_t k = 0; k < reduced_index.size(); ++k)
      if (reduced_index[k] >= 0)
        to_reduced[k] = partitioner->global_to_local(reduced_index[k]);

    std::vector<std::size_t> row_start(n + 1, 0);
    std::vector<LocalIndex>  all_columns, of_row;
    place.assign(matrix.columns().size(), eliminated_column);
    for (LocalIndex row = 0; row < n; ++row)
      {
        of_row.clear();
        const auto first = matrix.row_start()[retained[row]];
        const auto last  = matrix.row_start()[retained[row] + 1];
        for (std::size_t k = first; k < last; ++k)
          if (reduced_index[matrix.columns()[k]] >= 0)
            of_row.push_back(to_reduced[matrix.columns()[k]]);
        for (const auto *columns : added[row])
          of_row.insert(of_row.end(), columns->begin(), columns->end());
        std::sort(of_row.begin(), of_row.end());
        of_row.erase(std::unique(of_row.begin(), of_row.end()), of_row.end());
        for (std::size_t k = first; k < last; ++k)
          if (reduced_index[matrix.columns()[k]] >= 0)
            place[k]
                = std::lower_bound(of_row.begin(), of_row.end(), to_reduced[matrix.columns()[k]])
                  - of_row.begin();
        row_start[row + 1] = row_start[row] + of_row.size();
        all_columns.insert(all_columns.end(), of_row.begin(), of_row.end());
      }
    reduced.reinit(partitioner, std::move(row_start), std::move(all_columns));
  }
} // namespace isochor
