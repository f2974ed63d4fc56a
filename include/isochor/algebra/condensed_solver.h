#pragma once

// Static condensation: small groups of unknowns are eliminated block by block before a direct
// solver sees the matrix. Bubbles and discontinuous pressures (a group per cell) or a continuous
// pressure with a diagonal compliance matrix (a group per pressure; section 8.1, equation 37).

#include <isochor/algebra/direct_solver.h>

#include <map>

namespace isochor
{
  class CondensedSolver : public DirectSolver
  {
  public:
    /// First locally owned row of the group, and how many rows follow each other. Members of different
    /// groups must not couple.
    using Group = std::pair<LocalIndex, unsigned int>;

    /// @p groups: of this rank. @p solver gets what is left.
    CondensedSolver(std::unique_ptr<DirectSolver> solver, std::vector<Group> groups);

    void analyse(const SparseMatrix             &matrix,
                 const std::vector<GlobalIndex> &node_of_row,
                 GlobalIndex                     n_nodes) override;

    double predicted_megabytes() const override
    {
      return solver->predicted_megabytes();
    }
    double predicted_flops() const override
    {
      return solver->predicted_flops();
    }

    /// Negative pivots count those of the eliminated blocks too (Haynsworth's inertia additivity).
    /// The block of a group and its couplings are read from the group's rows, as if the matrix were
    /// symmetric there. Throws std::logic_error if groups couple.
    Factorisation factor(const SparseMatrix &matrix) override;

    void solve(Vector &solution, const Vector &rhs) override;

  private:
    /// A group of this rank: its couplings R with the retained unknowns and its block D.
    struct Block
    {
      LocalIndex               first = 0;
      unsigned int             n     = 0;
      std::vector<LocalIndex>  columns; ///< of R, reduced local indices
      std::vector<std::size_t> entries; ///< [row * columns.size() + k]: places of R in the matrix
      std::vector<double>      R, W;    ///< R and D^-1 R, as entries
      std::vector<double>      inverse; ///< D^-1, [row * n + column]
    };

    /// Columns of a block of another rank that adds to rows of this one, in its order.
    using Foreign = std::vector<LocalIndex>;

    using Partition = std::shared_ptr<const SparseMatrix::Partitioner>;

    /// Returns the partition of the reduced unknowns.
    Partition make_blocks(const SparseMatrix &matrix);
    void      make_pattern(const SparseMatrix &matrix, const Partition &partitioner);

    /// Fill R, W and D^-1. False if D is singular. Adds to the count of negative pivots.
    bool eliminate(const SparseMatrix &matrix, Block &block, std::size_t &negative_pivots) const;

    /// reduced(row, columns) -= values
    void subtract(LocalIndex row, const std::vector<LocalIndex> &columns, const double *values);
    void subtract_blocks();

    std::unique_ptr<DirectSolver> solver;
    std::vector<Group>            groups;

    /// Of each unknown of the whole matrix, ghosts behind: its reduced global index, -1 if it is
    /// eliminated.
    std::vector<long long>         reduced_index;
    std::vector<LocalIndex>        retained; ///< owned rows of the whole matrix that stay
    std::vector<Block>             blocks;
    static constexpr std::uint32_t eliminated_column = -1;
    std::vector<std::uint32_t>
        place; ///< of each entry of a retained row: offset in its reduced row

    SparseMatrix reduced;
    /// By rank: which blocks add to rows of theirs, and which of theirs add to rows of this one.
    std::map<unsigned int, std::vector<std::size_t>> sent;
    std::map<unsigned int, std::vector<Foreign>>     received;
    Vector                                           reduced_rhs, reduced_solution;
  };
} // namespace isochor
