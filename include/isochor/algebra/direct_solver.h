#pragma once

// Sparse direct solvers: MUMPS (symmetric LDL^T in double or single precision, any number of ranks,
// counts negative pivots) and UMFPACK (LU, one rank).

#include <isochor/algebra/sparse_matrix.h>

#include <optional>
#include <string>

namespace isochor
{
  enum class DirectKind
  {
    mumps,        ///< LDL^T of the symmetric part
    single_mumps, ///< the same in single precision: half the memory, a preconditioner
    umfpack       ///< LU
  };

  struct Factorisation
  {
    bool        succeeded = false;
    std::string failure; ///< why not, in words; empty if it succeeded
    /// Negative pivots of LDL^T; not known for LU.
    std::optional<std::size_t> negative_pivots;
    std::size_t                null_pivots = 0;
    double                     flops       = 0; ///< of the elimination
    double                     megabytes   = 0; ///< of the factors' workspace, all ranks
  };

  class DirectSolver
  {
  public:
    virtual ~DirectSolver() = default;

    /// Symbolic analysis of the pattern of @p matrix, once per mesh. @p node_of_row gives for each
    /// locally owned row the global number of the node it lives on: rows of one node stay
    /// together in the elimination order, in ascending order of rows. Node numbers run from 0
    /// to n_nodes - 1 over all ranks. Collective.
    virtual void analyse(const SparseMatrix             &matrix,
                         const std::vector<GlobalIndex> &node_of_row,
                         GlobalIndex                     n_nodes)
        = 0;

    /// What analyse() says that factor() will need, all ranks together; 0: not known.
    virtual double predicted_megabytes() const
    {
      return 0.;
    }

    /// The same of its operations; 0: not known.
    virtual double predicted_flops() const
    {
      return 0.;
    }

    /// Numeric factorisation; analyse() must have seen the same pattern. Collective.
    virtual Factorisation factor(const SparseMatrix &matrix) = 0;

    /// solution = (factors)^-1 rhs. Collective.
    virtual void solve(Vector &solution, const Vector &rhs) = 0;
  };

  std::unique_ptr<DirectSolver> make_direct_solver(DirectKind kind, MPI_Comm communicator);

  /// Outcome of a solve whose residual was checked.
  struct LinearSolve
  {
    bool         succeeded         = false;
    double       relative_residual = 0; ///< |b - A x| / |b|, of the true matrix
    unsigned int krylov_iterations = 0; ///< 0: the factors alone were good enough
  };

  /// Solve matrix x = b with the factors; where the true residual is above @p tolerance (an
  /// unsymmetric matrix, delayed pivots), go on with FGMRES preconditioned by the factors, at most
  /// @p max_iterations; if @p is_impatient, only as long as its pace is good enough for these.
  /// Collective.
  LinearSolve checked_solve(const SparseMatrix &matrix,
                            DirectSolver       &factors,
                            Vector             &x,
                            const Vector       &b,
                            double              tolerance,
                            unsigned int        max_iterations,
                            bool                is_impatient = false);
} // namespace isochor
