#include <isochor/element/simplex_quadrature.h>
#include <isochor/form/elasticity_kernel.h>
#include <isochor/form/local_system.h>

#include <algorithm>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    template <int dim, int n_x, int n_p>
    class QuadratureKernel : public Elasticity<dim>::Kernel
    {
    public:
      static constexpr bool mixed = n_p > 0;
      using System                = LocalSystem<dim, n_x, n_p>;

      explicit QuadratureKernel(const Discretisation<dim> &discretisation)
      {
        const auto quadrature = simplex_quadrature<dim>(discretisation.element.quadrature_degree);
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

        if constexpr (mixed)
          {
            const auto mass_rule = simplex_quadrature<dim>(2 * discretisation.p_shape.degree());
            for (int j = 0; j < n_p; ++j)
              for (int k = 0; k < n_p; ++k)
                {
                  mass[j][k] = 0;
                  for (unsigned int q = 0; q < mass_rule.size(); ++q)
                    mass[j][k] += mass_rule.weight(q)
                                  * discretisation.p_shape.value(j, mass_rule.point(q))
                                  * discretisation.p_shape.value(k, mass_rule.point(q));
                }
          }
      }

      Evaluation
      add(const ElasticityData<dim> &data, const Vector &state, const Target &target) const override
      {
        const CellTables<dim> &cells        = data.discretisation.cells;
        const double          *values       = state.begin();
        double                *residual     = target.residual ? target.residual->begin() : nullptr;
        const bool             with_tangent = target.tangent != nullptr;

        Evaluation                evaluation;
        auto                      system = std::make_unique<System>();
        std::vector<PointTangent> tangents(points.size());
        for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
          {
            const double value
                = compute(data, cells, cell, values, with_tangent, tangents, *system, evaluation);
            if (cell < cells.n_owned)
              evaluation.value += value;
            if (residual != nullptr)
              system->add_residual(cells, cell, residual);
            if (with_tangent)
              {
                tangent(data, cells.determinant[cell], tangents, *system);
                system->add_tangent(cells, cell, *target.offsets, *target.tangent);
              }
          }
        return evaluation;
      }

    private:
      /// Reference shape tables at eight quadrature points.
      struct PointBatch
      {
        Batch x_gradient[n_x][dim];
        Batch p_value[System::n_q];
        Batch weight;
      };

      /// What the tangent needs of eight quadrature points, with the weight in it.
      struct PointTangent
      {
        Batch gradient[n_x][dim];    ///< dN_a / dX
        Batch A[dim][dim][dim][dim]; ///< weighted
        Batch d_phi[dim][dim];       ///< Phi' dJ/dF, weighted
      };

      /// Residual of one cell, and what its tangent needs. Returns the value of the term.
      double compute(const ElasticityData<dim> &data,
                     const CellTables<dim>     &cells,
                     const std::size_t          cell,
                     const double              *values,
                     const bool                 with_tangent,
                     std::vector<PointTangent> &tangents,
                     System                    &out,
                     Evaluation                &evaluation) const
      {
        double u[n_x][dim], p[System::n_q];
        for (int a = 0; a < n_x; ++a)
          for (int c = 0; c < dim; ++c)
            u[a][c] = values[cells.x[cell * n_x + a] + c];
        for (int j = 0; j < n_p; ++j)
          p[j] = values[cells.p[cell * n_p + j]];
        const double *inverse = cells.inverse(cell);

        Batch value{}, r_u[n_x][dim] = {}, r_p[System::n_q] = {};
        for (std::size_t k = 0; k < points.size(); ++k)
          {
            const PointBatch &at     = points[k];
            PointTangent     &keep   = tangents[k];
            const Batch       weight = cells.determinant[cell] * at.weight;

            for (int a = 0; a < n_x; ++a)
              for (int J = 0; J < dim; ++J)
                {
                  keep.gradient[a][J] = at.x_gradient[a][0] * inverse[J];
                  for (int d = 1; d < dim; ++d)
                    keep.gradient[a][J] += at.x_gradient[a][d] * inverse[d * dim + J];
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
            const VolumetricResponse volumetric = evaluate(data.volumetric_strain, deformation.J);
            Batch                    q{};
            if constexpr (mixed)
              for (int j = 0; j < n_p; ++j)
                q += p[j] * at.p_value[j];
            else
              q = data.moduli.kappa * volumetric.phi;
            add_volumetric(
                deformation, volumetric, q, mixed ? 0. : data.moduli.kappa, with_tangent, response);

            value += weight * (response.energy + (mixed ? 1. : 0.5) * q * volumetric.phi);
            for (int i = 0; i < 3; ++i)
              for (int J = 0; J < 3; ++J)
                response.P[3 * i + J] *= weight;
            for (int a = 0; a < n_x; ++a)
              for (int i = 0; i < dim; ++i)
                for (int J = 0; J < dim; ++J)
                  r_u[a][i] += response.P[3 * i + J] * keep.gradient[a][J];
            for (int j = 0; j < n_p; ++j)
              r_p[j] += weight * volumetric.phi * at.p_value[j];

            if (with_tangent)
              for (int i = 0; i < dim; ++i)
                for (int J = 0; J < dim; ++J)
                  {
                    keep.d_phi[i][J] = weight * volumetric.d_phi * deformation.cofactor[3 * i + J];
                    for (int l = 0; l < dim; ++l)
                      for (int L = 0; L < dim; ++L)
                        keep.A[i][J][l][L] = weight * response.A[9 * (3 * i + J) + 3 * l + L];
                  }
          }

        double total = sum(value);
        for (int a = 0; a < n_x; ++a)
          for (int i = 0; i < dim; ++i)
            out.r_u[dim * a + i] = sum(r_u[a][i]);
        // C = mass / kappa in closed form (equation 18).
        const double compliance = data.moduli.compliance() * cells.determinant[cell];
        for (int j = 0; j < n_p; ++j)
          {
            double Cp = 0;
            for (int k = 0; k < n_p; ++k)
              Cp += compliance * mass[j][k] * p[k];
            out.r_p[j] = sum(r_p[j]) - Cp;
            total -= 0.5 * p[j] * Cp;
          }
        return total;
      }

      void tangent(const ElasticityData<dim>       &data,
                   const double                     determinant,
                   const std::vector<PointTangent> &tangents,
                   System                          &out) const
      {
        // For one node b the products A : dN_b of all points stay in the first-level cache
        // while all nodes a run over them.
        std::vector<ProductBatch> products(tangents.size());
        for (int b = 0; b < n_x; ++b)
          {
            for (std::size_t k = 0; k < tangents.size(); ++k)
              {
                const PointTangent &at = tangents[k];
                for (int i = 0; i < dim; ++i)
                  for (int J = 0; J < dim; ++J)
                    for (int l = 0; l < dim; ++l)
                      {
                        Batch product = at.A[i][J][l][0] * at.gradient[b][0];
                        for (int L = 1; L < dim; ++L)
                          product += at.A[i][J][l][L] * at.gradient[b][L];
                        products[k].B[J][i][l] = product;
                      }
                if constexpr (mixed)
                  for (int i = 0; i < dim; ++i)
                    {
                      Batch normal = at.d_phi[i][0] * at.gradient[b][0];
                      for (int L = 1; L < dim; ++L)
                        normal += at.d_phi[i][L] * at.gradient[b][L];
                      products[k].normal[i] = normal;
                    }
              }

            for (int a = 0; a <= b; ++a)
              {
                Batch K[dim][dim] = {};
                for (std::size_t k = 0; k < tangents.size(); ++k)
                  for (int J = 0; J < dim; ++J)
                    for (int i = 0; i < dim; ++i)
                      for (int l = 0; l < dim; ++l)
                        K[i][l] += products[k].B[J][i][l] * tangents[k].gradient[a][J];
                for (int i = 0; i < dim; ++i)
                  for (int l = 0; l < dim; ++l)
                    {
                      const double entry              = sum(K[i][l]);
                      out.K[dim * a + i][dim * b + l] = entry;
                      out.K[dim * b + l][dim * a + i] = entry;
                    }
              }

            for (int j = 0; j < n_p; ++j)
              for (int i = 0; i < dim; ++i)
                {
                  Batch G{};
                  for (std::size_t k = 0; k < tangents.size(); ++k)
                    G += products[k].normal[i] * points[k].p_value[j];
                  out.G[j][dim * b + i] = sum(G);
                }
          }

        for (int j = 0; j < n_p; ++j)
          for (int k = 0; k < n_p; ++k)
            out.C[j][k] = data.moduli.compliance() * determinant * mass[j][k];
      }

      struct ProductBatch
      {
        Batch B[dim][dim][dim]; ///< [J][i][k] = A_iJkL dN_b/dX_L
        Batch normal[dim];      ///< Phi' dJ/dF dN_b/dX
      };

      std::vector<PointBatch> points;
      double                  mass[System::n_q][System::n_q] = {}; ///< on the reference cell
    };

    constexpr int n_lagrange_nodes(const int dim, const int degree)
    {
      return dim == 2 ? (degree + 1) * (degree + 2) / 2
                      : (degree + 1) * (degree + 2) * (degree + 3) / 6;
    }

    template <int dim, int x_degree, int p_degree>
    std::unique_ptr<const typename Elasticity<dim>::Kernel>
    make(const Discretisation<dim> &discretisation)
    {
      constexpr int n_p = p_degree < 0 ? 0 : n_lagrange_nodes(dim, p_degree);
      return std::make_unique<QuadratureKernel<dim, n_lagrange_nodes(dim, x_degree), n_p>>(
          discretisation);
    }
  } // namespace

  template <int dim>
  std::unique_ptr<const typename Elasticity<dim>::Kernel>
  make_quadrature_kernel(const Discretisation<dim> &discretisation)
  {
    struct Row
    {
      int x_degree, p_degree;
      std::unique_ptr<const typename Elasticity<dim>::Kernel> (*make)(const Discretisation<dim> &);
    };
    // Compiled pairs of degrees; -1: no pressure.
    static constexpr Row rows[] = {{2, -1, &make<dim, 2, -1>},
                                   {3, -1, &make<dim, 3, -1>},
                                   {2, 1, &make<dim, 2, 1>},
                                   {3, 2, &make<dim, 3, 2>}};

    const Element &element  = discretisation.element;
    const int      x_degree = element.displacement_degree;
    const int      p_degree = element.is_mixed() ? int(*element.pressure_degree) : -1;
    for (const Row &row : rows)
      if (row.x_degree == x_degree && row.p_degree == p_degree)
        return row.make(discretisation);
    throw std::logic_error("no kernel is compiled for element " + std::string(element.name));
  }

  template std::unique_ptr<const Elasticity<2>::Kernel>
  make_quadrature_kernel(const Discretisation<2> &);
  template std::unique_ptr<const Elasticity<3>::Kernel>
  make_quadrature_kernel(const Discretisation<3> &);
} // namespace isochor
