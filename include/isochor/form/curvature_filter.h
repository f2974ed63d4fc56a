#pragma once

// The tangent of a step on which Newton's own leads nowhere. Where the energy is not convex, far
// from an equilibrium or behind a limit point, the tangent K has negative directions and Newton's
// step may climb. With every 9x9 (plane strain: 4x4) dP/dF replaced by a semidefinite matrix of the
// same eigenvectors, K is definite (on the volume-preserving displacements, with pressures) and the
// step descends (Teran et al. 2005). Convergence is then linear, so it is a fallback only.

#include <isochor/core/names.h>
#include <isochor/material/distortional_energy.h>

namespace isochor
{
  enum class CurvatureFilter
  {
    none,
    projected, ///< negative eigenvalues become zero
    absolute   ///< negative eigenvalues change their sign (Chen et al. 2024)
  };

  inline constexpr auto curvature_filter_names
      = name_table<CurvatureFilter>({{CurvatureFilter::none, "none"},
                                     {CurvatureFilter::projected, "projected"},
                                     {CurvatureFilter::absolute, "absolute"}});

  /// Filter A of @p response, the whole of dP/dF, with respect to the first @p dim directions. An A
  /// that is not symmetric is made so.
  void filter_curvature(CurvatureFilter filter, unsigned int dim, Response &response);
} // namespace isochor
