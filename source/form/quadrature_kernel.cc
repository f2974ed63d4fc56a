#include <isochor/form/quadrature_kernel.templates.h>

#include <stdexcept>

namespace isochor
{
  template <int dim>
  std::unique_ptr<const typename Elasticity<dim>::Kernel>
  make_quadrature_kernel(const Discretisation<dim> &discretisation)
  {
    for (const auto *rows : {&low_order_simplex_kernels<dim>(),
                             &high_order_simplex_kernels<dim>(),
                             &hypercube_kernels<dim>()})
      for (const auto &row : *rows)
        if (row.n_x == discretisation.cells.n_x && row.n_p == discretisation.cells.n_p)
          return row.make(discretisation);
    throw std::logic_error("no kernel is compiled for element "
                           + std::string(discretisation.element.name));
  }

  template std::unique_ptr<const Elasticity<2>::Kernel>
  make_quadrature_kernel(const Discretisation<2> &);
  template std::unique_ptr<const Elasticity<3>::Kernel>
  make_quadrature_kernel(const Discretisation<3> &);
} // namespace isochor
