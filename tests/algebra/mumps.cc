// MUMPS' LDL^T. The negative pivots of a saddle point matrix [A B^T; B -C], A and C positive
// (semi)definite, B of full rank, are as many as the rows of B; here also as many as the
// negative eigenvalues that LAPACK computes of the dense matrix. An indefinite A adds its own.
// On two ranks the same figures as on one.

#include "solver_cases.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  /// Pivots against eigenvalues; @p shift is taken off the first displacement of the first node.
  void inertia(DirectSolver &solver, const double shift)
  {
    Saddle        saddle = make_saddle(3, {.compliance = .5});
    SparseMatrix &matrix = saddle.matrix;
    for (std::size_t row = 0; row < matrix.n_rows(); ++row)
      if (saddle.component[row] < 3)
        matrix.values()[matrix.position(row, row)] -= shift * (saddle.node_of_row[row] % 3);

    const auto                 n = matrix.partitioner()->size();
    dealii::FullMatrix<double> sum(n, n);
    for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
      for (std::size_t k = matrix.row_start()[row]; k < matrix.row_start()[row + 1]; ++k)
        sum(matrix.partitioner()->local_to_global(row),
            matrix.partitioner()->local_to_global(matrix.columns()[k]))
            = matrix.values()[k];
    dealii::FullMatrix<double> all(n, n);
    dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD, all);
    dealii::LAPACKFullMatrix<double> dense(n, n);
    dense = all;
    dense.compute_eigenvalues();
    unsigned int negative = 0;
    for (unsigned int k = 0; k < n; ++k)
      negative += dense.eigenvalue(k).real() < 0;

    solver.analyse(matrix, saddle.node_of_row, saddle.n_nodes);
    out() << "shift " << shift << ": negative eigenvalues " << negative << ", negative pivots "
          << solver.factor(matrix).negative_pivots.value() << "\n";
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto solver = make_direct_solver(DirectKind::mumps, MPI_COMM_WORLD);
  all_cases(*solver);
  for (const double shift : {0., 2., 10.})
    inertia(*solver, shift);
}
