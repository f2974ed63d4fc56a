#include <isochor/form/elasticity_kernel.h>

#include <cmath>
#include <stdexcept>

namespace isochor
{
  template <int dim>
  Elasticity<dim>::Elasticity(const Discretisation<dim> &discretisation,
                              const Energy               energy,
                              const VolumetricStrain     volumetric_strain,
                              const Moduli              &moduli)
    : data{discretisation, make_distortional_energy(energy, moduli.mu), volumetric_strain, moduli}
  {
    const Element &element = discretisation.element;
    if (!element.is_mixed() && !std::isfinite(moduli.kappa))
      throw std::logic_error("a displacement element needs a finite kappa");

    const bool linear
        = element.displacement_degree == 1 && element.pressure_degree.value_or(1) == 1;
    if (linear)
      kernel = make_linear_kernel<dim>(element.is_mixed());
    else
      kernel = make_quadrature_kernel(discretisation);
  }

  template <int dim>
  Elasticity<dim>::~Elasticity() = default;

  template <int dim>
  Evaluation
  Elasticity<dim>::add(const Vector &state, const double /*load*/, const Target &target) const
  {
    return kernel->add(data, state, target);
  }

  template class Elasticity<2>;
  template class Elasticity<3>;
} // namespace isochor
