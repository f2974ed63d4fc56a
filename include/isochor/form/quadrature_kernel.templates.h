#pragma once

// The kernel for any element, compiled for each pair of numbers of nodes: quadrature points in
// batches of eight. Included by the files that instantiate it only.

#include <isochor/element/cell_quadrature.h>
#include <isochor/form/batch_geometry.h>
#include <isochor/form/elasticity_kernel.h>
#include <isochor/form/predicted_stress.h>
#include <isochor/form/quadrature_tangent.templates.h>

#include <algorithm>

namespace isochor
{
  template <int dim, int n_x, int n_p>
  class QuadratureKernel : public Elasticity<dim>::Kernel
  {
  public:
    static constexpr bool mixed = n_p > 0;
    using Tangent               = QuadratureTangent<dim, n_x, n_p>;
    using System                = typename Tangent::System;
    using PointBatch            = typename Tangent::PointBatch;
    using PointTangent          = typename Tangent::PointTangent;

    explicit QuadratureKernel(const Discretisation<dim> &discretisation)
      : QuadratureKernel(
          discretisation,
          cell_quadrature<dim>(discretisation.cells.kind, discretisation.quadrature_degree()))
    {
    }

    Evaluation
    add(const ElasticityData<dim> &data, const Vector &state, const Target &target) const override
    {
      const CellTables<dim> &cells        = data.discretisation.cells;
      const double          *values       = state.begin();
      double                *residual     = target.residual ? target.residual->begin() : nullptr;
      const bool             with_tangent = target.tangent != nullptr || target.product != nullptr;

      Evaluation                evaluation;
      auto                      system = std::make_unique<System>();
      std::vector<PointTangent> tangents(points.size());
      for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
        {
          const double value = compute(data,
                                       cells,
                                       cell,
                                       values,
                                       with_tangent,
                                       target.stress,
                                       target.filter,
                                       tangents,
                                       *system,
                                       evaluation);
          if (cell < cells.n_owned)
            evaluation.value += value;
          if (residual != nullptr)
            system->add_residual(cells, cell, residual);
          if (target.tangent != nullptr)
            {
              Tangent::matrix(data.energy->is_symmetric(), points, tangents, *system);
              system->add_tangent(cells, cell, *target.offsets, *target.tangent);
            }
          if (target.product != nullptr)
            {
              Tangent::product(cells, cell, target.direction->begin(), points, tangents, *system);
              system->add_residual(cells, cell, target.product->begin());
            }
        }
      return evaluation;
    }

  private:
    QuadratureKernel(const Discretisation<dim>     &discretisation,
                     const dealii::Quadrature<dim> &quadrature)
      : geometry(discretisation.cells, quadrature)
    {
      const unsigned int n_batches = (quadrature.size() + n_lanes - 1) / n_lanes;
      points.resize(n_batches);
      for (unsigned int k = 0; k < n_batches * n_lanes; ++k)
        {
          // Lanes beyond the last point repeat it with weight zero.
          const unsigned int q    = std::min(k, quadrature.size() - 1);
          PointBatch        &at   = points[k / n_lanes];
          const unsigned int lane = k % n_lanes;
          at.weight[lane]         = k < quadrature.size() ? quadrature.weight(k) : 0.;
          for (int a = 0; a < n_x; ++a)
            {
              const auto gradient = discretisation.x_shape.gradient(a, quadrature.point(q));
              for (int d = 0; d < dim; ++d)
                at.x_gradient[a][d][lane] = gradient[d];
            }
          for (int j = 0; j < n_p; ++j)
            at.p_value[j][lane] = discretisation.p_shape.value(j, quadrature.point(q));
        }
    }

    /// Residual of one cell, and what its tangent needs. Returns the value of the term.
    double compute(const ElasticityData<dim> &data,
                   const CellTables<dim>     &cells,
                   const std::size_t          cell,
                   const double              *values,
                   const bool                 with_tangent,
                   const PredictedStress     *stress,
                   const CurvatureFilter      filter,
                   std::vector<PointTangent> &tangents,
                   System                    &out,
                   Evaluation                &evaluation) const
    {
      double u[n_x][dim], p[System::n_q];
      Tangent::gather(cells, cell, values, u, p);

      Batch value{}, r_u[n_x][dim] = {}, r_p[System::n_q] = {};
      Batch mass[System::n_q][System::n_q] = {}, first[System::n_q] = {}; // int N_j N_k, int N_j
      for (std::size_t k = 0; k < points.size(); ++k)
        {
          const PointBatch &at     = points[k];
          PointTangent     &keep   = tangents[k];
          const auto        map    = geometry.map(cells, cell, k);
          const Batch       weight = map.determinant * at.weight;

          for (int a = 0; a < n_x; ++a)
            for (int J = 0; J < dim; ++J)
              {
                keep.gradient[a][J] = at.x_gradient[a][0] * map.inverse[0][J];
                for (int d = 1; d < dim; ++d)
                  keep.gradient[a][J] += at.x_gradient[a][d] * map.inverse[d][J];
              }

          Deformation deformation;
          for (int i = 0; i < 3; ++i)
            for (int J = 0; J < 3; ++J)
              deformation.F[3 * i + J] = batch(i == J ? 1. : 0.);
          for (int a = 0; a < n_x; ++a)
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                deformation.F[3 * i + J] += u[a][i] * keep.gradient[a][J];
          deformation.complete();
          lower(evaluation.min_jacobian, isochor::min(deformation.J));

          Response response;
          data.energy->evaluate(deformation, with_tangent, response);
          Stress predicted;
          if (stress != nullptr)
            {
              predicted = stress->of_points(cell, k);
              replace_geometric_stress(deformation, predicted, response);
            }
          const VolumetricResponse volumetric = evaluate(data.volumetric_strain, deformation);
          Batch                    q{};
          if constexpr (mixed)
            for (int j = 0; j < n_p; ++j)
              q += p[j] * at.p_value[j];
          else
            q = data.moduli.kappa * volumetric.phi;
          add_volumetric(
              deformation, volumetric, q, mixed ? 0. : data.moduli.kappa, with_tangent, response);
          if (stress != nullptr)
            replace_volumetric_stress(deformation, volumetric, q, predicted, response);
          if (with_tangent)
            filter_curvature(filter, dim, response);

          value += weight * (response.energy + (mixed ? 1. : 0.5) * q * volumetric.phi);
          for (int i = 0; i < 3; ++i)
            for (int J = 0; J < 3; ++J)
              response.P[3 * i + J] *= weight;
          for (int a = 0; a < n_x; ++a)
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                r_u[a][i] += response.P[3 * i + J] * keep.gradient[a][J];
          for (int j = 0; j < n_p; ++j)
            {
              const Batch share = weight * at.p_value[j];
              r_p[j] += volumetric.phi * share;
              first[j] += share;
              for (int l = 0; l <= j; ++l)
                mass[j][l] += share * at.p_value[l];
            }

          if (with_tangent)
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                {
                  keep.d_phi[i][J] = weight * volumetric.gradient[3 * i + J];
                  for (int l = 0; l < dim; ++l)
                    for (int L = 0; L < dim; ++L)
                      keep.A[i][J][l][L] = weight * response.A[9 * (3 * i + J) + 3 * l + L];
                }
        }

      double total = sum(value);
      for (int a = 0; a < n_x; ++a)
        for (int i = 0; i < dim; ++i)
          out.r_u[dim * a + i] = sum(r_u[a][i]);
      compliance(data.compliance, mass, first, out);
      for (int j = 0; j < n_p; ++j)
        {
          double Cp = 0;
          for (int l = 0; l < n_p; ++l)
            Cp += out.C[j][l] * p[l];
          out.r_p[j] = sum(r_p[j]) - Cp;
          total -= 0.5 * p[j] * Cp;
        }
      return total;
    }

    static void compliance(const typename ElasticityData<dim>::Compliance &material,
                           const Batch (&mass)[System::n_q][System::n_q],
                           const Batch (&first)[System::n_q],
                           System &out)
    {
      double m[System::n_q], volume = 0;
      for (int j = 0; j < n_p; ++j)
        {
          m[j] = sum(first[j]);
          volume += m[j]; // only stabilised elements ask: their functions add up to 1
        }
      for (int j = 0; j < n_p; ++j)
        for (int l = 0; l <= j; ++l)
          {
            const double M = sum(mass[j][l]);
            double       C = material.lumped ? (j == l ? m[j] : 0.) : M;
            C *= material.compliance;
            if (material.stabilisation > 0)
              C += material.stabilisation * (M - m[j] * m[l] / volume);
            out.C[j][l] = C;
            out.C[l][j] = C;
          }
    }

    std::vector<PointBatch> points;
    BatchGeometry<dim>      geometry;
  };

  template <int dim>
  using KernelPointer = std::unique_ptr<const typename Elasticity<dim>::Kernel>;

  /// A compiled pair of numbers of nodes per cell.
  template <int dim>
  struct KernelRow
  {
    unsigned int n_x, n_p;
    KernelPointer<dim> (*make)(const Discretisation<dim> &);
  };

  template <int dim, int n_x, int n_p>
  KernelPointer<dim> make_kernel(const Discretisation<dim> &discretisation)
  {
    return std::make_unique<QuadratureKernel<dim, n_x, n_p>>(discretisation);
  }

  template <int dim, int n_x, int n_p>
  constexpr KernelRow<dim> kernel_row()
  {
    return {n_x, n_p, &make_kernel<dim, n_x, n_p>};
  }

  /// The kernels of simplices, low and high orders, and of hypercubes; each in a file of its own.
  template <int dim>
  const std::vector<KernelRow<dim>> &low_order_simplex_kernels();
  template <int dim>
  const std::vector<KernelRow<dim>> &high_order_simplex_kernels();
  template <int dim>
  const std::vector<KernelRow<dim>> &hypercube_kernels();
} // namespace isochor
