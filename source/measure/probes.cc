#include <isochor/core/error.h>
#include <isochor/element/cell_quadrature.h>
#include <isochor/measure/probes.h>
#include <isochor/space/point_location.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace isochor
{
  namespace
  {
    constexpr const char *component_names[] = {"x", "y", "z"};

    template <int dim>
    dealii::Tensor<1, dim> sum_over_ranks(const dealii::Tensor<1, dim> &mine, MPI_Comm communicator)
    {
      return dealii::Utilities::MPI::sum(mine, communicator);
    }
  } // namespace

  template <int dim>
  Probes<dim>::Probes(const Discretisation<dim>            &discretisation,
                      const Material                       &material,
                      const std::vector<ProbeRequest<dim>> &requests,
                      const BoundaryId                     &boundary_id)
    : discretisation(discretisation)
    , faces(discretisation,
            std::max(FaceTables<dim>::exact_degree(discretisation),
                     2 * discretisation.x_shape.trace_degree()))
    , error_norms(discretisation, material)
  {
    const CellTables<dim> &cells = discretisation.cells;
    for (const auto &request : requests)
      {
        Probe probe{request, columns_.size(), {}, {}, {}};
        if (!request.boundary.empty())
          probe.boundary = boundary_id(request.boundary, request.origin);

        if (probe.boundary)
          {
            for (const BoundaryFace &face : discretisation.boundary_faces)
              if (face.id == *probe.boundary)
                for (const unsigned int a : faces[face.face].nodes)
                  probe.nodes.push_back(cells.x[face.cell * cells.n_x + a]);
          }
        else
          probe.nodes = cells.x;
        std::sort(probe.nodes.begin(), probe.nodes.end());
        probe.nodes.erase(std::unique(probe.nodes.begin(), probe.nodes.end()), probe.nodes.end());
        probe.nodes.erase(
            std::lower_bound(probe.nodes.begin(), probe.nodes.end(), cells.n_owned_unknowns),
            probe.nodes.end());

        if (request.kind == ProbeKind::mean_displacement)
          probe.weights = mean_weights(probe);
        if (request.kind == ProbeKind::point_displacement)
          probe.weights = point_weights(probe);
        if (request.kind == ProbeKind::cavity_volume)
          check_closed(probe);
        probes.push_back(std::move(probe));
        add_columns(request);
      }
  }

  template <int dim>
  void Probes<dim>::add_columns(const ProbeRequest<dim> &request)
  {
    std::string unit = "m";
    if (!request.exact.empty())
      {
        columns_.push_back({request.name, ErrorNorms<dim>::unit(request.kind)});
        return;
      }
    if (request.kind == ProbeKind::volume || request.kind == ProbeKind::cavity_volume)
      {
        columns_.push_back({request.name, dim == 2 ? "m^2" : "m^3"});
        return;
      }
    if (request.kind == ProbeKind::reaction)
      unit = dim == 2 ? "N/m" : "N";
    if (request.component)
      columns_.push_back({request.name, unit});
    else
      for (unsigned int c = 0; c < dim; ++c)
        columns_.push_back({request.name + " " + component_names[c], unit});
  }

  template <int dim>
  auto Probes<dim>::point_weights(const Probe &probe) const -> std::vector<Weight>
  {
    // Over all ranks the one whose cell the point is deepest in answers.
    const CellTables<dim> &cells = discretisation.cells;
    const auto             place = PointLocation<dim>(cells).locate(*probe.request.point);
    const double           best  = place ? place->depth : -std::numeric_limits<double>::max();
    const MPI_Comm         communicator = discretisation.communicator();
    const double           best_of_all  = dealii::Utilities::MPI::max(best, communicator);
    if (best_of_all < -1e-6)
      throw UserError(probe.request.origin
                      + ": the point is not in the body; allowed: a place (m) in the reference "
                        "body or on its boundary");
    const unsigned int rank      = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int answering = dealii::Utilities::MPI::min(
        best == best_of_all ? rank : dealii::Utilities::MPI::n_mpi_processes(communicator),
        communicator);
    std::vector<Weight> weights;
    if (rank == answering)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        weights.emplace_back(cells.x[place->cell * cells.n_x + a],
                             discretisation.x_shape.value(a, place->xi));
    return weights;
  }

  template <int dim>
  auto Probes<dim>::mean_weights(const Probe &probe) const -> std::vector<Weight>
  {
    const CellTables<dim>       &cells = discretisation.cells;
    std::map<LocalIndex, double> of_node;
    double                       measure = 0;
    if (probe.boundary)
      {
        for (const BoundaryFace &face : discretisation.boundary_faces)
          if (face.owned && face.id == *probe.boundary)
            for (const auto &at : faces[face.face].points)
              {
                const auto point = evaluate_face(
                    cells, face, faces[face.face], at, static_cast<const double *>(nullptr));
                const double                     weight = at.weight * point.reference_area;
                const std::vector<unsigned int> &nodes  = faces[face.face].nodes;
                measure += weight;
                for (std::size_t n = 0; n < nodes.size(); ++n)
                  of_node[cells.x[face.cell * cells.n_x + nodes[n]]] += weight * at.value[n];
              }
      }
    else
      {
        const auto quadrature = cell_quadrature<dim>(cells.kind, discretisation.volume_degree());
        const GeometryTable<dim> geometry(cells, quadrature.get_points());
        const ShapeTable<dim>    shape(discretisation.x_shape, quadrature.get_points());
        for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              const double weight = geometry.determinant(cell, q) * quadrature.weight(q);
              measure += weight;
              for (unsigned int a = 0; a < cells.n_x; ++a)
                of_node[cells.x[cell * cells.n_x + a]] += weight * shape.value(q, a);
            }
      }
    measure = dealii::Utilities::MPI::sum(measure, discretisation.communicator());
    std::vector<Weight> weights;
    for (const auto &[node, weight] : of_node)
      weights.emplace_back(node, weight / measure);
    return weights;
  }

  template <int dim>
  void Probes<dim>::check_closed(const Probe &probe) const
  {
    dealii::Tensor<1, dim> total;
    double                 area = 0;
    for (const BoundaryFace &face : discretisation.boundary_faces)
      if (face.owned && face.id == *probe.boundary)
        for (const auto &at : faces[face.face].points)
          {
            const auto point = evaluate_face(discretisation.cells,
                                             face,
                                             faces[face.face],
                                             at,
                                             static_cast<const double *>(nullptr));
            total += at.weight * point.normal;
            area += at.weight * point.reference_area;
          }
    const MPI_Comm communicator = discretisation.communicator();
    total                       = sum_over_ranks(total, communicator);
    area                        = dealii::Utilities::MPI::sum(area, communicator);
    if (!(total.norm() <= 1e-8 * area))
      throw UserError(probe.request.origin + ": boundary '" + probe.request.boundary
                      + "' is not closed, so it encloses no volume; name the whole surface of "
                        "the cavity");
  }

  template <int dim>
  std::vector<double> Probes<dim>::components(const Probe                  &probe,
                                              const dealii::Tensor<1, dim> &vector) const
  {
    if (!probe.request.component)
      return std::vector<double>(vector.begin_raw(), vector.end_raw());
    if (*probe.request.component == dim)
      return {vector.norm()};
    return {vector[*probe.request.component]};
  }

  template <int dim>
  dealii::Tensor<1, dim> Probes<dim>::direction(const Probe                  &probe,
                                                const unsigned int            column,
                                                const dealii::Tensor<1, dim> &vector) const
  {
    const unsigned int component = probe.request.component.value_or(column);
    if (component == dim) // the magnitude; zero has no direction
      return vector / std::max(vector.norm(), std::numeric_limits<double>::min());
    dealii::Tensor<1, dim> unit;
    unit[component] = 1.;
    return unit;
  }

  template <int dim>
  dealii::Tensor<1, dim> Probes<dim>::mean(const std::vector<Weight> &weights,
                                           const Vector              &state) const
  {
    dealii::Tensor<1, dim> total;
    for (const auto &[node, weight] : weights)
      for (unsigned int c = 0; c < dim; ++c)
        total[c] += weight * state.local_element(node + c);
    return sum_over_ranks(total, discretisation.communicator());
  }

  template <int dim>
  std::pair<double, std::optional<LocalIndex>>
  Probes<dim>::extreme(const Probe &probe, const unsigned int column, const Vector &state) const
  {
    const double              sign = probe.request.kind == ProbeKind::min_displacement ? -1. : 1.;
    double                    best = -std::numeric_limits<double>::max();
    std::optional<LocalIndex> where;
    for (const LocalIndex node : probe.nodes)
      {
        dealii::Tensor<1, dim> u;
        for (unsigned int c = 0; c < dim; ++c)
          u[c] = state.local_element(node + c);
        if (const double value = sign * components(probe, u)[column]; value > best)
          {
            best  = value;
            where = node;
          }
      }
    // The first rank of those that have it.
    const MPI_Comm     communicator = discretisation.communicator();
    const double       best_of_all  = dealii::Utilities::MPI::max(best, communicator);
    const unsigned int rank         = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int first        = dealii::Utilities::MPI::min(
        where && best == best_of_all ? rank : dealii::Utilities::MPI::n_mpi_processes(communicator),
        communicator);
    return {sign * best_of_all, rank == first ? where : std::nullopt};
  }

  template <int dim>
  double Probes<dim>::cavity_volume(const Probe &probe, const double *values) const
  {
    // The body's outward normal points into the cavity: V = -1/d oint x . n da.
    double volume = 0;
    for (const BoundaryFace &face : discretisation.boundary_faces)
      if (face.owned && face.id == *probe.boundary)
        for (const auto &at : faces[face.face].points)
          {
            const auto point
                = evaluate_face(discretisation.cells, face, faces[face.face], at, values);
            volume
                -= at.weight * (point.reference_position + point.displacement) * point.normal / dim;
          }
    return dealii::Utilities::MPI::sum(volume, discretisation.communicator());
  }

  template <int dim>
  std::vector<double>
  Probes<dim>::measure(const Vector &state, const Vector &reactions, const double load) const
  {
    std::vector<double> values;
    const auto          append = [&](const std::vector<double> &more) {
      values.insert(values.end(), more.begin(), more.end());
    };
    for (const Probe &probe : probes)
      switch (probe.request.kind)
        {
          case ProbeKind::mean_displacement:
          case ProbeKind::point_displacement:
            append(components(probe, mean(probe.weights, state)));
            break;
          case ProbeKind::min_displacement:
          case ProbeKind::max_displacement:
            for (unsigned int k = 0; k < n_components(probe); ++k)
              append({extreme(probe, k, state).first});
            break;
          case ProbeKind::volume:
            append({deformed_volume(discretisation, state)});
            break;
          case ProbeKind::cavity_volume:
            append({cavity_volume(probe, state.begin())});
            break;
          case ProbeKind::reaction:
            {
              dealii::Tensor<1, dim> total;
              for (const LocalIndex node : probe.nodes)
                for (unsigned int c = 0; c < dim; ++c)
                  total[c] += reactions.local_element(node + c);
              append(components(probe, sum_over_ranks(total, discretisation.communicator())));
              break;
            }
          case ProbeKind::displacement_l2_error:
          case ProbeKind::displacement_h1_error:
          case ProbeKind::pressure_l2_error:
            append({error_norms.measure(probe.request, state, load)});
            break;
        }
    return values;
  }

  template <int dim>
  std::map<std::size_t, Vector> Probes<dim>::derivatives(const std::string &name,
                                                         const Vector      &state) const
  {
    const auto found
        = std::ranges::find_if(probes, [&](const Probe &p) { return p.request.name == name; });
    if (found == probes.end())
      return {};
    const Probe &probe      = *found;
    const bool   is_extreme = probe.request.kind == ProbeKind::min_displacement
                            || probe.request.kind == ProbeKind::max_displacement;
    if (!is_extreme && probe.request.kind != ProbeKind::mean_displacement
        && probe.request.kind != ProbeKind::point_displacement)
      return {};

    std::map<std::size_t, Vector> by_column;
    for (unsigned int k = 0; k < n_components(probe); ++k)
      {
        std::vector<Weight> weights = probe.weights;
        if (is_extreme)
          if (const auto node = extreme(probe, k, state).second)
            weights.emplace_back(*node, 1.);
        const auto along  = direction(probe, k, mean(weights, state));
        Vector    &column = by_column[probe.first_column + k];
        column            = discretisation.make_vector();
        for (const auto &[node, weight] : weights)
          for (unsigned int c = 0; c < dim; ++c)
            column.local_element(node + c) += weight * along[c];
        column.compress(dealii::VectorOperation::add);
      }
    return by_column;
  }

  template class Probes<2>;
  template class Probes<3>;
} // namespace isochor
