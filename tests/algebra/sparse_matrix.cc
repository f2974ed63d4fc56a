// The product of a distributed matrix against the product with the same matrix stored dense on
// every rank, and the state of the source's ghost values, which the product must leave alone.

#include "../common/report.h"
#include "saddle_matrix.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace isochor;
using namespace isochor::testing;

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const Saddle        saddle = make_saddle(4, {.compliance = .2, .skew = .3});
  const SparseMatrix &matrix = saddle.matrix;
  const auto          n      = matrix.partitioner()->size();
  out() << "rows " << n << ", entries "
        << dealii::Utilities::MPI::sum(matrix.values().size(), MPI_COMM_WORLD) << "\n";

  dealii::FullMatrix<double> dense(n, n);
  std::size_t                misplaced = 0;
  for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
    for (std::size_t k = matrix.row_start()[row]; k < matrix.row_start()[row + 1]; ++k)
      {
        const LocalIndex column = matrix.columns()[k];
        misplaced += matrix.position(row, column) != k;
        dense(matrix.partitioner()->local_to_global(row),
              matrix.partitioner()->local_to_global(column))
            = matrix.values()[k];
      }
  const Vector           source = make_vector(saddle, 1);
  dealii::Vector<double> x(n), y(n), y_dense(n);
  for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
    x(matrix.partitioner()->local_to_global(row)) = source.local_element(row);
  dealii::Utilities::MPI::sum(x, MPI_COMM_WORLD, x);
  dense.vmult(y_dense, x);
  dealii::Utilities::MPI::sum(y_dense, MPI_COMM_WORLD, y_dense); // each rank has its rows

  Vector product = saddle.vector();
  product.update_ghost_values(); // out of date after the product
  matrix.vmult(product, source);
  for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
    y(matrix.partitioner()->local_to_global(row)) = product.local_element(row);
  dealii::Utilities::MPI::sum(y, MPI_COMM_WORLD, y);
  y -= y_dense;
  out() << "positions found: " << yes(dealii::Utilities::MPI::sum(misplaced, MPI_COMM_WORLD) == 0)
        << "\nproduct against the dense one: " << below(y.l2_norm() / y_dense.l2_norm(), 1e-14)
        << "\nsource without ghost values stays so: " << yes(!source.has_ghost_elements())
        << "\nproduct has none: " << yes(!product.has_ghost_elements()) << "\n";

  source.update_ghost_values();
  matrix.vmult(product, source);
  out() << "source with ghost values keeps them: " << yes(source.has_ghost_elements()) << "\n";
}
