#pragma once

// Saddle point matrices like those of a mixed element, whatever the number of ranks: nodes on an
// n^3 grid, each with three displacement-like and one pressure-like unknown. Numbered as a
// Discretisation does: displacements, then pressures, of each rank in turn.

#include <isochor/algebra/sparse_matrix.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <cmath>
#include <map>

namespace isochor::testing
{
  struct Saddle
  {
    SparseMatrix             matrix;
    std::vector<GlobalIndex> node_of_row; ///< of the owned rows
    std::vector<int>         component;   ///< 0, 1, 2, or 3 for the pressure
    GlobalIndex              n_nodes = 0;

    Vector vector() const
    {
      return Vector(matrix.partitioner());
    }
  };

  /// A number in [-1, 1) that depends on its arguments alone.
  inline double noise(const GlobalIndex a, const GlobalIndex b, const unsigned int c)
  {
    std::uint64_t x = a * 1000003ull + b * 7919ull + c * 104729ull + 12345ull;
    for (int k = 0; k < 3; ++k)
      {
        x ^= x >> 31;
        x *= 0x9e3779b97f4a7c15ull;
      }
    return double(x >> 11) / double(1ull << 52) - 1.;
  }

  struct Options
  {
    double compliance = 0.;   ///< of the (2,2) block, which is minus this times a mass matrix
    double skew       = 0.;   ///< of an unsymmetric perturbation of the (1,1) block
    bool   supported  = true; ///< false: no block sees the three constant displacements
    double stiffness  = 1.;   ///< of the (1,1) block
  };

  /// (1,1): each pair of neighbours is tied by a spring of random positive definite 3 x 3
  /// stiffness, and each node weakly to the ground: positive definite. (2,1): the entry of the
  /// own node dominates: full rank. (2,2): minus the compliance on the diagonal, less beside it:
  /// negative definite or zero. Hence, by Sylvester's law, one negative eigenvalue per node.
  inline Saddle make_saddle(const unsigned int n, const Options &options)
  {
    const MPI_Comm     communicator = MPI_COMM_WORLD;
    const unsigned int n_ranks      = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
    const GlobalIndex  n_nodes      = GlobalIndex(n) * n * n;

    const auto first_node = [&](const unsigned int r) { return n_nodes * r / n_ranks; };
    const auto global     = [&](const GlobalIndex node, const int component) {
      unsigned int owner = 0;
      while (first_node(owner + 1) <= node)
        ++owner;
      const GlobalIndex begin = first_node(owner), count = first_node(owner + 1) - begin;
      return 4 * begin
             + (component < 3 ? 3 * (node - begin) + component : 3 * count + node - begin);
    };
    const auto neighbours = [&](const GlobalIndex node) {
      std::vector<GlobalIndex> result;
      const int                x = node % n, y = node / n % n, z = node / n / n, N = n;
      for (int k = std::max(0, z - 1); k < std::min(N, z + 2); ++k)
        for (int j = std::max(0, y - 1); j < std::min(N, y + 2); ++j)
          for (int i = std::max(0, x - 1); i < std::min(N, x + 2); ++i)
            result.push_back(i + GlobalIndex(n) * (j + GlobalIndex(n) * k));
      return result;
    };

    const GlobalIndex begin = first_node(rank), end = first_node(rank + 1);
    dealii::IndexSet  owned(4 * n_nodes), ghosts(4 * n_nodes);
    owned.add_range(4 * begin, 4 * end);
    for (GlobalIndex node = begin; node < end; ++node)
      for (const GlobalIndex other : neighbours(node))
        if (other < begin || other >= end)
          for (int c = 0; c < 4; ++c)
            ghosts.add_index(global(other, c));
    const auto partitioner
        = std::make_shared<const SparseMatrix::Partitioner>(owned, ghosts, communicator);

    Saddle saddle;
    saddle.n_nodes = n_nodes;
    saddle.node_of_row.resize(4 * (end - begin));
    saddle.component.resize(4 * (end - begin));
    for (GlobalIndex node = begin; node < end; ++node)
      for (int c = 0; c < 4; ++c)
        {
          saddle.node_of_row[global(node, c) - 4 * begin] = node;
          saddle.component[global(node, c) - 4 * begin]   = c;
        }

    const auto spring = [&](GlobalIndex a, GlobalIndex b, const int c, const int d) {
      if (a > b)
        std::swap(a, b);
      return (c == d ? 1. : .3 * noise(a, b, 10 + std::min(c, d) + std::max(c, d)))
             * (1. + .5 * noise(a, b, 1));
    };
    const auto entry = [&](const GlobalIndex a, const int c, const GlobalIndex b, const int d) {
      if (c == 3 && d == 3)
        return -options.compliance * (a == b ? 1. : .1 / 27.);
      if (c == 3 || d == 3)
        {
          const GlobalIndex p = c == 3 ? a : b, u = c == 3 ? b : a;
          const int         k = c == 3 ? d : c;
          const auto weak = [&](const GlobalIndex other) { return .05 * noise(p, other, 20 + k); };
          if (a != b)
            return weak(u);
          double own = 1. + .2 * k;
          if (!options.supported)
            {
              own = 0;
              for (const GlobalIndex other : neighbours(p))
                if (other != p)
                  own -= weak(other);
            }
          return own;
        }
      double value = 0;
      if (a != b)
        value = -spring(a, b, c, d) + options.skew * noise(a, b, 30 + 3 * c + d);
      else
        {
          for (const GlobalIndex other : neighbours(a))
            if (other != a)
              value += spring(a, other, c, d);
          if (options.supported && c == d)
            value += .1;
        }
      return options.stiffness * value;
    };

    std::vector<std::size_t> row_start{0};
    std::vector<LocalIndex>  columns;
    std::vector<double>      values;
    for (std::size_t row = 0; row < saddle.node_of_row.size(); ++row)
      {
        std::map<LocalIndex, double> entries;
        for (const GlobalIndex other : neighbours(saddle.node_of_row[row]))
          for (int d = 0; d < 4; ++d)
            entries[partitioner->global_to_local(global(other, d))]
                = entry(saddle.node_of_row[row], saddle.component[row], other, d);
        for (const auto &[column, value] : entries)
          {
            columns.push_back(column);
            values.push_back(value);
          }
        row_start.push_back(columns.size());
      }
    saddle.matrix.reinit(partitioner, std::move(row_start), std::move(columns));
    saddle.matrix.values() = values;
    return saddle;
  }

  /// A vector whose entries depend on node and component, not on the numbering.
  inline Vector make_vector(const Saddle &saddle, const unsigned int seed)
  {
    Vector v = saddle.vector();
    for (std::size_t row = 0; row < saddle.node_of_row.size(); ++row)
      v.local_element(row) = noise(saddle.node_of_row[row], saddle.component[row], seed);
    return v;
  }

  inline double difference(const Vector &a, const Vector &b)
  {
    Vector d(a);
    d -= b;
    return d.l2_norm() / b.l2_norm();
  }
} // namespace isochor::testing
