#pragma once

#include <mpi.h>

namespace isochor
{
  /// Memory that the machines of @p communicator have left, MB, all together: what Linux calls
  /// available, less where a control group allows less. Of unequal machines, the poorest counts for
  /// each. Infinity where nothing says. Collective.
  double available_megabytes(MPI_Comm communicator);
} // namespace isochor
