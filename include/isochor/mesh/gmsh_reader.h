#pragma once

// Meshes through the gmsh library, in this process: .geo files are meshed, .msh files are read.

#include <isochor/mesh/raw_mesh.h>

namespace isochor
{
  /// Cells and named faces of a .geo or .msh file, not checked yet. Where the file defines
  /// physical volumes (2D: surfaces), only their cells; vertices of no cell are dropped. Physical
  /// groups of faces with a name become boundaries.
  ///
  /// A requested size is given to a .geo file as its parameter `size`, if the file has one
  /// (DefineConstant[ size = ... ]), else all its edges are held to that length. The same file and
  /// size give the same mesh each time. Not for several threads at once: gmsh is one global state.
  /// Throws UserError naming the file.
  template <int dim>
  RawMesh<dim> read_with_gmsh(const MeshRequest &request);
} // namespace isochor
