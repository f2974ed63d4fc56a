#pragma once

// Supports that turn too far in one load step.

#include <isochor/form/equilibrium.h>

namespace isochor
{
  /// Throws UserError if the supports turn by more than half a turn in one of @p load_steps equal
  /// steps: that would be taken for the shorter way round, and a full turn for none. Collective.
  template <int dim>
  void check_turns(const Equilibrium<dim> &equilibrium, unsigned int load_steps);
} // namespace isochor
