#include "patch_recovery.h"

#include <isochor/element/cell_quadrature.h>
#include <isochor/measure/recovered_error.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /// Degree of the quadrature at whose points derivatives are most accurate: those that integrate them
    /// on a cell with the fewest points (Zienkiewicz and Zhu 1992).
    unsigned int sampling_degree(const Element &element)
    {
      const unsigned int k = element.displacement.degree;
      return element.kind == CellKind::hypercube ? 2 * k - 1 : std::max(1u, 2 * (k - 1));
    }

    /// Where the fields are among the samples: dpsi_d/dF, dPhi/dF, p; of each adjoint its gradient and
    /// pressure.
    template <int dim>
    struct Fields
    {
      static constexpr unsigned int stress = 0, volume_gradient = dim * dim,
                                    pressure = 2 * dim * dim, first_adjoint = 2 * dim * dim + 1,
                                    per_adjoint = dim * dim + 1;

      static unsigned int adjoint(const std::size_t k)
      {
        return first_adjoint + k * per_adjoint;
      }
    };

    template <int dim>
    double *append(const dealii::Tensor<2, dim> &tensor, double *to)
    {
      for (unsigned int i = 0; i < dim; ++i)
        to = std::copy_n(&tensor[i][0], dim, to);
      return to;
    }

    template <int dim>
    dealii::Tensor<2, dim> tensor_at(const double *from)
    {
      dealii::Tensor<2, dim> tensor;
      for (unsigned int i = 0; i < dim; ++i)
        std::copy_n(from + dim * i, dim, &tensor[i][0]);
      return tensor;
    }
  } // namespace

  template <int dim>
  RecoveredError<dim>::RecoveredError(const Discretisation<dim> &discretisation,
                                      const Material            &material)
    : discretisation(discretisation)
    , fields(discretisation, material)
    , compliance(moduli(material).compliance())
  {
  }

  template <int dim>
  std::optional<std::vector<double>>
  RecoveredError<dim>::estimate(const Vector &state, const std::vector<Vector> &adjoints) const
  {
    using At                             = Fields<dim>;
    const CellTables<dim>        &cells  = discretisation.cells;
    const unsigned int            degree = discretisation.element.displacement.degree;
    std::vector<PointForces<dim>> forces;
    std::vector<std::vector<PointGradients<dim>>> gradients(adjoints.size());
    const auto evaluate = [&](const std::size_t cell, const auto &points) {
      fields.evaluate(cell, points, state.begin(), forces);
      for (std::size_t k = 0; k < adjoints.size(); ++k)
        fields.evaluate(cell, points, adjoints[k].begin(), gradients[k]);
    };

    const auto sampled = cell_quadrature<dim>(cells.kind, sampling_degree(discretisation.element));
    const auto how
        = PatchFit<dim>::choose(cells.kind, degree, discretisation.n_cells * sampled.size());
    if (!how)
      return {};
    Samples<dim> samples;
    {
      const auto               points = fields.tabulate(sampled.get_points());
      const GeometryTable<dim> geometry(cells, sampled.get_points());
      samples.n_points = sampled.size();
      samples.n_fields = At::adjoint(adjoints.size());
      samples.values.resize(std::size_t(cells.n_cells) * samples.n_points * samples.n_fields);
      double *to = samples.values.data();
      for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
        {
          evaluate(cell, points);
          for (unsigned int q = 0; q < samples.n_points; ++q)
            {
              samples.positions.push_back(geometry.position(cell, q));
              to    = append(forces[q].volume_gradient, append(forces[q].stress, to));
              *to++ = forces[q].pressure;
              for (const auto &adjoint : gradients)
                {
                  to    = append(adjoint[q].gradient, to);
                  *to++ = adjoint[q].pressure;
                }
            }
        }
    }
    const PatchRecovery<dim> recovery(cells, samples, *how);

    const auto quadrature = cell_quadrature<dim>(
        cells.kind, std::max(discretisation.quadrature_degree(), 2 * degree));
    const auto               points = fields.tabulate(quadrature.get_points());
    const GeometryTable<dim> geometry(cells, quadrature.get_points());
    std::vector<double>      errors(adjoints.size(), 0.), recovered;
    for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
      {
        evaluate(cell, points);
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            recovery.evaluate(cell, quadrature.point(q), geometry.position(cell, q), recovered);
            const PointForces<dim> &here     = forces[q];
            const double            pressure = recovered[At::pressure];
            const auto              excess
                = here.stress - tensor_at<dim>(&recovered[At::stress])
                  + pressure
                        * (here.volume_gradient - tensor_at<dim>(&recovered[At::volume_gradient]));
            for (std::size_t k = 0; k < adjoints.size(); ++k)
              {
                const PointGradients<dim> &adjoint         = gradients[k][q];
                const double              *better          = &recovered[At::adjoint(k)];
                const double               better_pressure = better[dim * dim];
                double density = scalar_product(excess, tensor_at<dim>(better) - adjoint.gradient);
                if (cells.n_p > 0)
                  density += (here.pressure - pressure)
                                 * (compliance * better_pressure
                                    - scalar_product(here.volume_gradient, adjoint.gradient))
                             + here.misfit * better_pressure;
                errors[k] -= quadrature.weight(q) * geometry.determinant(cell, q) * density;
              }
          }
      }
    dealii::Utilities::MPI::sum(errors, discretisation.communicator(), errors);
    return errors;
  }

  template class RecoveredError<2>;
  template class RecoveredError<3>;
} // namespace isochor
