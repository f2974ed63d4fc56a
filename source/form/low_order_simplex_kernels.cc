#include <isochor/form/quadrature_kernel.templates.h>

namespace isochor
{
  // P1, P1-P0, P1-P1 on curved cells; MINI.
  template <>
  const std::vector<KernelRow<2>> &low_order_simplex_kernels<2>()
  {
    static const std::vector<KernelRow<2>> rows = {
        kernel_row<2, 3, 0>(), kernel_row<2, 3, 1>(), kernel_row<2, 3, 3>(), kernel_row<2, 4, 3>()};
    return rows;
  }

  template <>
  const std::vector<KernelRow<3>> &low_order_simplex_kernels<3>()
  {
    static const std::vector<KernelRow<3>> rows = {
        kernel_row<3, 4, 0>(), kernel_row<3, 4, 1>(), kernel_row<3, 4, 4>(), kernel_row<3, 5, 4>()};
    return rows;
  }
} // namespace isochor
