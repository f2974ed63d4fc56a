#pragma once

// What a run's figures say about its result, in plain words, and what to choose instead.

#include <isochor/measure/trust_figures.h>
#include <isochor/run/run.h>

namespace isochor
{
  /// Sentences for the summary; none if all is well.
  std::vector<std::string> warnings_of(const RunResult    &result,
                                       const Element      &element,
                                       const Material     &material,
                                       const TrustFigures &figures);
} // namespace isochor
