#pragma once

// Model no more than the scene needs: a box whose front and back cannot move along z, and whose loads
// have no part along z and do not change along it, is in plane strain. Two dimensions compute the
// same.

#include <isochor/run/run.h>

#include <deal.II/base/parameter_handler.h>

#include <optional>

namespace isochor
{
  /// The scene in two dimensions.
  struct PlaneScene
  {
    /// Keys of subsection Scene and what they are in two dimensions.
    std::vector<std::pair<std::string, std::string>> values;
    double                                           depth = 1; ///< m, along z
  };

  /// None if the scene of @p prm is not known to be one of plane strain, which is judged from its
  /// texts: box(...), rollers 'back: z; front: z', and nothing else that names z, back or front.
  std::optional<PlaneScene> plane_scene(const dealii::ParameterHandler &prm);

  /// Figures per metre of @p result, as those of the body of @p depth: volumes and forces.
  void give_depth(RunResult &result, double depth);
} // namespace isochor
