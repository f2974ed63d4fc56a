#include <isochor/space/prescribed_displacements.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    template <int dim>
    std::string text(const dealii::Point<dim> &point)
    {
      std::ostringstream out;
      for (unsigned int d = 0; d < dim; ++d)
        out << (d == 0 ? "(" : ", ") << point[d];
      out << ")";
      return out.str();
    }

    constexpr const char *component_names[] = {"x", "y", "z"};
  } // namespace

  template <int dim>
  PrescribedDisplacements<dim>::PrescribedDisplacements(const Discretisation<dim> &discretisation,
                                                        const std::vector<Support<dim>> &supports,
                                                        const BoundaryId &boundary_id)
    : supports(supports)
    , communicator(discretisation.communicator())
  {
    collectively(communicator, [&]() { collect(discretisation, boundary_id); });
    check_rigid_modes(communicator);

    // A ghost unknown may be prescribed by a face that this rank does not see.
    Vector flags = discretisation.make_vector();
    for (const LocalIndex unknown : owned)
      flags.local_element(unknown) = 1.;
    flags.update_ghost_values();
    is_prescribed_.resize(discretisation.partitioner->locally_owned_size()
                          + discretisation.partitioner->n_ghost_indices());
    for (std::size_t i = 0; i < is_prescribed_.size(); ++i)
      is_prescribed_[i] = flags.local_element(i) != 0.;
  }

  template <int dim>
  void PrescribedDisplacements<dim>::collect(const Discretisation<dim> &discretisation,
                                             const BoundaryId          &boundary_id)
  {
    std::vector<dealii::types::boundary_id> ids;
    for (const auto &support : supports)
      ids.push_back(boundary_id(support.boundary, support.origin));

    const CellTables<dim> &cells = discretisation.cells;
    for (const BoundaryFace &face : discretisation.boundary_faces)
      for (unsigned int s = 0; s < supports.size(); ++s)
        if (ids[s] == face.id)
          for (const unsigned int a : discretisation.x_shape.nodes_on_face(face.face))
            for (unsigned int c = 0; c < dim; ++c)
              if (supports[s].components[c])
                {
                  const LocalIndex unknown = cells.x[face.cell * cells.n_x + a] + c;
                  if (unknown < cells.n_owned_unknowns)
                    entries.push_back(
                        {unknown, c, s, cells.position(face.cell, discretisation.x_shape.node(a))});
                }

    std::stable_sort(entries.begin(), entries.end(), [](const Entry &a, const Entry &b) {
      return a.unknown < b.unknown;
    });

    // Two supports may meet at an edge of the body, if they agree: up to the digits that formulas
    // lose, and up to the rounding of a zero where a formula ends in a difference of positions.
    double extent = 0;
    for (const auto &point : cells.geometry)
      extent = std::max(extent, point.distance(cells.geometry.front()));
    std::vector<Entry> unique;
    for (const Entry &entry : entries)
      if (unique.empty() || unique.back().unknown != entry.unknown)
        unique.push_back(entry);
      else
        for (const double load : {0., 0.37, 1.})
          {
            const Entry &first = unique.back();
            const double ours
                = supports[entry.support].displacement(entry.position, load)[entry.component];
            const double theirs
                = supports[first.support].displacement(first.position, load)[first.component];
            if (std::abs(ours - theirs)
                > 1e-9 * (std::abs(ours) + std::abs(theirs)) + 1e-13 * extent)
              {
                std::ostringstream message;
                message << "contradicting supports: at " << text(entry.position) << " m, "
                        << supports[first.support].origin << " asks for a displacement of "
                        << theirs << " m in " << component_names[entry.component] << ", "
                        << supports[entry.support].origin << " for " << ours << " m (load factor "
                        << load
                        << "); leave the component free in one of them ('-') or make them agree";
                throw UserError(message.str());
              }
          }
    entries = std::move(unique);
    for (const Entry &entry : entries)
      owned.push_back(entry.unknown);
  }

  template <int dim>
  void PrescribedDisplacements<dim>::check_rigid_modes(MPI_Comm communicator) const
  {
    // Each prescribed component at X sees the rigid motion (t, w) as row . (t, w), with X taken
    // from the centre and scaled by the extent, so that rotations and translations compare.
    constexpr unsigned int n_modes = dim == 2 ? 3 : 6;
    dealii::Point<dim>     centre;
    const auto n_total = dealii::Utilities::MPI::sum(GlobalIndex(entries.size()), communicator);
    for (const Entry &entry : entries)
      centre += entry.position;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = dealii::Utilities::MPI::sum(centre[d], communicator)
                  / std::max<double>(1., double(n_total));
    double extent = 0;
    for (const Entry &entry : entries)
      extent = std::max(extent, entry.position.distance(centre));
    extent = std::max(dealii::Utilities::MPI::max(extent, communicator), 1e-300);

    dealii::FullMatrix<double> gram(n_modes, n_modes);
    for (const Entry &entry : entries)
      {
        double row[n_modes]  = {};
        row[entry.component] = 1.;
        const auto         r = (entry.position - centre) / extent;
        const unsigned int c = entry.component;
        if constexpr (dim == 2)
          row[2] = c == 0 ? -r[1] : r[0];
        else
          {
            // (w x r)_c
            row[3 + (c + 1) % 3] = r[(c + 2) % 3];
            row[3 + (c + 2) % 3] = -r[(c + 1) % 3];
          }
        for (unsigned int i = 0; i < n_modes; ++i)
          for (unsigned int j = 0; j < n_modes; ++j)
            gram(i, j) += row[i] * row[j];
      }
    for (unsigned int i = 0; i < n_modes; ++i)
      for (unsigned int j = 0; j < n_modes; ++j)
        gram(i, j) = dealii::Utilities::MPI::sum(gram(i, j), communicator)
                     / std::max<double>(1., double(n_total));

    unsigned int n_free = n_modes;
    if (n_total > 0)
      {
        dealii::LAPACKFullMatrix<double> eigen(n_modes);
        dealii::Vector<double>           values;
        dealii::FullMatrix<double>       vectors;
        eigen = gram;
        eigen.compute_eigenvalues_symmetric(-1., 1e-12, 1e-14, values, vectors);
        n_free = values.size();
      }
    if (n_free > 0)
      throw UserError("Scene: the supports leave " + std::to_string(n_free) + " of "
                      + std::to_string(n_modes)
                      + " rigid-body motions free, so the body has no unique equilibrium; hold it "
                        "with Fixed, Fixed components or Prescribed displacement");
  }

  template <int dim>
  double
  PrescribedDisplacements<dim>::gap(const Vector &state, const double load, Vector &gap) const
  {
    gap            = 0.;
    double largest = 0;
    // A formula may fail where only one rank evaluates it.
    collectively(communicator, [&]() {
      for (const Entry &entry : entries)
        {
          const double value
              = supports[entry.support].displacement(entry.position, load)[entry.component]
                - state.local_element(entry.unknown);
          gap.local_element(entry.unknown) = value;
          largest                          = std::max(largest, std::abs(value));
        }
    });
    gap.update_ghost_values();
    return dealii::Utilities::MPI::max(largest, communicator);
  }

  template <int dim>
  void
  PrescribedDisplacements<dim>::apply(SparseMatrix &matrix, Vector &rhs, const Vector &gap) const
  {
    apply(matrix, Sides{{&rhs, &gap}});
  }

  template <int dim>
  void PrescribedDisplacements<dim>::apply(SparseMatrix &matrix, const Sides &sides) const
  {
    auto       &values    = matrix.values();
    const auto &columns   = matrix.columns();
    const auto &row_start = matrix.row_start();
    for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
      {
        if (is_prescribed_[row])
          continue;
        for (std::size_t k = row_start[row]; k < row_start[row + 1]; ++k)
          if (is_prescribed_[columns[k]])
            {
              for (const auto &[rhs, gap] : sides)
                rhs->local_element(row) -= values[k] * gap->local_element(columns[k]);
              values[k] = 0.;
            }
      }
    for (const LocalIndex row : owned)
      {
        double diagonal = 0;
        for (std::size_t k = row_start[row]; k < row_start[row + 1]; ++k)
          {
            if (columns[k] == row)
              diagonal = std::abs(values[k]);
            values[k] = 0.;
          }
        // Keep the size of the diagonal, so that scaling and pivoting see nothing unusual.
        if (!(diagonal > 0) || !std::isfinite(diagonal))
          diagonal = 1.;
        values[matrix.position(row, row)] = diagonal;
        for (const auto &[rhs, gap] : sides)
          rhs->local_element(row) = diagonal * gap->local_element(row);
      }
  }

  template <int dim>
  void PrescribedDisplacements<dim>::set_zero(Vector &vector) const
  {
    for (const LocalIndex unknown : owned)
      vector.local_element(unknown) = 0.;
  }

  template class PrescribedDisplacements<2>;
  template class PrescribedDisplacements<3>;
} // namespace isochor
