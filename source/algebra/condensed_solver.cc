#include "ghost_rows.h"

#include <isochor/algebra/condensed_solver.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isochor
{
  namespace
  {
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
    const std::vector<unsigned int>             owner = ghost_owners(partitioner);
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
        if (place[k] != eliminated_column)
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
