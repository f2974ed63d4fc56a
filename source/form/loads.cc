#include <isochor/element/cell_quadrature.h>
#include <isochor/form/loads.h>
#include <isochor/space/matrix_pattern.h>

#include <algorithm>

namespace isochor
{
  Evaluation DeadLoad::add(const Vector &state, const double load, const Target &target) const
  {
    // No share in the tangent. (A formula may fail on one rank only, which is caught where residuals
    // are asked for.)
    if (target.tangent != nullptr && target.residual == nullptr)
      return {};

    // In proportion to the load factor: fill once for a factor of one.
    const double wanted = varies ? load : 1.;
    if (filled_for != wanted)
      {
        force = 0.;
        fill(wanted, force);
        force.zero_out_ghost_values();
        filled_for = wanted;
      }

    const double scale = varies ? 1. : load;
    Evaluation   evaluation;
    for (LocalIndex i = 0; i < force.locally_owned_size(); ++i)
      {
        const double f = scale * force.local_element(i);
        evaluation.value -= f * state.local_element(i);
        if (target.residual != nullptr)
          target.residual->local_element(i) -= f;
      }
    return evaluation;
  }

  namespace
  {
    /// force += int f N dV with a quadrature exact to @p degree; @p density(position): f in N/m^3.
    template <int dim, typename Density>
    void add_volume_force(const Discretisation<dim> &discretisation,
                          const unsigned int         degree,
                          const Density             &density,
                          Vector                    &force)
    {
      const CellTables<dim>   &cells      = discretisation.cells;
      const auto               quadrature = cell_quadrature<dim>(cells.kind, degree);
      const GeometryTable<dim> geometry(cells, quadrature.get_points());
      const ShapeTable<dim>    shape(discretisation.x_shape, quadrature.get_points());
      for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const double                 dV = geometry.determinant(cell, q) * quadrature.weight(q);
            const dealii::Tensor<1, dim> f  = density(geometry.position(cell, q)) * dV;
            for (unsigned int a = 0; a < cells.n_x; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                force.local_element(cells.x[cell * cells.n_x + a] + c) += f[c] * shape.value(q, a);
          }
    }
  } // namespace

  template <int dim>
  BodyForce<dim>::BodyForce(const Discretisation<dim>    &discretisation,
                            const double                  density,
                            const dealii::Tensor<1, dim> &gravity)
    : DeadLoad(discretisation.make_vector(), false)
    , discretisation(discretisation)
    , weight(density * gravity)
  {
  }

  template <int dim>
  void BodyForce<dim>::fill(const double load, Vector &force) const
  {
    add_volume_force(
        discretisation,
        discretisation.volume_degree(),
        [&](const dealii::Point<dim> &) { return load * weight; },
        force);
  }

  template <int dim>
  DistributedForce<dim>::DistributedForce(const Discretisation<dim>   &discretisation,
                                          std::vector<Expression<dim>> density)
    : DeadLoad(
        discretisation.make_vector(),
        std::ranges::any_of(density, [](const auto &part) { return part.depends_on_load(); }))
    , discretisation(discretisation)
    , density(std::move(density))
  {
  }

  template <int dim>
  void DistributedForce<dim>::fill(const double load, Vector &force) const
  {
    add_volume_force(
        discretisation,
        std::min(2 * discretisation.x_shape.degree() + 1, 9u),
        [&](const dealii::Point<dim> &position) {
          dealii::Tensor<1, dim> f;
          for (unsigned int c = 0; c < dim; ++c)
            f[c] = load * density[c].value(position, load);
          return f;
        },
        force);
  }

  template <int dim>
  TractionLoad<dim>::TractionLoad(const Discretisation<dim>       &discretisation,
                                  const dealii::types::boundary_id boundary,
                                  std::vector<Expression<dim>>     traction)
    : DeadLoad(discretisation.make_vector(), true)
    , discretisation(discretisation)
    , boundary(boundary)
    , traction(std::move(traction))
    , tables(discretisation, 2 * discretisation.x_shape.trace_degree() + 1)
  {
  }

  template <int dim>
  void TractionLoad<dim>::fill(const double load, Vector &force) const
  {
    const CellTables<dim> &cells = discretisation.cells;
    for (const BoundaryFace &face : discretisation.boundary_faces)
      if (face.id == boundary)
        {
          const FaceTable<dim> &table = tables[face.face];
          for (const auto &at : table.points)
            {
              const auto             point = evaluate_face(cells, face, table, at, nullptr);
              dealii::Tensor<1, dim> t;
              for (unsigned int c = 0; c < dim; ++c)
                t[c] = load * traction[c].value(point.reference_position, load)
                       * point.reference_area * at.weight;
              for (unsigned int n = 0; n < table.nodes.size(); ++n)
                for (unsigned int c = 0; c < dim; ++c)
                  force.local_element(cells.x[face.cell * cells.n_x + table.nodes[n]] + c)
                      += at.value[n] * t[c];
            }
        }
  }

  template <int dim>
  FollowerPressure<dim>::FollowerPressure(const Discretisation<dim>       &discretisation,
                                          const dealii::types::boundary_id boundary,
                                          Expression<dim>                  pressure)
    : discretisation(discretisation)
    , boundary(boundary)
    , pressure(std::move(pressure))
    , tables(discretisation, FaceTables<dim>::exact_degree(discretisation))
  {
  }

  template <int dim>
  Evaluation
  FollowerPressure<dim>::add(const Vector &state, const double load, const Target &target) const
  {
    const CellTables<dim> &cells = discretisation.cells;
    for (const BoundaryFace &face : discretisation.boundary_faces)
      if (face.id == boundary)
        {
          const FaceTable<dim> &table = tables[face.face];
          for (const auto &at : table.points)
            {
              const auto   point = evaluate_face(cells, face, table, at, state.begin());
              const double p = load * pressure.value(point.reference_position, load) * at.weight;
              if (target.residual != nullptr)
                for (unsigned int n = 0; n < table.nodes.size(); ++n)
                  for (unsigned int i = 0; i < dim; ++i)
                    target.residual->local_element(cells.x[face.cell * cells.n_x + table.nodes[n]]
                                                   + i)
                        += p * at.value[n] * point.normal[i];
              if (target.tangent != nullptr || target.product != nullptr)
                add_tangent(face, table, at, point, p, target);
            }
        }
    return {};
  }

  template <int dim>
  void FollowerPressure<dim>::add_tangent(const BoundaryFace                &face,
                                          const FaceTable<dim>              &table,
                                          const typename FaceTable<dim>::At &at,
                                          const FacePoint<dim>              &point,
                                          const double                       pressure,
                                          const Target                      &target) const
  {
    const CellTables<dim> &cells = discretisation.cells;
    for (unsigned int b = 0; b < table.nodes.size(); ++b)
      {
        // slope[i][k] = d (n da)_i / d u_bk
        dealii::Tensor<2, dim> slope;
        if constexpr (dim == 2)
          {
            slope[0][1] = at.derivative[b][0];
            slope[1][0] = -at.derivative[b][0];
          }
        else
          {
            // e_k x t_2 dN_b/ds_1 + t_1 x e_k dN_b/ds_2 = e_k x w
            const auto w
                = at.derivative[b][0] * point.tangents[1] - at.derivative[b][1] * point.tangents[0];
            for (unsigned int k = 0; k < 3; ++k)
              {
                slope[(k + 1) % 3][k] = -w[(k + 2) % 3];
                slope[(k + 2) % 3][k] = w[(k + 1) % 3];
              }
          }
        slope *= pressure * table.sign;
        dealii::Tensor<1, dim> change;
        if (target.product != nullptr)
          for (unsigned int k = 0; k < dim; ++k)
            change[k] = target.direction->local_element(
                cells.x[face.cell * cells.n_x + table.nodes[b]] + k);
        change = slope * change;

        for (unsigned int a = 0; a < table.nodes.size(); ++a)
          {
            const LocalIndex head = cells.x[face.cell * cells.n_x + table.nodes[a]];
            if (head >= cells.n_owned_unknowns)
              continue;
            if (target.product != nullptr)
              for (unsigned int i = 0; i < dim; ++i)
                target.product->local_element(head + i) += at.value[a] * change[i];
            if (target.tangent == nullptr)
              continue;
            double     *values    = target.tangent->values().data();
            const auto &row_start = target.tangent->row_start();
            const auto  offset    = target.offsets->row(face.cell, table.nodes[a])[table.nodes[b]];
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int k = 0; k < dim; ++k)
                values[row_start[head + i] + offset + k] += at.value[a] * slope[i][k];
          }
      }
  }

  template class BodyForce<2>;
  template class BodyForce<3>;
  template class DistributedForce<2>;
  template class DistributedForce<3>;
  template class TractionLoad<2>;
  template class TractionLoad<3>;
  template class FollowerPressure<2>;
  template class FollowerPressure<3>;
} // namespace isochor
