#pragma once

// Simplex meshes of boxes, rectangles and quadrilaterals.

#include <isochor/mesh/raw_mesh.h>

namespace isochor
{
  /// Does @p source read like a generator, "name(...)", rather than like a file?
  bool is_generator(const std::string &source);

  /// The mesh without quality; boundary holds the named faces. Throws UserError naming the source.
  template <int dim>
  RawMesh<dim> generate(const MeshRequest &request);
} // namespace isochor
