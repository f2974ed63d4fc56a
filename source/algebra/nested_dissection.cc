#include <isochor/algebra/nested_dissection.h>
#include <isochor/core/error.h>

#include <deal.II/base/mpi.h>

#include <metis.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  namespace
  {
    /// Rows by node, or neighbours by node, in compressed form.
    struct Lists
    {
      std::vector<std::size_t> start;
      std::vector<idx_t>       entry;
    };

    /// Lists of k for each node_of[k], k ascending.
    Lists grouped(const std::vector<idx_t> &node_of, const idx_t n_nodes)
    {
      Lists lists;
      lists.start.assign(n_nodes + 1, 0);
      for (const idx_t node : node_of)
        ++lists.start[node + 1];
      for (idx_t node = 0; node < n_nodes; ++node)
        lists.start[node + 1] += lists.start[node];
      lists.entry.resize(node_of.size());
      std::vector<std::size_t> next(lists.start.begin(), lists.start.end() - 1);
      for (std::size_t k = 0; k < node_of.size(); ++k)
        lists.entry[next[node_of[k]]++] = k;
      return lists;
    }

    /// What a rank knows of the graph of nodes, as it is sent to rank 0.
    struct Part
    {
      std::vector<idx_t> node_of_row;
      std::vector<idx_t> edges; ///< node, number of neighbours, neighbours; node, ...
      GlobalIndex        first_row = 0;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &node_of_row &edges &first_row;
      }
    };

    /// Where each of @p values stands in @p all, which ascend and hold it.
    std::vector<idx_t> places_in(const std::vector<idx_t> &all, const std::vector<idx_t> &values)
    {
      std::vector<idx_t> places;
      places.reserve(values.size());
      for (const idx_t value : values)
        places.push_back(std::lower_bound(all.begin(), all.end(), value) - all.begin());
      return places;
    }

    Part local_part(const SparseMatrix &matrix, const std::vector<GlobalIndex> &node_of_row)
    {
      // Nodes of the ghost unknowns come by the usual exchange; a double holds them exactly.
      Vector nodes(matrix.partitioner());
      for (std::size_t row = 0; row < node_of_row.size(); ++row)
        nodes.local_element(row) = node_of_row[row];
      nodes.update_ghost_values();
      std::vector<idx_t> node_of(matrix.n_rows() + matrix.partitioner()->n_ghost_indices());
      for (std::size_t k = 0; k < node_of.size(); ++k)
        node_of[k] = static_cast<idx_t>(nodes.local_element(k));

      Part part;
      part.first_row = matrix.partitioner()->local_range().first;
      part.node_of_row.assign(node_of.begin(), node_of.begin() + matrix.n_rows());

      // By their places among the nodes that this rank knows: nothing here grows with the whole mesh.
      std::vector<idx_t> known = node_of;
      std::sort(known.begin(), known.end());
      known.erase(std::unique(known.begin(), known.end()), known.end());
      node_of             = places_in(known, node_of);
      const idx_t n_known = known.size();
      const Lists rows    = grouped({node_of.begin(), node_of.begin() + matrix.n_rows()}, n_known);
      std::vector<idx_t> seen_by(n_known, -1);
      for (idx_t node = 0; node < n_known; ++node)
        {
          if (rows.start[node] == rows.start[node + 1])
            continue;
          seen_by[node] = node; // no edge to itself
          part.edges.push_back(known[node]);
          part.edges.push_back(0);
          const std::size_t count = part.edges.size() - 1;
          for (std::size_t k = rows.start[node]; k < rows.start[node + 1]; ++k)
            for (std::size_t l = matrix.row_start()[rows.entry[k]];
                 l < matrix.row_start()[rows.entry[k] + 1];
                 ++l)
              {
                const idx_t other = node_of[matrix.columns()[l]];
                if (seen_by[other] != node)
                  {
                    seen_by[other] = node;
                    part.edges.push_back(known[other]);
                  }
              }
          part.edges[count] = part.edges.size() - count - 1;
        }
      return part;
    }

    /// Order of the nodes: element k is the node eliminated as the k-th.
    std::vector<idx_t>
    dissect(const std::vector<Part> &parts, const Lists &rows, const idx_t n_nodes)
    {
      std::vector<const idx_t *> record(n_nodes, nullptr);
      std::vector<idx_t>         xadj(n_nodes + 1, 0), adjacency;
      std::size_t                n_edges = 0;
      for (const Part &part : parts)
        for (std::size_t k = 0; k < part.edges.size(); k += 2 + part.edges[k + 1])
          {
            if (record[part.edges[k]])
              throw std::logic_error("the rows of a node are on several ranks");
            record[part.edges[k]] = &part.edges[k];
            n_edges += part.edges[k + 1];
          }
      if (n_edges > std::size_t(std::numeric_limits<idx_t>::max()))
        throw std::runtime_error("the mesh is too large for METIS' 32-bit indices");
      adjacency.reserve(n_edges + 1);
      for (idx_t node = 0; node < n_nodes; ++node)
        {
          if (record[node])
            adjacency.insert(adjacency.end(), record[node] + 2, record[node] + 2 + record[node][1]);
          xadj[node + 1] = adjacency.size();
        }

      std::vector<idx_t> order(n_nodes), place(n_nodes), weight(n_nodes);
      for (idx_t node = 0; node < n_nodes; ++node)
        {
          order[node]  = node;
          weight[node] = std::max<idx_t>(1, rows.start[node + 1] - rows.start[node]);
        }
      if (n_edges == 0) // METIS 5.1 does not stand it
        return order;
      idx_t n = n_nodes, options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_SEED] = 1; // the same run twice gives the same figures
      if (METIS_NodeND(
              &n, xadj.data(), adjacency.data(), weight.data(), options, order.data(), place.data())
          != METIS_OK)
        throw std::runtime_error("METIS_NodeND failed to order the unknowns");
      return order;
    }
  } // namespace

  std::vector<int> nested_dissection(const SparseMatrix             &matrix,
                                     const std::vector<GlobalIndex> &node_of_row,
                                     const GlobalIndex               n_nodes)
  {
    const MPI_Comm    communicator = matrix.partitioner()->get_mpi_communicator();
    const GlobalIndex n            = matrix.partitioner()->size();
    if (std::max(n, n_nodes) > GlobalIndex(std::numeric_limits<idx_t>::max()))
      throw std::runtime_error("too many unknowns for METIS' 32-bit indices");

    Part                    mine  = local_part(matrix, node_of_row);
    const std::vector<Part> parts = dealii::Utilities::MPI::n_mpi_processes(communicator) == 1
                                        ? std::vector<Part>{std::move(mine)}
                                        : dealii::Utilities::MPI::gather(communicator, mine, 0);

    std::vector<int> place;
    on_root_collectively(communicator, [&]() {
      std::vector<idx_t> node_of(n);
      for (const Part &part : parts)
        std::copy(
            part.node_of_row.begin(), part.node_of_row.end(), node_of.begin() + part.first_row);
      const Lists rows = grouped(node_of, n_nodes);
      place.resize(n);
      int next = 0;
      for (const idx_t node : dissect(parts, rows, n_nodes))
        for (std::size_t k = rows.start[node]; k < rows.start[node + 1]; ++k)
          place[rows.entry[k]] = next++;
    });
    return place;
  }
} // namespace isochor
