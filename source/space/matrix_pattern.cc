#include <isochor/space/matrix_pattern.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /// Which (cell, local node) pairs meet at each owned unknown that heads a node, in
    /// compressed form.
    struct NodeCells
    {
      std::vector<std::size_t>   start; ///< by local unknown
      std::vector<std::uint32_t> entry; ///< cell * n_local + local node
    };

    NodeCells cells_around(const std::vector<LocalIndex> &heads, const LocalIndex n_owned)
    {
      NodeCells around;
      around.start.assign(n_owned + 1, 0);
      for (const LocalIndex head : heads)
        if (head < n_owned)
          ++around.start[head + 1];
      for (LocalIndex i = 0; i < n_owned; ++i)
        around.start[i + 1] += around.start[i];
      around.entry.resize(around.start.back());
      std::vector<std::size_t> next = around.start;
      for (std::size_t k = 0; k < heads.size(); ++k)
        if (heads[k] < n_owned)
          around.entry[next[heads[k]]++] = k;
      return around;
    }
  } // namespace

  template <int dim>
  CellOffsets make_pattern(const Discretisation<dim> &discretisation, SparseMatrix &matrix)
  {
    const CellTables<dim> &cells   = discretisation.cells;
    const unsigned int     n_local = cells.n_x + cells.n_p;
    const LocalIndex       n_owned = cells.n_owned_unknowns;

    // First unknown of every local node of every cell.
    std::vector<LocalIndex> heads(std::size_t(cells.n_cells) * n_local);
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      {
        std::copy_n(&cells.x[cell * cells.n_x], cells.n_x, &heads[cell * n_local]);
        if (cells.n_p > 0)
          std::copy_n(&cells.p[cell * cells.n_p], cells.n_p, &heads[cell * n_local + cells.n_x]);
      }
    const auto width = [&](const unsigned int local) { return local < cells.n_x ? dim : 1; };

    CellOffsets offsets;
    offsets.n_local = n_local;
    offsets.offset.resize(std::size_t(cells.n_cells) * n_local * n_local);

    const NodeCells            around = cells_around(heads, n_owned);
    std::vector<std::size_t>   row_start(n_owned + 1, 0);
    std::vector<LocalIndex>    columns, of_row;
    std::vector<std::uint32_t> position(discretisation.partitioner->locally_owned_size()
                                        + discretisation.partitioner->n_ghost_indices());
    constexpr std::uint32_t    absent = -1;
    std::fill(position.begin(), position.end(), absent);

    for (LocalIndex head = 0; head < n_owned;)
      {
        // All rows of a node have the same columns.
        of_row.clear();
        const auto first = around.start[head], last = around.start[head + 1];
        if (first == last)
          throw std::logic_error("an unknown that no cell touches");
        for (std::size_t k = first; k < last; ++k)
          {
            const std::size_t cell = around.entry[k] / n_local;
            for (unsigned int s = 0; s < n_local; ++s)
              {
                const LocalIndex other = heads[cell * n_local + s];
                if (position[other] == absent)
                  {
                    position[other] = 0;
                    for (int c = 0; c < width(s); ++c)
                      of_row.push_back(other + c);
                  }
              }
          }
        std::sort(of_row.begin(), of_row.end());
        for (std::uint32_t k = 0; k < of_row.size(); ++k)
          position[of_row[k]] = k;
        for (std::size_t k = first; k < last; ++k)
          {
            const std::size_t cell = around.entry[k] / n_local;
            for (unsigned int s = 0; s < n_local; ++s)
              offsets.offset[around.entry[k] * std::size_t(n_local) + s]
                  = position[heads[cell * n_local + s]];
          }
        for (const LocalIndex column : of_row)
          position[column] = absent;

        const int n_rows = width(around.entry[first] % n_local);
        for (int c = 0; c < n_rows; ++c)
          {
            row_start[head + c + 1] = row_start[head + c] + of_row.size();
            columns.insert(columns.end(), of_row.begin(), of_row.end());
          }
        head += n_rows;
      }

    matrix.reinit(discretisation.partitioner, std::move(row_start), std::move(columns));
    return offsets;
  }

  template CellOffsets make_pattern(const Discretisation<2> &, SparseMatrix &);
  template CellOffsets make_pattern(const Discretisation<3> &, SparseMatrix &);
} // namespace isochor
