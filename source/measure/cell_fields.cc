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
  void CellFields<dim>::evaluate(const std::size_t              cell,
                                 const Points                  &points,
                                 const double                  *values,
                                 std::vector<PointFields<dim>> &fields) const
  {
    const CellTables<dim> &cells = discretisation.cells;

    fields.resize(points.n_points);
    for (unsigned int first = 0, batch_no = 0; first < points.n_points;
         first += n_lanes, ++batch_no)
      {
        Batch u[dim]{}, by_xi[dim][dim]{};
        for (unsigned int a = 0; a < cells.n_x; ++a)
          {
            const auto   &shape = points.x[batch_no * cells.n_x + a];
            const double *node  = values + cells.x[cell * cells.n_x + a];
            for (int i = 0; i < dim; ++i)
              {
                u[i] += node[i] * shape.value;
                for (int k = 0; k < dim; ++k)
                  by_xi[i][k] += node[i] * shape.gradient[k];
              }
          }

        Batch inverse[dim][dim];
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const auto map
                = points.geometry->map(cell, std::min(first + lane, points.n_points - 1));
            for (int k = 0; k < dim; ++k)
              for (int J = 0; J < dim; ++J)
                inverse[k][J][lane] = map.inverse[k][J];
          }

        Deformation deformation;
        for (int i = 0; i < 3; ++i)
          for (int J = 0; J < 3; ++J)
            deformation.F[3 * i + J] = batch(i == J ? 1. : 0.);
        for (int i = 0; i < dim; ++i)
          for (int J = 0; J < dim; ++J)
            for (int k = 0; k < dim; ++k)
              deformation.F[3 * i + J] += by_xi[i][k] * inverse[k][J];
        deformation.complete();

        Response response;
        energy->evaluate(deformation, false, response);
        const VolumetricResponse volumetric = isochor::evaluate(volumetric_strain, deformation);
        Batch                    q{};
        if (cells.n_p > 0)
          for (unsigned int j = 0; j < cells.n_p; ++j)
            q += values[cells.p[cell * cells.n_p + j]] * points.p[batch_no * cells.n_p + j].value;
        else
          q = moduli.kappa * volumetric.phi;
        add_volumetric(
            deformation, volumetric, q, cells.n_p > 0 ? 0. : moduli.kappa, false, response);
        const Batch von_mises = von_mises_stress(deformation, response);

        for (unsigned int lane = 0; lane < n_lanes && first + lane < points.n_points; ++lane)
          {
            PointFields<dim> &at = fields[first + lane];
            for (int i = 0; i < dim; ++i)
              at.displacement[i] = u[i][lane];
            at.pressure  = q[lane];
            at.J         = deformation.J[lane];
            at.von_mises = von_mises[lane];
          }
      }
  }

  template class CellFields<2>;
  template class CellFields<3>;
} // namespace isochor
