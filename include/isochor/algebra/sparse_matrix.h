#pragma once

// Compressed rows of the locally owned unknowns; columns are local indices (ghosts behind the
// owned ones), so that cell kernels write by plain offsets and the product needs one ghost
// update. Trilinos' and deal.II's matrices hide their value array behind a search per entry.

#include <isochor/core/types.h>

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace isochor
{
  class SparseMatrix
  {
  public:
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    /// @p row_start has locally_owned_size + 1 entries; @p columns sorted within each row.
    void reinit(std::shared_ptr<const Partitioner> partitioner,
                std::vector<std::size_t>           row_start,
                std::vector<LocalIndex>            columns);

    /// dst = A src. Updates the ghost values of @p src. Collective.
    void vmult(Vector &dst, const Vector &src) const;

    /// Position of entry (row, column) in values(); the entry must exist.
    std::size_t position(LocalIndex row, LocalIndex column) const;

    std::size_t n_rows() const
    {
      return row_start_.size() - 1;
    }
    const std::vector<std::size_t> &row_start() const
    {
      return row_start_;
    }
    const std::vector<LocalIndex> &columns() const
    {
      return columns_;
    }
    std::vector<double> &values()
    {
      return values_;
    }
    const std::vector<double> &values() const
    {
      return values_;
    }
    const std::shared_ptr<const Partitioner> &partitioner() const
    {
      return partitioner_;
    }

  private:
    std::shared_ptr<const Partitioner> partitioner_;
    std::vector<std::size_t>           row_start_;
    std::vector<LocalIndex>            columns_;
    std::vector<double>                values_;
  };
} // namespace isochor
