#pragma once

// Figures of a state that say whether to trust it, and are not results themselves.

#include <isochor/form/equilibrium.h>
#include <isochor/material/deformation_range.h>

namespace isochor
{
  struct TrustFigures
  {
    /// Cells all of whose vertices are held in every component.
    std::size_t      clamped_cells = 0;
    DeformationRange deformation; ///< over the quadrature points
  };

  /// Collective.
  template <int dim>
  TrustFigures trust_figures(const Equilibrium<dim> &equilibrium, const Vector &state);
} // namespace isochor
