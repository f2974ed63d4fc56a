#include <isochor/algebra/sparse_matrix.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>

namespace isochor
{
  void SparseMatrix::reinit(std::shared_ptr<const Partitioner> partitioner,
                            std::vector<std::size_t>           row_start,
                            std::vector<LocalIndex>            columns)
  {
    AssertDimension(row_start.size(), partitioner->locally_owned_size() + 1);
    AssertDimension(row_start.back(), columns.size());
    partitioner_ = std::move(partitioner);
    row_start_   = std::move(row_start);
    columns_     = std::move(columns);
    values_.assign(columns_.size(), 0.);
  }

  void SparseMatrix::vmult(Vector &dst, const Vector &src) const
  {
    AssertDimension(src.locally_owned_size(), n_rows());
    AssertDimension(dst.locally_owned_size(), n_rows());
    const bool had_ghosts = src.has_ghost_elements();
    src.update_ghost_values();
    dst.zero_out_ghost_values(); // they would be out of date

    const double     *in     = src.begin();
    double           *out    = dst.begin();
    const double     *value  = values_.data();
    const LocalIndex *column = columns_.data();
    for (std::size_t row = 0; row < n_rows(); ++row)
      {
        double sum = 0;
        for (std::size_t k = row_start_[row]; k < row_start_[row + 1]; ++k)
          sum += value[k] * in[column[k]];
        out[row] = sum;
      }
    if (!had_ghosts)
      src.zero_out_ghost_values();
  }

  std::size_t SparseMatrix::position(const LocalIndex row, const LocalIndex column) const
  {
    AssertIndexRange(row, n_rows());
    const auto begin = columns_.begin() + row_start_[row],
               end   = columns_.begin() + row_start_[row + 1];
    const auto found = std::lower_bound(begin, end, column);
    Assert(found != end && *found == column, dealii::ExcMessage("no such entry"));
    return found - columns_.begin();
  }
} // namespace isochor
