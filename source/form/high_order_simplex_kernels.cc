#include <isochor/form/quadrature_kernel.templates.h>

namespace isochor
{
  // P2, P2-P0, P2-P1; P3, P3-P2.
  template <>
  const std::vector<KernelRow<2>> &high_order_simplex_kernels<2>()
  {
    static const std::vector<KernelRow<2>> rows = {kernel_row<2, 6, 0>(),
                                                   kernel_row<2, 6, 1>(),
                                                   kernel_row<2, 6, 3>(),
                                                   kernel_row<2, 10, 0>(),
                                                   kernel_row<2, 10, 6>()};
    return rows;
  }

  template <>
  const std::vector<KernelRow<3>> &high_order_simplex_kernels<3>()
  {
    static const std::vector<KernelRow<3>> rows = {kernel_row<3, 10, 0>(),
                                                   kernel_row<3, 10, 1>(),
                                                   kernel_row<3, 10, 4>(),
                                                   kernel_row<3, 20, 0>(),
                                                   kernel_row<3, 20, 10>()};
    return rows;
  }
} // namespace isochor
