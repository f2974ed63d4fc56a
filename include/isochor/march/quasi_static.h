#pragma once

// Quasi-static load stepping: the load factor goes from 0 to 1, in steps or along a path.

#include <isochor/march/load_control.h>

namespace isochor
{
  /// @p state: start, usually zero; afterwards the last converged state. @p begin: where an
  /// earlier march was left. Collective.
  template <int dim>
  MarchReport march_quasi_static(const LoadControl<dim> &control,
                                 const SteppingOptions  &stepping,
                                 Vector                 &state,
                                 const MarchState       &begin);
} // namespace isochor
