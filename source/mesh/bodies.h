#pragma once

// The bodies that generators know: how each is made of blocks.

#include "block_grid.h"
#include "generator_call.h"

namespace isochor
{
  /// For a call of a generator of dimension @p dim. Throws UserError.
  template <int dim>
  BlockGrid<dim> blocks_of(const GeneratorCall &call, const MeshRequest &request);
} // namespace isochor
