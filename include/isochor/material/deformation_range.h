#pragma once

// How far a body has been deformed, for energies that serve only so far.

#include <isochor/material/distortional_energy.h>

namespace isochor
{
  struct DeformationRange
  {
    /// Smallest principal stretch; below zero where J < 0. Who knows only the smallest J may put
    /// its cube root here, which is never smaller.
    double smallest_stretch = 1.;
    double largest_rotation = 0.; ///< angle of R in F = R S, in [0, pi]

    /// Widen by the first @p n_points lanes. A NaN in F counts as a stretch of minus infinity.
    void include(const Deformation &deformation, unsigned int n_points = n_lanes);
  };
} // namespace isochor
