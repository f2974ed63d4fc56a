#pragma once

#include <isochor/algebra/direct_solver.h>

#include <dmumps_c.h>
#include <smumps_c.h>

#include <type_traits>

namespace isochor
{
  /// MUMPS' LDL^T of the symmetric part (A + A^T) / 2, with METIS' order of the nodes, on any
  /// number of ranks. The pattern must be symmetric. Counts negative pivots, in double precision
  /// exactly. No rank holds the matrix, the factors or a vector as a whole; the analysis gathers the
  /// pattern on one.
  ///
  /// @tparam number float or double. In single precision a pivot that rounding may have made is
  /// counted as a null pivot, and the matrix called singular.
  template <typename number>
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

    double predicted_megabytes() const override;
    double predicted_flops() const override;

    /// A singular matrix does not succeed; null_pivots says how far it is from having full rank.
    Factorisation factor(const SparseMatrix &matrix) override;

    void solve(Vector &solution, const Vector &rhs) override;

  private:
    using Struct
        = std::conditional_t<std::is_same_v<number, double>, DMUMPS_STRUC_C, SMUMPS_STRUC_C>;

    /// Lower triangle by global indices counted from 1, and where its values come from.
    void set_structure(const SparseMatrix &matrix);
    void set_values(const SparseMatrix &matrix);
    /// Where the parts of the solution go: fill `scattered` and `places`.
    void locate_solution();
    void call(int job);

    MPI_Comm communicator;
    Struct   mumps{};
    bool     factored = false;

    std::vector<int> rows, columns, place;
    /// Both positions in the matrix of an entry whose two rows are on this rank; the entries that
    /// couple to another rank follow, one position each.
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    std::vector<std::size_t>                         halves;
    std::vector<number>                              values;

    /// Right-hand sides go in by owned rows; solutions come out where their pivots were
    /// eliminated, which is known after the first solve with new factors.
    std::shared_ptr<const SparseMatrix::Partitioner> partitioner;
    std::vector<int>                                 owned_rows, solution_rows; ///< from 1
    std::vector<number>                              rhs_part, solution_part;
    Vector                                           scattered; ///< ghosts: solution_rows of others
    std::vector<LocalIndex>                          places;    ///< of solution_rows in it
  };
} // namespace isochor
