#pragma once

// What a .geo file offers to be set from outside.

#include <isochor/mesh/mesh_request.h>

#include <optional>

namespace isochor
{
  /// What the .geo file has its constant @p name be, unless it is set: the text behind the equals sign
  /// of DefineConstant[ name = ... ]. None if it has no such constant.
  std::optional<std::string> geo_constant(const std::string &path, const std::string &name);

  /// Can @p request be met with hexahedra (2D: quadrilaterals) as well as with simplices?
  bool offers_hypercubes(const MeshRequest &request);

  /// Edge length that the mesh of @p request is asked for, m. None if nothing tells it.
  std::optional<double> edge_length(const MeshRequest &request);
} // namespace isochor
