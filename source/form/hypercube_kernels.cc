#include <isochor/form/quadrature_kernel.templates.h>

namespace isochor
{
  // Q1, Q1-P0; Q2, Q2-P1.
  template <>
  const std::vector<KernelRow<2>> &hypercube_kernels<2>()
  {
    static const std::vector<KernelRow<2>> rows = {
        kernel_row<2, 4, 0>(), kernel_row<2, 4, 1>(), kernel_row<2, 9, 0>(), kernel_row<2, 9, 3>()};
    return rows;
  }

  template <>
  const std::vector<KernelRow<3>> &hypercube_kernels<3>()
  {
    static const std::vector<KernelRow<3>> rows = {kernel_row<3, 8, 0>(),
                                                   kernel_row<3, 8, 1>(),
                                                   kernel_row<3, 27, 0>(),
                                                   kernel_row<3, 27, 4>()};
    return rows;
  }
} // namespace isochor
