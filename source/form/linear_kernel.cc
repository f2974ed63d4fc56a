#include <isochor/form/elasticity_kernel.h>
#include <isochor/form/local_system.h>
#include <isochor/form/predicted_stress.h>

#include <algorithm>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    /// Pressures: none, one per cell, or one per vertex.
    template <int dim, int n_p>
    class LinearKernel : public Elasticity<dim>::Kernel
    {
    public:
      static constexpr int  n_x   = dim + 1;
      static constexpr bool mixed = n_p > 0;
      using System                = LocalSystem<dim, n_x, n_p>;

      Evaluation
      add(const ElasticityData<dim> &data, const Vector &state, const Target &target) const override
      {
        const CellTables<dim> &cells    = data.discretisation.cells;
        const double          *values   = state.begin();
        double                *residual = target.residual ? target.residual->begin() : nullptr;

        Evaluation  evaluation;
        CellBatch   in, direction;
        BatchSystem out;
        System      lanes[n_lanes];
        for (std::size_t first = 0; first < cells.n_cells; first += n_lanes)
          {
            const unsigned int n_filled = std::min<std::size_t>(n_lanes, cells.n_cells - first);
            gather(cells, values, first, n_filled, in);
            if (target.product != nullptr)
              gather_unknowns(cells, target.direction->begin(), first, n_filled, direction);
            Stress predicted;
            if (target.stress != nullptr)
              predicted = target.stress->of_cells(first, n_filled);
            compute(data,
                    in,
                    target.tangent != nullptr,
                    target.product != nullptr ? &direction : nullptr,
                    target.stress != nullptr ? &predicted : nullptr,
                    target.filter,
                    out);

            lower(evaluation.min_jacobian, isochor::min(out.J));
            for (unsigned int lane = 0; lane < n_filled && first + lane < cells.n_owned; ++lane)
              evaluation.value += out.value[lane];

            if (residual != nullptr || target.tangent != nullptr || target.product != nullptr)
              transpose(out, target.tangent != nullptr, lanes);
            for (unsigned int lane = 0; lane < n_filled; ++lane)
              {
                if (residual != nullptr)
                  lanes[lane].add_residual(cells, first + lane, residual);
                if (target.tangent != nullptr)
                  lanes[lane].add_tangent(cells, first + lane, *target.offsets, *target.tangent);
                if (target.product != nullptr)
                  lanes[lane].add_residual(cells, first + lane, target.product->begin());
              }
          }
        return evaluation;
      }

    private:
      /// Eight cells' unknowns and geometry.
      struct CellBatch
      {
        Batch u[n_x][dim];
        Batch p[System::n_q];
        Batch gradient[n_x][dim]; ///< dN_a / dX
        Batch volume;
      };

      struct BatchSystem
      {
        Batch K[System::n_u][System::n_u];
        Batch G[System::n_u]; ///< the same for every pressure node of the cell
        Batch C_diagonal, C_off_diagonal;
        Batch r_u[System::n_u];
        Batch r_p[System::n_q];
        Batch J, value;
      };

      static void gather_unknowns(const CellTables<dim> &cells,
                                  const double          *values,
                                  const std::size_t      first,
                                  const unsigned int     n_filled,
                                  CellBatch             &in)
      {
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            // Lanes beyond the last cell repeat it; they are not scattered.
            const std::size_t cell = first + std::min(lane, n_filled - 1);
            for (int a = 0; a < n_x; ++a)
              for (int c = 0; c < dim; ++c)
                in.u[a][c][lane] = values[cells.x[cell * n_x + a] + c];
            for (int j = 0; j < n_p; ++j)
              in.p[j][lane] = values[cells.p[cell * n_p + j]];
          }
      }

      static void gather(const CellTables<dim> &cells,
                         const double          *values,
                         const std::size_t      first,
                         const unsigned int     n_filled,
                         CellBatch             &in)
      {
        gather_unknowns(cells, values, first, n_filled, in);
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const std::size_t cell    = first + std::min(lane, n_filled - 1);
            const double     *inverse = cells.inverse(cell);
            for (int k = 0; k < dim; ++k)
              for (int d = 0; d < dim; ++d)
                in.gradient[k + 1][d][lane] = inverse[k * dim + d];
            in.volume[lane] = cells.determinant[cell] / (dim == 2 ? 2. : 6.);
          }
        for (int d = 0; d < dim; ++d)
          {
            in.gradient[0][d] = -in.gradient[1][d];
            for (int a = 2; a < n_x; ++a)
              in.gradient[0][d] -= in.gradient[a][d];
          }
      }

      static void compute(const ElasticityData<dim> &data,
                          const CellBatch           &in,
                          const bool                 with_matrix,
                          const CellBatch           *direction,
                          const Stress              *predicted,
                          const CurvatureFilter      filter,
                          BatchSystem               &out)
      {
        const bool  with_tangent = with_matrix || direction != nullptr;
        Deformation deformation;
        for (int i = 0; i < 3; ++i)
          for (int J = 0; J < 3; ++J)
            deformation.F[3 * i + J] = batch(i == J ? 1. : 0.);
        for (int a = 0; a < n_x; ++a)
          for (int i = 0; i < dim; ++i)
            for (int J = 0; J < dim; ++J)
              deformation.F[3 * i + J] += in.u[a][i] * in.gradient[a][J];
        deformation.complete();

        Response response;
        data.energy->evaluate(deformation, with_tangent, response);
        if (predicted != nullptr)
          replace_geometric_stress(deformation, *predicted, response);
        const VolumetricResponse volumetric = evaluate(data.volumetric_strain, deformation);

        Batch q = data.moduli.kappa * volumetric.phi;
        if constexpr (mixed)
          {
            q = in.p[0];
            for (int j = 1; j < n_p; ++j)
              q += in.p[j];
            q *= 1. / n_p;
          }
        add_volumetric(
            deformation, volumetric, q, mixed ? 0. : data.moduli.kappa, with_tangent, response);
        if (predicted != nullptr)
          replace_volumetric_stress(deformation, volumetric, q, *predicted, response);
        if (with_tangent)
          filter_curvature(filter, dim, response);

        out.J     = deformation.J;
        out.value = in.volume * (response.energy + (mixed ? 1. : 0.5) * q * volumetric.phi);

        for (int a = 0; a < n_x; ++a)
          for (int i = 0; i < dim; ++i)
            {
              Batch force = response.P[3 * i] * in.gradient[a][0];
              for (int J = 1; J < dim; ++J)
                force += response.P[3 * i + J] * in.gradient[a][J];
              out.r_u[dim * a + i] = in.volume * force;
            }

        if constexpr (mixed)
          {
            // int N_j N_k = V (1 + delta_jk) / ((d + 1) (d + 2)); equation (18).
            constexpr double off = n_p == 1 ? 0. : 1. / ((dim + 1) * (dim + 2));
            constexpr double on  = n_p == 1 ? 1. : 2. * off;
            constexpr double row = 1. / n_p;
            const auto      &C   = data.compliance;
            out.C_off_diagonal
                = in.volume
                  * ((C.lumped ? 0. : off) * C.compliance + (off - row * row) * C.stabilisation);
            out.C_diagonal
                = in.volume
                  * ((C.lumped ? row : on) * C.compliance + (on - row * row) * C.stabilisation);
            const Batch strain = in.volume * volumetric.phi * (1. / n_p);
            for (int j = 0; j < n_p; ++j)
              {
                const Batch Cp = out.C_off_diagonal * (n_p * q)
                                 + (out.C_diagonal - out.C_off_diagonal) * in.p[j];
                out.r_p[j] = strain - Cp;
                out.value -= 0.5 * in.p[j] * Cp;
              }
          }

        if (with_matrix)
          tangent(data.energy->is_symmetric(), in, volumetric, response, out);
        if (direction != nullptr)
          differential(in, *direction, volumetric, response, out);
      }

      /// The change of the residual along a direction: dP = A : dF + dp dPhi/dF, without the cell's
      /// matrix. C of @p out is that of the cell; its residual is overwritten.
      static void differential(const CellBatch          &in,
                               const CellBatch          &direction,
                               const VolumetricResponse &volumetric,
                               const Response           &response,
                               BatchSystem              &out)
      {
        Batch dF[dim][dim] = {};
        for (int a = 0; a < n_x; ++a)
          for (int i = 0; i < dim; ++i)
            for (int J = 0; J < dim; ++J)
              dF[i][J] += direction.u[a][i] * in.gradient[a][J];
        Batch dq{}, strain{};
        for (int j = 0; j < n_p; ++j)
          dq += direction.p[j] * (1. / n_p);

        for (int i = 0; i < dim; ++i)
          {
            Batch dP[dim];
            for (int J = 0; J < dim; ++J)
              {
                dP[J] = dq * volumetric.gradient[3 * i + J];
                for (int k = 0; k < dim; ++k)
                  for (int L = 0; L < dim; ++L)
                    dP[J] += response.A[9 * (3 * i + J) + 3 * k + L] * dF[k][L];
                strain += volumetric.gradient[3 * i + J] * dF[i][J];
              }
            for (int a = 0; a < n_x; ++a)
              {
                Batch force = dP[0] * in.gradient[a][0];
                for (int J = 1; J < dim; ++J)
                  force += dP[J] * in.gradient[a][J];
                out.r_u[dim * a + i] = in.volume * force;
              }
          }
        for (int j = 0; j < n_p; ++j)
          out.r_p[j] = in.volume * strain * (1. / n_p) - out.C_off_diagonal * (n_p * dq)
                       - (out.C_diagonal - out.C_off_diagonal) * direction.p[j];
      }

      static void tangent(const bool                is_symmetric,
                          const CellBatch          &in,
                          const VolumetricResponse &volumetric,
                          const Response           &response,
                          BatchSystem              &out)
      {
        for (int b = 0; b < n_x; ++b)
          {
            // B_iJk = V A_iJkL dN_b/dX_L
            Batch gradient[dim];
            for (int L = 0; L < dim; ++L)
              gradient[L] = in.volume * in.gradient[b][L];
            Batch B[dim][dim][dim];
            for (int i = 0; i < dim; ++i)
              for (int J = 0; J < dim; ++J)
                for (int k = 0; k < dim; ++k)
                  {
                    const Batch *A = &response.A[9 * (3 * i + J) + 3 * k];
                    B[i][J][k]     = A[0] * gradient[0];
                    for (int L = 1; L < dim; ++L)
                      B[i][J][k] += A[L] * gradient[L];
                  }
            for (int a = 0; a <= (is_symmetric ? b : n_x - 1); ++a)
              for (int i = 0; i < dim; ++i)
                for (int k = 0; k < dim; ++k)
                  {
                    Batch K = B[i][0][k] * in.gradient[a][0];
                    for (int J = 1; J < dim; ++J)
                      K += B[i][J][k] * in.gradient[a][J];
                    out.K[dim * a + i][dim * b + k] = K;
                    if (is_symmetric)
                      out.K[dim * b + k][dim * a + i] = K;
                  }
            if constexpr (mixed)
              for (int i = 0; i < dim; ++i)
                {
                  Batch normal = volumetric.gradient[3 * i] * gradient[0];
                  for (int L = 1; L < dim; ++L)
                    normal += volumetric.gradient[3 * i + L] * gradient[L];
                  out.G[dim * b + i] = (1. / n_p) * normal;
                }
          }
      }

      static void
      transpose(const BatchSystem &out, const bool with_tangent, System (&lanes)[n_lanes])
      {
        for (int r = 0; r < System::n_u; ++r)
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            lanes[lane].r_u[r] = out.r_u[r][lane];
        for (int j = 0; j < n_p; ++j)
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            lanes[lane].r_p[j] = out.r_p[j][lane];
        if (!with_tangent)
          return;
        for (int r = 0; r < System::n_u; ++r)
          for (int s = 0; s < System::n_u; ++s)
            for (unsigned int lane = 0; lane < n_lanes; ++lane)
              lanes[lane].K[r][s] = out.K[r][s][lane];
        for (int j = 0; j < n_p; ++j)
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            {
              for (int s = 0; s < System::n_u; ++s)
                lanes[lane].G[j][s] = out.G[s][lane];
              for (int k = 0; k < n_p; ++k)
                lanes[lane].C[j][k] = j == k ? out.C_diagonal[lane] : out.C_off_diagonal[lane];
            }
      }
    };
  } // namespace

  template <int dim>
  std::unique_ptr<const typename Elasticity<dim>::Kernel> make_linear_kernel(const unsigned int n_p)
  {
    if (n_p == dim + 1)
      return std::make_unique<LinearKernel<dim, dim + 1>>();
    if (n_p == 1)
      return std::make_unique<LinearKernel<dim, 1>>();
    if (n_p == 0)
      return std::make_unique<LinearKernel<dim, 0>>();
    throw std::logic_error("no linear kernel with this number of pressures");
  }

  template std::unique_ptr<const Elasticity<2>::Kernel> make_linear_kernel<2>(unsigned int);
  template std::unique_ptr<const Elasticity<3>::Kernel> make_linear_kernel<3>(unsigned int);
} // namespace isochor
