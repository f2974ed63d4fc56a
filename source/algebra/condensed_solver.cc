#include <isochor/algebra/condensed_solver.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    constexpr std::uint32_t eliminated = -1;

    /// Invert the symmetric @p A by LDL^T without pivoting, which blocks of one cell do not need:
    /// they are definite. False if a pivot vanishes against the block's diagonal. Adds to the
    /// number of negative pivots.
    bool invert(std::vector<double> &A, const unsigned int n, std::size_t &negative_pivots)
    {
      double largest = 0;
      for (unsigned int i = 0; i < n; ++i)
        largest = std::max(largest, std::abs(A[i * n + i]));

      // Gauss-Jordan; the pivots are those of LDL^T.
      for (unsigned int k = 0; k < n; ++k)
        {
          const double pivot = A[k * n + k];
          // Written so that NaN fails.
          if (!(std::abs(pivot) > 1e-14 * largest))
            return false;
          negative_pivots += pivot < 0;
          A[k * n + k] = 1.;
          for (unsigned int j = 0; j < n; ++j)
            A[k * n + j] /= pivot;
          for (unsigned int i = 0; i < n; ++i)
            if (i != k)
              {
                const double factor = A[i * n + k];
                A[i * n + k]        = 0.;
                for (unsigned int j = 0; j < n; ++j)
                  A[i * n + j] -= factor * A[k * n + j];
              }
        }
      return true;
    }

    /// Number of the first row of this rank, and of all rows.
    std::pair<GlobalIndex, GlobalIndex> first_and_total(const std::size_t n, MPI_Comm communicator)
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
  } // namespace

  CondensedSolver::CondensedSolver(std::unique_ptr<DirectSolver> solver, std::vector<Group> groups)
    : solver(std::move(solver))
    , groups(std::move(groups))
  {
  }

  void CondensedSolver::analyse(const SparseMatrix             &matrix,
                                const std::vector<GlobalIndex> &node_of_row,
                                const GlobalIndex               n_nodes)
  {
    const auto    &whole        = *matrix.partitioner();
    const MPI_Comm communicator = whole.get_mpi_communicator();

    std::vector<char> is_eliminated(matrix.n_rows(), 0);
    for (const auto &[first, n] : groups)
      std::fill_n(is_eliminated.begin() + first, n, 1);
    retained.clear();
    for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
      if (!is_eliminated[row])
        retained.push_back(row);

    const GlobalIndex begin = first_and_total(retained.size(), communicator).first;
    // A double holds whole numbers up to 2^53.
    Vector index(matrix.partitioner());
    for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
      index.local_element(row) = -1;
    for (std::size_t k = 0; k < retained.size(); ++k)
      index.local_element(retained[k]) = double(begin + k);
    index.update_ghost_values();
    reduced_index.resize(matrix.n_rows() + whole.n_ghost_indices());
    for (std::size_t k = 0; k < reduced_index.size(); ++k)
      reduced_index[k] = static_cast<long long>(index.local_element(k));

    make_pattern(matrix, make_blocks(matrix));

    std::vector<GlobalIndex> nodes;
    for (const LocalIndex row : retained)
      nodes.push_back(node_of_row[row]);
    solver->analyse(reduced, nodes, n_nodes);
    reduced_rhs.reinit(reduced.partitioner());
    reduced_solution.reinit(reduced.partitioner());
  }

  CondensedSolver::Partition CondensedSolver::make_blocks(const SparseMatrix &matrix)
  {
    using Columns = std::vector<GlobalIndex>;

    const auto    &whole        = *matrix.partitioner();
    const MPI_Comm communicator = whole.get_mpi_communicator();

    // Columns of the blocks, and which ranks' rows they add to.
    blocks.clear();
    std::vector<Columns>                         columns;
    std::map<unsigned int, std::vector<Columns>> outgoing;
    std::vector<unsigned int>                    owner(reduced_index.size(),
                                    dealii::Utilities::MPI::this_mpi_process(communicator));
    std::size_t next = matrix.n_rows(); // ghosts are sorted by rank
    for (const auto &[rank, n] : whole.ghost_targets())
      for (unsigned int k = 0; k < n; ++k)
        owner[next++] = rank;

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
              const unsigned int rank = owner[column];
              if (rank == owner[first])
                continue;
              auto &to_rank = sent[rank];
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
    place.assign(matrix.columns().size(), eliminated);
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

  bool CondensedSolver::eliminate(const SparseMatrix &matrix,
                                  Block              &block,
                                  std::size_t        &negative_pivots) const
  {
    const unsigned int n = block.n;
    std::fill(block.inverse.begin(), block.inverse.end(), 0.);
    for (unsigned int i = 0; i < n; ++i)
      for (std::size_t k = matrix.row_start()[block.first + i];
           k < matrix.row_start()[block.first + i + 1];
           ++k)
        {
          const LocalIndex column = matrix.columns()[k];
          if (column >= block.first && column < block.first + n)
            block.inverse[i * n + column - block.first] = matrix.values()[k];
          else if (reduced_index[column] < 0 && matrix.values()[k] != 0.)
            throw std::logic_error("groups of eliminated unknowns couple");
        }
    if (!invert(block.inverse, n, negative_pivots))
      return false;

    const std::size_t n_columns = block.columns.size();
    block.R.resize(n * n_columns);
    block.W.assign(n * n_columns, 0.);
    for (std::size_t k = 0; k < block.entries.size(); ++k)
      block.R[k] = matrix.values()[block.entries[k]];
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (std::size_t k = 0; k < n_columns; ++k)
          block.W[i * n_columns + k] += block.inverse[i * n + j] * block.R[j * n_columns + k];
    return true;
  }

  void CondensedSolver::subtract(const LocalIndex               row,
                                 const std::vector<LocalIndex> &columns,
                                 const double                  *values)
  {
    const auto begin = reduced.columns().begin() + reduced.row_start()[row];
    const auto end   = reduced.columns().begin() + reduced.row_start()[row + 1];
    double    *out   = &reduced.values()[reduced.row_start()[row]];
    auto       at    = begin;
    for (std::size_t k = 0; k < columns.size(); ++k)
      {
        // Columns mostly ascend.
        if (at == end || *at > columns[k])
          at = begin;
        at = std::lower_bound(at, end, columns[k]);
        out[at - begin] -= values[k];
      }
  }

  void CondensedSolver::subtract_blocks()
  {
    const LocalIndex    n_rows = retained.size();
    std::vector<double> product;
    const auto          multiply = [&](const Block &block, const std::size_t k) {
      // Row k of R^T D^-1 R.
      const std::size_t n_columns = block.columns.size();
      product.assign(n_columns, 0.);
      for (unsigned int i = 0; i < block.n; ++i)
        if (const double r = block.R[i * n_columns + k]; r != 0.)
          for (std::size_t l = 0; l < n_columns; ++l)
            product[l] += r * block.W[i * n_columns + l];
    };

    for (const Block &block : blocks)
      for (std::size_t k = 0; k < block.columns.size(); ++k)
        if (block.columns[k] < n_rows)
          {
            multiply(block, k);
            subtract(block.columns[k], block.columns, product.data());
          }

    // Rows of other ranks: each gets its rows of a block in ascending order of the block's columns.
    const auto    &partitioner  = *reduced.partitioner();
    const MPI_Comm communicator = partitioner.get_mpi_communicator();
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    std::vector<unsigned int> owner(partitioner.n_ghost_indices());
    std::size_t               next = 0;
    for (const auto &[rank, n] : partitioner.ghost_targets())
      for (unsigned int k = 0; k < n; ++k)
        owner[next++] = rank;
    std::map<unsigned int, std::vector<double>> outgoing;
    for (const auto &[rank, numbers] : sent)
      for (const std::size_t number : numbers)
        {
          const Block &block = blocks[number];
          for (std::size_t k = 0; k < block.columns.size(); ++k)
            if (block.columns[k] >= n_rows && owner[block.columns[k] - n_rows] == rank)
              {
                multiply(block, k);
                outgoing[rank].insert(outgoing[rank].end(), product.begin(), product.end());
              }
        }
    const auto incoming = dealii::Utilities::MPI::some_to_some(communicator, outgoing);
    for (const auto &[rank, values] : incoming)
      {
        const double *at = values.data();
        for (const Foreign &columns : received.at(rank))
          for (const LocalIndex row : columns)
            if (row < n_rows)
              {
                subtract(row, columns, at);
                at += columns.size();
              }
      }
  }

  Factorisation CondensedSolver::factor(const SparseMatrix &matrix)
  {
    const MPI_Comm communicator = matrix.partitioner()->get_mpi_communicator();
    auto          &values       = reduced.values();
    std::fill(values.begin(), values.end(), 0.);
    for (LocalIndex row = 0; row < retained.size(); ++row)
      for (std::size_t k = matrix.row_start()[retained[row]];
           k < matrix.row_start()[retained[row] + 1];
           ++k)
        if (place[k] != eliminated)
          values[reduced.row_start()[row] + place[k]] = matrix.values()[k];

    std::size_t  negative_pivots = 0;
    unsigned int singular        = 0;
    for (Block &block : blocks)
      if (!eliminate(matrix, block, negative_pivots))
        ++singular;
    singular = dealii::Utilities::MPI::sum(singular, communicator);
    if (singular > 0)
      {
        Factorisation failed;
        failed.failure = std::to_string(singular)
                         + " blocks that are eliminated before the others are singular";
        failed.null_pivots = singular;
        return failed;
      }
    subtract_blocks();

    Factorisation factorisation = solver->factor(reduced);
    if (factorisation.negative_pivots)
      *factorisation.negative_pivots += dealii::Utilities::MPI::sum(negative_pivots, communicator);
    return factorisation;
  }

  void CondensedSolver::solve(Vector &solution, const Vector &rhs)
  {
    reduced_rhs = 0.;
    for (std::size_t k = 0; k < retained.size(); ++k)
      reduced_rhs.local_element(k) = rhs.local_element(retained[k]);
    for (const Block &block : blocks)
      for (unsigned int i = 0; i < block.n; ++i)
        for (std::size_t k = 0; k < block.columns.size(); ++k)
          reduced_rhs.local_element(block.columns[k])
              -= block.W[i * block.columns.size() + k] * rhs.local_element(block.first + i);
    reduced_rhs.compress(dealii::VectorOperation::add);

    solver->solve(reduced_solution, reduced_rhs);

    reduced_solution.update_ghost_values();
    for (std::size_t k = 0; k < retained.size(); ++k)
      solution.local_element(retained[k]) = reduced_solution.local_element(k);
    for (const Block &block : blocks)
      for (unsigned int i = 0; i < block.n; ++i)
        {
          double value = 0;
          for (unsigned int j = 0; j < block.n; ++j)
            value += block.inverse[i * block.n + j] * rhs.local_element(block.first + j);
          for (std::size_t k = 0; k < block.columns.size(); ++k)
            value -= block.W[i * block.columns.size() + k]
                     * reduced_solution.local_element(block.columns[k]);
          solution.local_element(block.first + i) = value;
        }
    reduced_solution.zero_out_ghost_values();
  }
} // namespace isochor
