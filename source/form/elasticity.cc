#include <isochor/element/cell_quadrature.h>
#include <isochor/form/elasticity_kernel.h>
#include <isochor/form/predicted_stress.h>

#include <cmath>
#include <stdexcept>

namespace isochor
{
  template <int dim>
  Elasticity<dim>::Elasticity(const Discretisation<dim> &discretisation,
                              const Energy               energy,
                              const VolumetricStrain     volumetric_strain,
                              const Moduli              &moduli,
                              const ComplianceOptions   &options)
    : data{discretisation,
           make_distortional_energy(energy, moduli),
           volumetric_strain,
           moduli,
           {moduli.compliance(),
            options.lumped,
            discretisation.element.is_stabilised ? options.stabilisation / moduli.mu : 0.}}
  {
    const Element &element = discretisation.element;
    if (!element.is_mixed() && !std::isfinite(moduli.kappa))
      throw std::logic_error("a displacement element needs a finite kappa");

    const bool linear_cells = discretisation.x_shape.degree() == 1
                              && element.kind == CellKind::simplex
                              && discretisation.cells.all_affine;
    if (linear_cells)
      {
        kernel = make_linear_kernel<dim>(discretisation.cells.n_p);
        points = cell_quadrature<dim>(element.kind, 1).get_points();
      }
    else
      {
        kernel = make_quadrature_kernel(discretisation);
        points
            = cell_quadrature<dim>(element.kind, discretisation.quadrature_degree()).get_points();
      }
  }

  template <int dim>
  Elasticity<dim>::~Elasticity() = default;

  template <int dim>
  std::unique_ptr<PredictedStress> Elasticity<dim>::predict_stress(const Vector &state,
                                                                   const Vector &change) const
  {
    auto stress = std::make_unique<PredictedStress>(points.size());
    stress->predict(data, points, state, change);
    return stress;
  }

  template <int dim>
  bool Elasticity<dim>::is_linear() const
  {
    return data.energy->is_linear() && data.volumetric_strain == VolumetricStrain::trace;
  }

  template <int dim>
  Evaluation
  Elasticity<dim>::add(const Vector &state, const double /*load*/, const Target &target) const
  {
    return kernel->add(data, state, target);
  }

  template class Elasticity<2>;
  template class Elasticity<3>;
} // namespace isochor
