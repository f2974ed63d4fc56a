#pragma once

// Aliases shared by every room. Vectors are deal.II's distributed vectors: contiguous locally
// owned range, ghost entries addressed by local index behind it, so that cell loops work on
// plain local integers.

#include <deal.II/lac/la_parallel_vector.h>

#include <cstdint>

namespace isochor
{
  /// Distributed vector of all unknowns: displacement, then pressure, of each rank in turn.
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Local index of an unknown, a node or a cell: owned ones first, ghosts behind.
  using LocalIndex = std::uint32_t;

  /// Global index of an unknown.
  using GlobalIndex = dealii::types::global_dof_index;
} // namespace isochor
