#include <isochor/algebra/block_solver.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace isochor
{
  void NearlyDiagonal::solve(Vector &x, const Vector &b) const
  {
    // Chebyshev's iteration for D^-1 A x = D^-1 b from zero (Saad, Iterative Methods for Sparse
    // Linear Systems, algorithm 12.1).
    const double      centre = .5 * (largest + smallest), radius = .5 * (largest - smallest);
    const std::size_t n = matrix.n_rows();
    const auto        diagonal
        = [&](const std::size_t i) { return matrix.values()[matrix.position(i, i)]; };

    Vector step(b), product(b);
    x = 0.;
    for (std::size_t i = 0; i < n; ++i)
      step.local_element(i) = b.local_element(i) / (diagonal(i) * centre);
    double rho = radius / centre;
    for (unsigned int k = 1;; ++k)
      {
        x += step;
        if (k == n_steps)
          return;
        matrix.vmult(product, x);
        const double next = 1. / (2. * centre / radius - rho);
        for (std::size_t i = 0; i < n; ++i)
          step.local_element(i) = next * rho * step.local_element(i)
                                  + 2. * next / radius
                                        * (b.local_element(i) - product.local_element(i))
                                        / diagonal(i);
        rho = next;
      }
  }

  void BlockSolver::analyse(const SparseMatrix &matrix,
                            const std::vector<GlobalIndex> &,
                            const GlobalIndex)
  {
    product.reinit(matrix.partitioner());
    rest.reinit(matrix.partitioner());
    if (data.schur.matrix.partitioner())
      {
        schur_rhs.reinit(data.schur.matrix.partitioner());
        schur_solution.reinit(data.schur.matrix.partitioner());
      }
  }

  Factorisation BlockSolver::factor(const SparseMatrix &new_matrix)
  {
    matrix = &new_matrix;
    Factorisation result;
    bool          finite = true;
    for (const double value : data.stiffness.values())
      finite = finite && std::isfinite(value);
    if (dealii::Utilities::MPI::logical_or(!finite, matrix->partitioner()->get_mpi_communicator()))
      {
        result.failure = "the matrix has entries that are not finite";
        return result;
      }
    multigrid.build(data.stiffness, data.n_components, data.modes);
    result.succeeded = true;
    return result;
  }

  void BlockSolver::solve(Vector &solution, const Vector &rhs)
  {
    const LocalIndex n = data.stiffness.n_rows();
    solution.zero_out_ghost_values();
    if (schur_rhs.size() == 0)
      {
        multigrid.apply(solution.begin(), rhs.begin());
        return;
      }

    // The matrix is scaled, S is not.
    for (LocalIndex i = 0; i < schur_rhs.locally_owned_size(); ++i)
      schur_rhs.local_element(i) = -rhs.local_element(n + i) / data.scaling[n + i];
    data.schur.solve(schur_solution, schur_rhs);
    product = 0.;
    for (LocalIndex i = 0; i < schur_rhs.locally_owned_size(); ++i)
      product.local_element(n + i) = schur_solution.local_element(i) / data.scaling[n + i];
    matrix->vmult(rest, product);
    for (LocalIndex i = 0; i < n; ++i)
      rest.local_element(i) = rhs.local_element(i) - rest.local_element(i);
    multigrid.apply(solution.begin(), rest.begin());
    for (LocalIndex i = n; i < solution.locally_owned_size(); ++i)
      solution.local_element(i) = product.local_element(i);
  }
} // namespace isochor
