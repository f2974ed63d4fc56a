#include <isochor/material/lanes.h>
#include <isochor/measure/cell_fields.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    /// sigma = P F^T / J, then sqrt(3/2 s : s) of its deviator s.
    Batch von_mises_stress(const Deformation &deformation, const Response &response)
    {
      Batch sigma[3][3];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          {
            sigma[i][j] = response.P[3 * i] * deformation.F[3 * j];
            for (int K = 1; K < 3; ++K)
              sigma[i][j] += response.P[3 * i + K] * deformation.F[3 * j + K];
            sigma[i][j] /= deformation.J;
          }
      const Batch mean = (sigma[0][0] + sigma[1][1] + sigma[2][2]) / 3.;
      Batch       squared{};
      for (int i = 0; i < 3; ++i)
        {
          sigma[i][i] -= mean;
          for (int j = 0; j < 3; ++j)
            squared += sigma[i][j] * sigma[i][j];
        }
      return sqrt(1.5 * squared);
    }
  } // namespace

  template <int dim>
  CellFields<dim>::CellFields(const Discretisation<dim> &discretisation, const Material &material)
    : discretisation(discretisation)
    , volumetric_strain(material.volumetric_strain)
    , moduli(isochor::moduli(material))
  {
    energy = make_distortional_energy(material.energy, moduli);
    if (!discretisation.element.is_mixed() && !std::isfinite(moduli.kappa))
      throw std::logic_error("a displacement element needs a finite kappa");
  }

  template <int dim>
  auto CellFields<dim>::tabulate(const std::vector<dealii::Point<dim>> &reference_points) const
      -> Points
  {
    const unsigned int n_x       = discretisation.cells.n_x;
    const unsigned int n_p       = discretisation.cells.n_p;
    const unsigned int n_batches = (reference_points.size() + n_lanes - 1) / n_lanes;

    Points points;
    points.n_points = reference_points.size();
    points.geometry = std::make_shared<GeometryTable<dim>>(discretisation.cells, reference_points);
    points.x.resize(n_batches * n_x);
    points.p.resize(n_batches * n_p);
    for (unsigned int k = 0; k < n_batches * n_lanes; ++k)
      {
        // Lanes beyond the last point repeat it.
        const auto        &xi    = reference_points[std::min(k, points.n_points - 1)];
        const unsigned int batch = k / n_lanes, lane = k % n_lanes;
        for (unsigned int a = 0; a < n_x; ++a)
          {
            auto &shape              = points.x[batch * n_x + a];
            shape.value[lane]        = discretisation.x_shape.value(a, xi);
            const auto by_coordinate = discretisation.x_shape.gradient(a, xi);
            for (int d = 0; d < dim; ++d)
              shape.gradient[d][lane] = by_coordinate[d];
          }
        for (unsigned int j = 0; j < n_p; ++j)
          points.p[batch * n_p + j].value[lane] = discretisation.p_shape.value(j, xi);
      }
    return points;
  }

  template <int dim>
  auto CellFields<dim>::at(const std::size_t  cell,
                           const Points      &points,
                           const unsigned int batch_no,
                           const double      *values) const -> Here
  {
    const CellTables<dim> &cells = discretisation.cells;

    Here  here{};
    Batch by_xi[dim][dim]{};
    for (unsigned int a = 0; a < cells.n_x; ++a)
      {
        const auto   &shape = points.x[batch_no * cells.n_x + a];
        const double *node  = values + cells.x[cell * cells.n_x + a];
        for (int i = 0; i < dim; ++i)
          {
            here.displacement[i] += node[i] * shape.value;
            for (int k = 0; k < dim; ++k)
              by_xi[i][k] += node[i] * shape.gradient[k];
          }
      }
    for (unsigned int j = 0; j < cells.n_p; ++j)
      here.pressure
          += values[cells.p[cell * cells.n_p + j]] * points.p[batch_no * cells.n_p + j].value;

    Batch inverse[dim][dim];
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const unsigned int point = std::min(batch_no * n_lanes + lane, points.n_points - 1);
        const auto         map   = points.geometry->map(cell, point);
        for (int k = 0; k < dim; ++k)
          for (int J = 0; J < dim; ++J)
            inverse[k][J][lane] = map.inverse[k][J];
      }
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        for (int k = 0; k < dim; ++k)
          here.gradient[i][J] += by_xi[i][k] * inverse[k][J];
    return here;
  }

  template <int dim>
  auto CellFields<dim>::respond(const Here &here) const -> Constitutive
  {
    Constitutive all;
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        {
          all.deformation.F[3 * i + J] = batch(i == J ? 1. : 0.);
          if (i < dim && J < dim)
            all.deformation.F[3 * i + J] += here.gradient[i][J];
        }
    all.deformation.complete();
    energy->evaluate(all.deformation, false, all.response);
    all.volumetric = isochor::evaluate(volumetric_strain, all.deformation);
    all.pressure   = is_mixed() ? here.pressure : moduli.kappa * all.volumetric.phi;
    if (!is_mixed())
      add_volumetric(
          all.deformation, all.volumetric, all.pressure, moduli.kappa, false, all.response);
    return all;
  }

  template <int dim>
  void CellFields<dim>::evaluate(const std::size_t              cell,
                                 const Points                  &points,
                                 const double                  *values,
                                 std::vector<PointFields<dim>> &fields) const
  {
    fields.resize(points.n_points);
    for (unsigned int k = 0; k < points.n_points; k += n_lanes)
      {
        const Here   here = at(cell, points, k / n_lanes, values);
        Constitutive all  = respond(here);
        if (is_mixed())
          add_volumetric(all.deformation, all.volumetric, all.pressure, 0., false, all.response);
        const Batch von_mises = von_mises_stress(all.deformation, all.response);
        for (unsigned int lane = 0; lane < n_lanes && k + lane < points.n_points; ++lane)
          {
            PointFields<dim> &point = fields[k + lane];
            for (int i = 0; i < dim; ++i)
              point.displacement[i] = here.displacement[i][lane];
            point.pressure  = all.pressure[lane];
            point.J         = all.deformation.J[lane];
            point.von_mises = von_mises[lane];
          }
      }
  }

  template <int dim>
  void CellFields<dim>::evaluate(const std::size_t              cell,
                                 const Points                  &points,
                                 const double                  *values,
                                 std::vector<PointForces<dim>> &forces) const
  {
    forces.resize(points.n_points);
    for (unsigned int k = 0; k < points.n_points; k += n_lanes)
      {
        const Constitutive all    = respond(at(cell, points, k / n_lanes, values));
        const Batch        misfit = all.volumetric.phi - moduli.compliance() * all.pressure;
        for (unsigned int lane = 0; lane < n_lanes && k + lane < points.n_points; ++lane)
          {
            PointForces<dim> &point = forces[k + lane];
            point                   = {};
            point.pressure          = all.pressure[lane];
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                point.stress[i][J] = all.response.P[3 * i + J][lane];
            if (!is_mixed())
              continue;
            point.misfit = misfit[lane];
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                point.volume_gradient[i][J] = all.volumetric.gradient[3 * i + J][lane];
          }
      }
  }

  template <int dim>
  void CellFields<dim>::evaluate(const std::size_t                 cell,
                                 const Points                     &points,
                                 const double                     *values,
                                 std::vector<PointGradients<dim>> &gradients) const
  {
    gradients.resize(points.n_points);
    for (unsigned int k = 0; k < points.n_points; k += n_lanes)
      {
        const Here here = at(cell, points, k / n_lanes, values);
        for (unsigned int lane = 0; lane < n_lanes && k + lane < points.n_points; ++lane)
          {
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                gradients[k + lane].gradient[i][J] = here.gradient[i][J][lane];
            gradients[k + lane].pressure = here.pressure[lane];
          }
      }
  }

  template class CellFields<2>;
  template class CellFields<3>;
} // namespace isochor
