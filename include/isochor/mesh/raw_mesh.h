#pragma once

// A whole simplex mesh on one rank, before it is distributed.

#include <isochor/mesh/mesh_request.h>

#include <deal.II/grid/tria_description.h>

namespace isochor
{
  /// Smallest dihedral angle (2D: corner angle) in degrees, largest ratio of longest edge to
  /// smallest height, over all cells.
  struct MeshQuality
  {
    double min_angle    = 0;
    double max_aspect   = 0;
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

  /// Read or generate, check (only simplices, first order, none inverted or degenerate, one
  /// connected body, no unused vertices) and measure. Serial. Throws UserError.
  template <int dim>
  RawMesh<dim> make_raw_mesh(const MeshRequest &request);
} // namespace isochor
