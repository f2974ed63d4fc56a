#include <isochor/element/cell_quadrature.h>
#include <isochor/form/equilibrium.h>
#include <isochor/form/loads.h>
#include <isochor/form/predicted_stress.h>
#include <isochor/form/pressure_mass.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /// |int N_p| over all pressures.
    template <int dim>
    double pressure_volume(const Discretisation<dim> &discretisation)
    {
      const CellTables<dim> &cells = discretisation.cells;
      const auto quadrature = cell_quadrature<dim>(cells.kind, discretisation.quadrature_degree());
      const GeometryTable<dim> geometry(cells, quadrature.get_points());
      const ShapeTable<dim>    shape(discretisation.p_shape, quadrature.get_points());
      Vector                   volume = discretisation.make_vector();
      for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
        for (unsigned int j = 0; j < cells.n_p; ++j)
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            volume.local_element(cells.p[cell * cells.n_p + j])
                += quadrature.weight(q) * geometry.determinant(cell, q) * shape.value(q, j);
      volume.zero_out_ghost_values();
      return volume.l2_norm();
    }

    /// Squared norms of the displacement and of the pressure part of the owned entries.
    template <int dim>
    std::array<double, 2> squares(const Discretisation<dim> &discretisation, const Vector &vector)
    {
      std::array<double, 2> sums{};
      for (LocalIndex i = 0; i < vector.locally_owned_size(); ++i)
        sums[i < discretisation.n_owned_displacements ? 0 : 1]
            += vector.local_element(i) * vector.local_element(i);
      return sums;
    }
  } // namespace

  template <int dim>
  Equilibrium<dim>::Equilibrium(const Discretisation<dim> &discretisation,
                                const Scene<dim>          &scene,
                                const BoundaryId          &boundary_id,
                                const ComplianceOptions   &compliance)
    : discretisation_(discretisation)
    , prescribed_(discretisation, scene.supports, boundary_id)
    , offsets(make_pattern(discretisation, pattern))
  {
    const Material &material = scene.material;
    moduli_                  = isochor::moduli(material);
    auto elasticity          = std::make_unique<Elasticity<dim>>(
        discretisation, material.energy, material.volumetric_strain, moduli_, compliance);
    is_linear_  = elasticity->is_linear() && scene.pressures.empty();
    is_minimum_ = discretisation.n_pressures == 0 && scene.pressures.empty()
                  && make_distortional_energy(material.energy, moduli_)->is_symmetric();
    internal = std::move(elasticity);
    if (scene.gravity.norm() > 0)
      loads.push_back(
          std::make_unique<BodyForce<dim>>(discretisation, material.density, scene.gravity));
    if (!scene.body_force.empty())
      loads.push_back(std::make_unique<DistributedForce<dim>>(discretisation, scene.body_force));
    for (const auto &traction : scene.tractions)
      loads.push_back(std::make_unique<TractionLoad<dim>>(
          discretisation, boundary_id(traction.boundary, "Scene/Traction"), traction.components));
    for (const auto &pressure : scene.pressures)
      loads.push_back(std::make_unique<FollowerPressure<dim>>(
          discretisation, boundary_id(pressure.boundary, "Scene/Pressure"), pressure.value));

    if (discretisation.n_pressures > 0)
      volume_scale = pressure_volume(discretisation);

    SparseMatrix at_rest = pattern;
    tangent(discretisation.make_vector(), 0., at_rest);
    diagonal_ = discretisation.make_vector();
    if (discretisation.n_pressures > 0)
      {
        diagonal_ = PressureMass<dim>(discretisation).diagonal();
        diagonal_ *= 1. / moduli_.mu + moduli_.compliance();
      }
    double squared = 0;
    for (LocalIndex i = 0; i < discretisation.n_owned_displacements; ++i)
      {
        const double entry = at_rest.values()[at_rest.position(i, i)];
        squared += std::pow(entry, 2);
        const LocalIndex node = i - i % dim;
        for (LocalIndex k = node; k < node + dim; ++k)
          diagonal_.local_element(k) += entry / dim;
      }
    stiffness_scale
        = std::sqrt(dealii::Utilities::MPI::sum(squared, discretisation.communicator()));
  }

  template <int dim>
  ResidualSize Equilibrium<dim>::residual(const Vector &state,
                                          const double  load,
                                          Vector       &residual,
                                          Vector       *reactions) const
  {
    state.update_ghost_values();

    Vector external = discretisation_.make_vector();
    double value    = 0;
    // A load's formula may fail where only one rank evaluates it.
    collectively(discretisation_.communicator(), [&]() {
      for (const auto &term : loads)
        value += term->add(state, load, {&external}).value;
    });
    residual                   = 0.;
    const Evaluation internals = internal->add(state, load, {&residual});
    value += internals.value;

    double acting = 0, reacting = 0, largest = 0;
    for (LocalIndex i = 0; i < discretisation_.n_owned_displacements; ++i)
      {
        acting += std::pow(external.local_element(i), 2);
        residual.local_element(i) += external.local_element(i);
        largest = std::max(largest, std::abs(state.local_element(i)));
      }
    residual.zero_out_ghost_values();

    if (reactions != nullptr)
      *reactions = 0.;
    for (const LocalIndex unknown : prescribed_.unknowns())
      {
        reacting += std::pow(residual.local_element(unknown), 2);
        if (reactions != nullptr)
          reactions->local_element(unknown) = residual.local_element(unknown);
      }
    prescribed_.set_zero(residual);

    const auto                parts        = squares(discretisation_, residual);
    const MPI_Comm            communicator = discretisation_.communicator();
    const std::vector<double> mine{parts[0], parts[1], acting, reacting, value};
    std::vector<double>       all(mine.size());
    dealii::Utilities::MPI::sum(mine, communicator, all);
    largest = dealii::Utilities::MPI::max(largest, communicator);

    ResidualSize size;
    const double force_scale = std::sqrt(std::max(all[2], all[3]));
    // F = 1 + grad u rounds like a displacement of one cell even where u is much smaller.
    const double floor = 16. * std::numeric_limits<double>::epsilon() * stiffness_scale
                         * (largest + discretisation_.mean_cell_size);
    size.force      = all[0] == 0. ? 0. : std::sqrt(all[0]) / force_scale;
    size.rounding   = floor == 0. ? 0. : floor / force_scale;
    size.constraint = volume_scale > 0 ? std::sqrt(all[1]) / volume_scale : 0.;
    size.value      = all[4];
    // MPI's minimum may lose a NaN; the residual's norm does not.
    size.min_jacobian = dealii::Utilities::MPI::min(
        std::isnan(internals.min_jacobian) ? -1e300 : internals.min_jacobian, communicator);
    return size;
  }

  template <int dim>
  void Equilibrium<dim>::tangent(const Vector          &state,
                                 const double           load,
                                 SparseMatrix          &matrix,
                                 const PredictedStress *stress,
                                 const CurvatureFilter  filter) const
  {
    std::fill(matrix.values().begin(), matrix.values().end(), 0.);
    Target target;
    target.tangent = &matrix;
    target.offsets = &offsets;
    for (const auto &term : loads)
      term->add(state, load, target);
    target.stress = stress;
    target.filter = filter;
    internal->add(state, load, target);
  }

  template <int dim>
  void Equilibrium<dim>::tangent_product(const Vector &state,
                                         const double  load,
                                         const Vector &direction,
                                         Vector       &product) const
  {
    state.update_ghost_values();
    direction.update_ghost_values();
    product = 0.;
    Target target;
    target.direction = &direction;
    target.product   = &product;
    internal->add(state, load, target);
    for (const auto &term : loads)
      term->add(state, load, target);
    product.zero_out_ghost_values();
  }

  template <int dim>
  std::unique_ptr<PredictedStress> Equilibrium<dim>::predict_stress(const Vector &state,
                                                                    const Vector &change) const
  {
    state.update_ghost_values();
    change.update_ghost_values();
    return internal->predict_stress(state, change);
  }

  template class Equilibrium<2>;
  template class Equilibrium<3>;
} // namespace isochor
