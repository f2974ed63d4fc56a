#include <isochor/element/cell_quadrature.h>
#include <isochor/solver/block_data.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isochor
{
  namespace
  {
    // More do not save iterations of FGMRES, measured.
    constexpr unsigned int mass_steps = 3;

    /// Below, a cell counts as flat.
    constexpr double smallest_jacobian = 0.05;

    using Masses = dealii::FullMatrix<double>;

    /// int N_p N_q over a cell.
    template <int dim>
    Masses cell_mass(const ShapeTable<dim>         &shape,
                     const GeometryTable<dim>      &geometry,
                     const dealii::Quadrature<dim> &quadrature,
                     const std::size_t              cell)
    {
      const unsigned int n = shape.n_nodes();
      Masses             mass(n, n);
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const double dV = quadrature.weight(q) * geometry.determinant(cell, q);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              mass(i, j) += dV * shape.value(q, i) * shape.value(q, j);
        }
      return mass;
    }

    /// Eigenvalues of D^-1 M on a cell, smallest and largest: they bound those of the sum over all
    /// cells (Wathen, IMA J. Numer. Anal. 7, 1987).
    std::pair<double, double> eigenvalue_bounds(const Masses &mass)
    {
      const unsigned int               n = mass.m();
      dealii::LAPACKFullMatrix<double> scaled(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          scaled(i, j) = mass(i, j) / std::sqrt(mass(i, i) * mass(j, j));
      dealii::Vector<double>     values;
      dealii::FullMatrix<double> vectors;
      scaled.compute_eigenvalues_symmetric(-1e300, 1e300, 0., values, vectors);
      return {*std::min_element(values.begin(), values.end()),
              *std::max_element(values.begin(), values.end())};
    }

    /// Every pair of displacement nodes a, b of a cell that are left, a on this rank: their first unknowns.
    template <int dim, typename Visit>
    void for_pairs(const CellTables<dim>         &cells,
                   const std::vector<LocalIndex> &displacement,
                   const LocalIndex               n_owned,
                   const Visit                   &visit)
    {
      for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
        for (unsigned int a = 0; a < cells.n_x; ++a)
          {
            const LocalIndex i = displacement[cells.x[cell * cells.n_x + a]];
            if (i >= n_owned)
              continue;
            for (unsigned int b = 0; b < cells.n_x; ++b)
              if (const LocalIndex j = displacement[cells.x[cell * cells.n_x + b]];
                  j != UnknownSubset::outside)
                visit(cell, a, b, i, j);
          }
    }

    std::size_t n_rigid_motions(const int dim)
    {
      return dim == 2 ? 3 : 6;
    }
  } // namespace

  template <int dim>
  BodyBlockData<dim>::BodyBlockData(const Equilibrium<dim> &equilibrium,
                                    std::vector<LocalIndex> retained)
    : equilibrium(equilibrium)
    , retained(std::move(retained))
  {
    const Discretisation<dim> &discretisation = equilibrium.discretisation();
    const auto                 first_pressure = std::lower_bound(
        this->retained.begin(), this->retained.end(), discretisation.n_owned_displacements);
    displacements
        = make_subset(discretisation.partitioner, {this->retained.begin(), first_pressure});
    data_.n_components = dim;
    find_positions();
    make_stiffness_pattern();
    // Pressures may all have been eliminated.
    const std::vector<LocalIndex> owned_pressures(first_pressure, this->retained.end());
    if (dealii::Utilities::MPI::sum(owned_pressures.size(), discretisation.communicator()) > 0)
      {
        pressures = make_subset(discretisation.partitioner, owned_pressures);
        make_schur();
      }
  }

  template <int dim>
  void BodyBlockData<dim>::find_positions()
  {
    const Discretisation<dim> &discretisation = equilibrium.discretisation();
    const CellTables<dim>     &cells          = discretisation.cells;
    positions.resize(discretisation.n_owned_displacements / dim);
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        if (const LocalIndex i = cells.x[cell * cells.n_x + a];
            i < discretisation.n_owned_displacements)
          positions[i / dim] = cells.position(cell, discretisation.x_shape.node(a));
  }

  template <int dim>
  void BodyBlockData<dim>::make_stiffness_pattern()
  {
    const Discretisation<dim>           &discretisation = equilibrium.discretisation();
    const CellTables<dim>               &cells          = discretisation.cells;
    const LocalIndex                     n              = displacements.n_owned;
    std::vector<std::vector<LocalIndex>> neighbours(n / dim); // first unknowns of nodes
    for_pairs(cells,
              displacements.local,
              n,
              [&](std::size_t, unsigned, unsigned, LocalIndex i, LocalIndex j) {
                neighbours[i / dim].push_back(j);
              });
    std::vector<std::size_t> row_start{0};
    std::vector<LocalIndex>  columns;
    for (auto &node : neighbours)
      {
        std::sort(node.begin(), node.end());
        node.erase(std::unique(node.begin(), node.end()), node.end());
        for (unsigned int c = 0; c < dim; ++c)
          {
            for (const LocalIndex j : node)
              for (unsigned int d = 0; d < dim; ++d)
                columns.push_back(j + d);
            row_start.push_back(columns.size());
          }
      }
    data_.stiffness.reinit(displacements.partitioner, std::move(row_start), std::move(columns));
  }

  template <int dim>
  void BodyBlockData<dim>::make_schur()
  {
    const Discretisation<dim>           &discretisation = equilibrium.discretisation();
    const CellTables<dim>               &cells          = discretisation.cells;
    std::vector<std::vector<LocalIndex>> columns(pressures.n_owned);
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int i = 0; i < cells.n_p; ++i)
        if (const LocalIndex row = pressures.local[cells.p[cell * cells.n_p + i]];
            row < pressures.n_owned)
          for (unsigned int j = 0; j < cells.n_p; ++j)
            columns[row].push_back(pressures.local[cells.p[cell * cells.n_p + j]]);
    std::vector<std::size_t> row_start{0};
    std::vector<LocalIndex>  all_columns;
    for (auto &row : columns)
      {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        all_columns.insert(all_columns.end(), row.begin(), row.end());
        row_start.push_back(all_columns.size());
      }
    NearlyDiagonal &schur = data_.schur;
    schur.matrix.reinit(pressures.partitioner, std::move(row_start), std::move(all_columns));

    const unsigned int       degree     = std::max(1u, 2 * discretisation.p_shape.degree());
    const auto               quadrature = cell_quadrature<dim>(cells.kind, degree);
    const ShapeTable<dim>    shape(discretisation.p_shape, quadrature.get_points());
    const GeometryTable<dim> geometry(cells, quadrature.get_points());
    const Moduli            &moduli = equilibrium.moduli();
    const double             factor = 1. / moduli.mu + moduli.compliance();

    double smallest = std::numeric_limits<double>::max(), largest = 0.;
    bool   knows_affine = false;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      {
        const Masses mass = cell_mass(shape, geometry, quadrature, cell);
        // Affine cells differ by their volume only.
        if (!cells.is_affine[cell] || !knows_affine)
          {
            const auto bounds = eigenvalue_bounds(mass);
            smallest          = std::min(smallest, bounds.first);
            largest           = std::max(largest, bounds.second);
            knows_affine |= bool(cells.is_affine[cell]);
          }
        for (unsigned int i = 0; i < cells.n_p; ++i)
          if (const LocalIndex row = pressures.local[cells.p[cell * cells.n_p + i]];
              row < pressures.n_owned)
            for (unsigned int j = 0; j < cells.n_p; ++j)
              schur.matrix.values()[schur.matrix.position(
                  row, pressures.local[cells.p[cell * cells.n_p + j]])]
                  += factor * mass(i, j);
      }
    const MPI_Comm communicator = discretisation.communicator();
    schur.smallest              = dealii::Utilities::MPI::min(smallest, communicator);
    schur.largest               = dealii::Utilities::MPI::max(largest, communicator);
    schur.n_steps               = schur.largest - schur.smallest < 1e-10 ? 1 : mass_steps;
  }

  template <int dim>
  void BodyBlockData<dim>::fill_stiffness(const Vector &state)
  {
    const Discretisation<dim> &discretisation = equilibrium.discretisation();
    const CellTables<dim>     &cells          = discretisation.cells;
    const Element             &element        = discretisation.element;
    const unsigned int         degree         = element.kind == CellKind::simplex
                                                    ? std::max(1u, 2 * element.displacement.degree - 2)
                                                    : element.quadrature_degree;
    const auto                 quadrature     = cell_quadrature<dim>(cells.kind, degree);
    const ShapeTable<dim>      shape(discretisation.x_shape, quadrature.get_points());
    const GeometryTable<dim>   geometry(cells, quadrature.get_points());
    const double               mu = equilibrium.moduli().mu;
    // A mixed element's volume is the pressures' affair.
    const double kappa = element.is_mixed() ? 0. : equilibrium.moduli().kappa;
    using Gradient     = dealii::Tensor<1, dim>;

    SparseMatrix &stiffness = data_.stiffness;
    std::fill(stiffness.values().begin(), stiffness.values().end(), 0.);
    std::vector<Gradient> gradients(cells.n_x * quadrature.size());
    std::vector<double>   dV(quadrature.size());
    std::size_t           known    = cells.n_cells;
    const auto            evaluate = [&](const std::size_t cell) {
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const auto             map = geometry.map(cell, q);
          dealii::Tensor<2, dim> F   = dealii::unit_symmetric_tensor<dim>();
          for (unsigned int a = 0; a < cells.n_x; ++a)
            {
              const Gradient gradient      = shape.gradient(q, a) * map.inverse;
              gradients[q * cells.n_x + a] = gradient;
              for (unsigned int c = 0; c < dim; ++c)
                F[c] += state.local_element(cells.x[cell * cells.n_x + a] + c) * gradient;
            }
          const double J = dealii::determinant(F);
          dV[q]          = quadrature.weight(q) * map.determinant;
          // Nearly flat cells stand as they did at rest. Written so that NaN does.
          if (!(J > smallest_jacobian))
            continue;
          dV[q] *= J;
          const auto inverse = dealii::invert(F);
          for (unsigned int a = 0; a < cells.n_x; ++a)
            gradients[q * cells.n_x + a] = gradients[q * cells.n_x + a] * inverse;
        }
    };
    for_pairs(
        cells,
        displacements.local,
        stiffness.n_rows(),
        [&](const std::size_t  cell,
            const unsigned int a,
            const unsigned int b,
            const LocalIndex   i,
            const LocalIndex   j) {
          if (cell != known)
            evaluate(known = cell);
          dealii::Tensor<2, dim> block;
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              const Gradient &A = gradients[q * cells.n_x + a];
              const Gradient &B = gradients[q * cells.n_x + b];
              block
                  += dV[q]
                     * (mu * (A * B) * dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>())
                        + mu * dealii::outer_product(B, A) + kappa * dealii::outer_product(A, B));
            }
          const std::size_t offset = stiffness.position(i, j) - stiffness.row_start()[i];
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              stiffness.values()[stiffness.row_start()[i + c] + offset + d] += block[c][d];
        });
  }

  template <int dim>
  void BodyBlockData<dim>::update(const Vector &state, const SymmetricScaling &scaling)
  {
    fill_stiffness(state);

    const auto &prescribed = equilibrium.prescribed();
    Vector      factors    = equilibrium.discretisation().make_vector();
    factors                = 1.;
    scaling.apply(factors);
    data_.scaling.resize(retained.size());
    for (std::size_t k = 0; k < retained.size(); ++k)
      data_.scaling[k] = factors.local_element(retained[k]);

    // Factors by the block's numbering, zero where prescribed.
    for (const LocalIndex unknown : prescribed.unknowns())
      factors.local_element(unknown) = 0.;
    factors.update_ghost_values();
    SparseMatrix       &stiffness = data_.stiffness;
    std::vector<double> factor(stiffness.n_rows() + stiffness.partitioner()->n_ghost_indices());
    for (LocalIndex i = 0; i < displacements.local.size(); ++i)
      if (displacements.local[i] != UnknownSubset::outside)
        factor[displacements.local[i]] = factors.local_element(i);
    for (LocalIndex row = 0; row < stiffness.n_rows(); ++row)
      for (std::size_t k = stiffness.row_start()[row]; k < stiffness.row_start()[row + 1]; ++k)
        stiffness.values()[k]
            = factor[row] == 0. && stiffness.columns()[k] == row
                  ? 1.
                  : stiffness.values()[k] * factor[row] * factor[stiffness.columns()[k]];

    data_.modes.assign(n_rigid_motions(dim), std::vector<double>(stiffness.n_rows(), 0.));
    for (LocalIndex k = 0; k < stiffness.n_rows(); ++k)
      {
        const LocalIndex unknown = retained[k];
        if (prescribed.is_prescribed(unknown))
          continue;
        const LocalIndex   first = unknown - unknown % dim;
        dealii::Point<dim> x     = positions[first / dim];
        for (unsigned int c = 0; c < dim; ++c)
          x[c] += state.local_element(first + c);
        const unsigned int c = unknown % dim;
        const double       s = 1. / data_.scaling[k];
        data_.modes[c][k]    = s;
        // A rotation for each pair of axes.
        std::size_t mode = dim;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = a + 1; b < dim; ++b, ++mode)
            data_.modes[mode][k] = c == a ? -s * x[b] : c == b ? s * x[a] : 0.;
      }
  }

  template class BodyBlockData<2>;
  template class BodyBlockData<3>;
} // namespace isochor
