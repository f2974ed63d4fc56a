#pragma once

#include <isochor/algebra/direct_solver.h>

#include <dmumps_c.h>

namespace isochor
{
  /// MUMPS' LDL^T of the symmetric part (A + A^T) / 2, with METIS' order of the nodes, on any
  /// number of ranks. The pattern must be symmetric. Counts negative pivots exactly.
  class Mumps : public DirectSolver
  {
  public:
    explicit Mumps(MPI_Comm communicator);
    ~Mumps() override;
    Mumps(const Mumps &)            = delete;
    Mumps &operator=(const Mumps &) = delete;

    /// Throws std::runtime_error if MUMPS or METIS refuses the pattern.
    void analyse(const SparseMatrix             &matrix,
                 const std::vector<GlobalIndex> &node_of_row,
                 GlobalIndex                     n_nodes) override;

    /// A singular matrix does not succeed; null_pivots says how far it is from having full rank.
    Factorisation factor(const SparseMatrix &matrix) override;

    void solve(Vector &solution, const Vector &rhs) override;

  private:
    /// Lower triangle by global indices counted from 1, and where its values come from.
    void set_structure(const SparseMatrix &matrix);
    void set_values(const SparseMatrix &matrix);
    void call(int job);

    MPI_Comm       communicator;
    DMUMPS_STRUC_C mumps{};
    bool           factored = false;

    std::vector<int> rows, columns, place;
    /// Both positions in the matrix of an entry whose two rows are on this rank; the entries that
    /// couple to another rank follow, one position each.
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::vector<std::size_t>                         halves;
    std::vector<double>                              values;

    std::vector<double> dense;           ///< right-hand side, then solution, on rank 0
    std::vector<int>    counts, offsets; ///< of each rank's rows in it
  };
} // namespace isochor
