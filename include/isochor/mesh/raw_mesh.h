#pragma once

// A whole mesh on one rank, before it is distributed.

#include <isochor/mesh/mesh_request.h>

#include <deal.II/grid/tria_description.h>

#include <type_traits>

namespace isochor
{
  /// Over all cells, see CellShape. Angle and aspect are of the cells with straight edges through
  /// their vertices; the volume is that of the cells as they are, curved ones too.
  struct MeshQuality
  {
    double min_angle    = 0; ///< degrees
    double max_aspect   = 0; ///< longest edge to smallest height
    double total_volume = 0; ///< m^3 (2D: m^2)
  };

  /// Where the nodes of the cells' geometry are, if it is more than straight edges.
  template <int dim>
  struct GeometryNodes
  {
    /// 1: the vertices say it all, points is empty. 2: quadratic simplices (6 or 10 nodes per
    /// cell), biquadratic or triquadratic hypercubes (9 or 27).
    unsigned int order = 1;
    /// [cell * n + i], m: vertices, inside the edges, inside the faces, inside the cell, as deal.II
    /// numbers these.
    std::vector<dealii::Point<dim>> points;
  };

  template <int dim>
  struct RawMesh
  {
    CellKind                           kind = CellKind::simplex;
    std::vector<dealii::Point<dim>>    vertices;
    std::vector<dealii::CellData<dim>> cells;    ///< positively oriented
    GeometryNodes<dim>                 geometry; ///< in the order of cells
    /// Every face of the body's surface; boundary_id = index in names, or unnamed_boundary.
    dealii::SubCellData      boundary;
    std::vector<std::string> names; ///< boundary names
    MeshQuality              quality;
  };

  /// Boundary id of faces that no name was given to.
  inline constexpr dealii::types::boundary_id unnamed_boundary = 9999;

  /// The list in mesh.boundary that holds the faces.
  template <typename Raw> // RawMesh<dim>, const or not
  auto &boundary_faces(Raw &mesh)
  {
    if constexpr (std::is_same_v<std::remove_const_t<Raw>, RawMesh<2>>)
      return mesh.boundary.boundary_lines;
    else
      return mesh.boundary.boundary_quads;
  }

  /// Read or generate, check (cells of the kind and order asked for, none inverted or degenerate,
  /// one connected body, no unused vertices) and measure. Quadrilaterals and hexahedra come with
  /// their edges directed alike where they meet, as deal.II wants them. Serial. Throws UserError.
  template <int dim>
  RawMesh<dim> make_raw_mesh(const MeshRequest &request);
} // namespace isochor
