#pragma once

#include <isochor/algebra/direct_solver.h>

#include <cstdint>

namespace isochor
{
  /// UMFPACK's LU of the matrix itself, symmetric or not, on one rank. The matrix is scaled from
  /// both sides first, so that the pivots' ratio says whether it is singular.
  class Umfpack : public DirectSolver
  {
  public:
    /// Throws UserError on more than one rank.
    explicit Umfpack(MPI_Comm communicator);
    ~Umfpack() override;
    Umfpack(const Umfpack &)            = delete;
    Umfpack &operator=(const Umfpack &) = delete;

    /// UMFPACK orders for itself; the nodes are not looked at. Throws std::runtime_error if it
    /// refuses the pattern.
    void analyse(const SparseMatrix             &matrix,
                 const std::vector<GlobalIndex> &node_of_row,
                 GlobalIndex                     n_nodes) override;

    Factorisation factor(const SparseMatrix &matrix) override;

    void solve(Vector &solution, const Vector &rhs) override;

  private:
    void set_values(const SparseMatrix &matrix);
    void free_numeric();

    std::vector<double>       control;
    std::vector<std::int64_t> row_start, columns;
    std::vector<double>       values, scaling, scaled_rhs, scaled_solution;
    void                     *symbolic = nullptr, *numeric = nullptr;
  };
} // namespace isochor
