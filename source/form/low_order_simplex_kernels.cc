#include <isochor/form/quadrature_kernel.templates.h>

namespace isochor
{
  // MINI. (P1 and its pairs live on straight cells and have a kernel of their own.)
  template <>
  const std::vector<KernelRow<2>> &low_order_simplex_kernels<2>()
  {
    static const std::vector<KernelRow<2>> rows = {kernel_row<2, 4, 3>()};
    return rows;
  }

  template <>
  const std::vector<KernelRow<3>> &low_order_simplex_kernels<3>()
  {
    static const std::vector<KernelRow<3>> rows = {kernel_row<3, 5, 4>()};
    return rows;
  }
} // namespace isochor
