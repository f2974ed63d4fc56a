#pragma once

// Ctrl-C ends a run at the next Newton iteration with valid files; a second one ends it at once.

#include <mpi.h>

namespace isochor
{
  void catch_interrupts();

  /// Has any rank been interrupted? Collective.
  bool interrupted(MPI_Comm communicator);
} // namespace isochor
