#pragma once

// Meshes through the gmsh library, in this process: .geo files are meshed, .msh files are read.

#include <isochor/mesh/raw_mesh.h>

namespace isochor
{
  /// Cells and named faces of a .geo or .msh file, not checked yet. Where the file defines
  /// physical volumes (2D: surfaces), only their cells; vertices of no cell are dropped. Physical
  /// groups of faces with a name become boundaries. Cells of another kind or order than requested
  /// are refused, and meshes of several kinds.
  ///
  /// A requested size is given to a .geo file as its parameter `size`, if the file has one
  /// (DefineConstant[ size = ... ]), else gmsh's sizes are held to that length. Edges of the surface
  /// come out near it; gmsh's Delaunay makes those inside a body longer, up to 1.3 times in the mean
  /// of a fine mesh. The same file and
  /// size give the same mesh each time. Not for several threads at once: gmsh is one global state.
  /// Throws UserError naming the file. @p untangles: gmsh mends what it can of the tetrahedra of a
  /// .geo file that quadratic edges turn inside out.
  template <int dim>
  RawMesh<dim> read_with_gmsh(const MeshRequest &request, bool untangles = false);
} // namespace isochor
