#include <isochor/form/predicted_stress.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /// (F^-1 M) of M given row by row.
    void solve_by_F(const Deformation &deformation, const Batch (&M)[9], Batch (&out)[9])
    {
      // F^-1 = cofactor^T / J
      for (int J = 0; J < 3; ++J)
        for (int L = 0; L < 3; ++L)
          {
            Batch sum = deformation.cofactor[J] * M[L];
            for (int i = 1; i < 3; ++i)
              sum += deformation.cofactor[3 * i + J] * M[3 * i + L];
            out[3 * J + L] = sum / deformation.J;
          }
    }

    Stress
    gather(const std::vector<double> &values, const std::size_t first, const std::size_t last)
    {
      Stress stress;
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        {
          const double *from = &values[10 * std::min(first + lane, last)];
          for (int k = 0; k < 9; ++k)
            stress.S[k][lane] = from[k];
          stress.q[lane] = from[9];
        }
      return stress;
    }

    /// Eight points on their way into a batch.
    struct PointBatch
    {
      Deformation  deformation;
      Batch        dF[9];
      Batch        p; ///< after the change
      unsigned int n_filled = 0;

      void clear()
      {
        for (int k = 0; k < 9; ++k)
          {
            deformation.F[k] = batch(k % 4 == 0);
            dF[k]            = batch(0.);
          }
        p        = batch(0.);
        n_filled = 0;
      }
    };

    /// S + dS of the batch, dS = F^-1 (dP - dF S) from dP = A : dF; q + dq.
    template <int dim>
    Stress predicted(const ElasticityData<dim> &data, PointBatch &at)
    {
      at.deformation.complete();
      Response response;
      data.energy->evaluate(at.deformation, true, response);
      const VolumetricResponse volumetric = evaluate(data.volumetric_strain, at.deformation);
      Stress                   stress;
      stress.q = at.p;
      if (!data.discretisation.element.is_mixed())
        {
          stress.q = volumetric.phi;
          for (int k = 0; k < 9; ++k)
            stress.q += volumetric.gradient[k] * at.dF[k];
          stress.q *= data.moduli.kappa;
        }
      solve_by_F(at.deformation, response.P, stress.S);
      Batch dP[9], dS[9];
      for (int i = 0; i < 3; ++i)
        for (int J = 0; J < 3; ++J)
          {
            Batch sum{};
            for (int k = 0; k < 9; ++k)
              sum += response.A[9 * (3 * i + J) + k] * at.dF[k];
            for (int K = 0; K < 3; ++K)
              sum -= at.dF[3 * i + K] * stress.S[3 * K + J];
            dP[3 * i + J] = sum;
          }
      solve_by_F(at.deformation, dP, dS);
      for (int k = 0; k < 9; ++k)
        stress.S[k] += dS[k];
      return stress;
    }
  } // namespace

  void replace_geometric_stress(const Deformation &deformation,
                                const Stress      &predicted,
                                Response          &response)
  {
    Batch now[9];
    solve_by_F(deformation, response.P, now);
    for (int J = 0; J < 3; ++J)
      for (int L = 0; L < 3; ++L)
        {
          // Symmetric up to rounding, which the tangent must not see.
          const Batch difference = 0.5
                                   * (predicted.S[3 * J + L] + predicted.S[3 * L + J]
                                      - now[3 * J + L] - now[3 * L + J]);
          for (int i = 0; i < 3; ++i)
            response.A[9 * (3 * i + J) + 3 * i + L] += difference;
        }
  }

  void replace_volumetric_stress(const Deformation        &deformation,
                                 const VolumetricResponse &volumetric,
                                 const Batch              &q,
                                 const Stress             &predicted,
                                 Response                 &response)
  {
    Batch P[9];
    std::copy(std::begin(response.P), std::end(response.P), P);
    add_volumetric(deformation, volumetric, predicted.q - q, 0., true, response);
    std::copy(std::begin(P), std::end(P), response.P);
  }

  Stress PredictedStress::of_cells(const std::size_t first, const unsigned int n_filled) const
  {
    return gather(values, first, first + n_filled - 1);
  }

  Stress PredictedStress::of_points(const std::size_t cell, const unsigned int k) const
  {
    return gather(values, cell * n_points + k * n_lanes, (cell + 1) * n_points - 1);
  }

  template <int dim>
  void PredictedStress::predict(const ElasticityData<dim>             &data,
                                const std::vector<dealii::Point<dim>> &points,
                                const Vector                          &state,
                                const Vector                          &change)
  {
    AssertDimension(points.size(), n_points);
    const Discretisation<dim> &discretisation = data.discretisation;
    const CellTables<dim>     &cells          = discretisation.cells;
    const GeometryTable<dim>   geometry(cells, points);
    const ShapeTable<dim>      x_shape(discretisation.x_shape, points);
    const ShapeTable<dim>      p_shape(discretisation.p_shape, points);
    values.resize(std::size_t(cells.n_cells) * n_points * 10);

    PointBatch at;
    at.clear();
    double    *next  = values.data();
    const auto flush = [&]() {
      const Stress stress = predicted(data, at);
      for (unsigned int lane = 0; lane < at.n_filled; ++lane)
        {
          for (int k = 0; k < 9; ++k)
            *next++ = stress.S[k][lane];
          *next++ = stress.q[lane];
        }
      at.clear();
    };
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const auto         map  = geometry.map(cell, q);
          const unsigned int lane = at.n_filled;
          for (unsigned int a = 0; a < cells.n_x; ++a)
            {
              const LocalIndex head     = cells.x[cell * cells.n_x + a];
              const auto       gradient = x_shape.gradient(q, a) * map.inverse;
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int J = 0; J < dim; ++J)
                  {
                    at.deformation.F[3 * i + J][lane]
                        += state.local_element(head + i) * gradient[J];
                    at.dF[3 * i + J][lane] += change.local_element(head + i) * gradient[J];
                  }
            }
          for (unsigned int j = 0; j < cells.n_p; ++j)
            {
              const LocalIndex unknown = cells.p[cell * cells.n_p + j];
              at.p[lane] += (state.local_element(unknown) + change.local_element(unknown))
                            * p_shape.value(q, j);
            }
          if (++at.n_filled == n_lanes)
            flush();
        }
    if (at.n_filled > 0)
      flush();
  }

  template void PredictedStress::predict(const ElasticityData<2> &,
                                         const std::vector<dealii::Point<2>> &,
                                         const Vector &,
                                         const Vector &);
  template void PredictedStress::predict(const ElasticityData<3> &,
                                         const std::vector<dealii::Point<3>> &,
                                         const Vector &,
                                         const Vector &);
} // namespace isochor
