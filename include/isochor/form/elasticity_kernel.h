#pragma once

// Cell kernels of the hyperelastic term. Linear elements compute eight cells at a time, higher
// orders the quadrature points of one cell in batches of eight.

#include <isochor/form/elasticity.h>

namespace isochor
{
  template <int dim>
  class Elasticity<dim>::Kernel
  {
  public:
    virtual ~Kernel() = default;
    virtual Evaluation
    add(const ElasticityData<dim> &data, const Vector &state, const Target &target) const = 0;
  };

  /// P1, P1-P1, P1-P0 on affine cells: one quadrature point, exact because J is constant on a cell.
  /// @p n_p: pressure nodes per cell, 0, 1 or dim + 1.
  template <int dim>
  std::unique_ptr<const typename Elasticity<dim>::Kernel> make_linear_kernel(unsigned int n_p);

  /// Any element on any cells.
  template <int dim>
  std::unique_ptr<const typename Elasticity<dim>::Kernel>
  make_quadrature_kernel(const Discretisation<dim> &discretisation);
} // namespace isochor
