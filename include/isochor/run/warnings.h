#pragma once

// What a run's figures say about its result, in plain words, and what to choose instead.

#include <isochor/material/deformation_range.h>
#include <isochor/run/run.h>

namespace isochor
{
  /// Figures that are made for the warnings alone.
  struct TrustFigures
  {
    /// Cells all of whose vertices are held in every component.
    std::size_t      clamped_cells = 0;
    DeformationRange deformation;
  };

  /// Collective.
  template <int dim>
  TrustFigures trust_figures(const Equilibrium<dim> &equilibrium, const Vector &state);

  /// Sentences for the summary; none if all is well.
  std::vector<std::string> warnings_of(const RunResult    &result,
                                       const Element      &element,
                                       const Material     &material,
                                       const TrustFigures &figures);
} // namespace isochor
