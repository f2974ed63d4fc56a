#pragma once

// Is a mesh one body that can be computed on?

#include <isochor/mesh/raw_mesh.h>

namespace isochor
{
  /// Throws UserError, starting with @p origin, unless all cells are positively oriented (also as
  /// curved cells: the Jacobian determinant is looked at in all nodes and in points inside) and not
  /// degenerate, neighbours share whole faces and lie on opposite sides of them, all cells hang
  /// together by faces, and each face in @p mesh.boundary lies on the surface and in one boundary.
  /// Then completes @p mesh.boundary to the whole surface: unnamed faces get unnamed_boundary.
  template <int dim>
  void check_and_complete(RawMesh<dim> &mesh, const std::string &origin);
} // namespace isochor
