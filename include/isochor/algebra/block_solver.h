#pragma once

// A preconditioner for the saddle point of displacements and pressures that keeps no factors:
//   [ K  G^T ]     [ A  G^T ]
//   [ G  -C  ]  ~  [ 0  -S  ],   A^-1 a multigrid cycle,  S^-1 some steps on a mass matrix.
// Without pressures, the cycle alone.

#include <isochor/algebra/direct_solver.h>
#include <isochor/algebra/multigrid.h>

namespace isochor
{
  /// A symmetric positive definite matrix whose diagonal alone is close to it, solved by a fixed
  /// number of Chebyshev steps.
  struct NearlyDiagonal
  {
    SparseMatrix matrix;
    /// Bounds of the eigenvalues of D^-1 A, D the diagonal.
    double       smallest = 1., largest = 1.;
    unsigned int n_steps = 1;

    /// x = A^-1 b, about. Collective.
    void solve(Vector &x, const Vector &b) const;
  };

  /// What the block solver is told about the matrix it gets.
  struct BlockData
  {
    /// A, scaled as the matrix is: of each rank, the first owned rows, n_components at each node.
    /// Symmetric positive definite.
    SparseMatrix stiffness;
    unsigned int n_components = 0;
    /// Rigid motions, by owned rows of A.
    std::vector<std::vector<double>> modes;
    /// S by the owned pressures. Empty if there are none.
    NearlyDiagonal schur;
    /// S is that of the matrix before it was scaled by these, by owned row.
    std::vector<double> scaling;
  };

  class BlockSolver : public DirectSolver
  {
  public:
    /// @p data must outlive this; its what changes in it is read by factor().
    explicit BlockSolver(const BlockData &data)
      : data(data)
    {
    }

    void analyse(const SparseMatrix             &matrix,
                 const std::vector<GlobalIndex> &node_of_row,
                 GlobalIndex                     n_nodes) override;

    /// Sets up the multigrid; @p matrix must stay for solve().
    Factorisation factor(const SparseMatrix &matrix) override;

    void solve(Vector &solution, const Vector &rhs) override;

  private:
    const BlockData    &data;
    const SparseMatrix *matrix = nullptr;
    Multigrid           multigrid;
    Vector              schur_rhs, schur_solution, product, rest;
  };
} // namespace isochor
