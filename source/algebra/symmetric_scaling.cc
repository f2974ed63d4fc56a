#include <isochor/algebra/symmetric_scaling.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  void SymmetricScaling::compute(const SparseMatrix &matrix,
                                 const LocalIndex    n_definite,
                                 const unsigned int  n_together)
  {
    const auto &values    = matrix.values();
    const auto &columns   = matrix.columns();
    const auto &row_start = matrix.row_start();
    // Written so that zeros and NaN leave 1.
    const auto inverse
        = [](const double size) { return size > 0. && std::isfinite(size) ? 1. / size : 1.; };

    factors.reinit(matrix.partitioner());
    for (LocalIndex first = 0; first < n_definite; first += n_together)
      {
        double sum = 0;
        for (LocalIndex row = first; row < first + n_together; ++row)
          sum += std::abs(values[matrix.position(row, row)]);
        for (LocalIndex row = first; row < first + n_together; ++row)
          factors.local_element(row) = inverse(std::sqrt(sum / n_together));
      }
    // Zero for the rows whose factor is still unknown, on the other ranks too.
    factors.update_ghost_values();
    std::vector<double> largest(matrix.n_rows() - n_definite, 0.);
    for (LocalIndex row = n_definite; row < matrix.n_rows(); ++row)
      for (std::size_t k = row_start[row]; k < row_start[row + 1]; ++k)
        largest[row - n_definite] = std::max(
            largest[row - n_definite], std::abs(values[k]) * factors.local_element(columns[k]));
    factors.zero_out_ghost_values();
    // What rounding has left of a coupling, as where all displacements around are held, is none; the
    // diagonal takes its place.
    constexpr double rounding = 1e-11;
    const double     any      = dealii::Utilities::MPI::max(
        largest.empty() ? 0. : *std::max_element(largest.begin(), largest.end()),
        matrix.partitioner()->get_mpi_communicator());
    for (LocalIndex row = n_definite; row < matrix.n_rows(); ++row)
      {
        double size = largest[row - n_definite];
        if (size <= rounding * any)
          size = std::sqrt(std::abs(values[matrix.position(row, row)]));
        factors.local_element(row) = inverse(size > rounding * any ? size : any);
      }
    factors.update_ghost_values();
  }

  void SymmetricScaling::apply(SparseMatrix &matrix) const
  {
    auto       &values    = matrix.values();
    const auto &columns   = matrix.columns();
    const auto &row_start = matrix.row_start();
    for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
      {
        const double factor = factors.local_element(row);
        for (std::size_t k = row_start[row]; k < row_start[row + 1]; ++k)
          values[k] *= factor * factors.local_element(columns[k]);
      }
  }

  void SymmetricScaling::apply(Vector &vector) const
  {
    vector.zero_out_ghost_values();
    for (LocalIndex row = 0; row < vector.locally_owned_size(); ++row)
      vector.local_element(row) *= factors.local_element(row);
  }
} // namespace isochor
