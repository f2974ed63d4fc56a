#pragma once

// Grids of blocks that are mapped from the unit square or cube, as they are or cut into simplices.

#include <isochor/mesh/raw_mesh.h>

#include <functional>

namespace isochor
{
  /// A rectangular part of a section: n[0] times n[1] quadrilaterals.
  struct Patch
  {
    std::array<unsigned int, 2> n;
    /// Names grid point (a, b): equal in two patches where these touch. From one point to the next
    /// one component changes by one (so that their sum's parity colours a checkerboard); along an
    /// edge that two patches share, a or b grows in the same direction in both.
    std::function<std::array<unsigned int, 3>(unsigned int a, unsigned int b)> key;
    /// Boundary of the sides a = 0, a = n[0], b = 0, b = n[1]; -1 inside the body.
    std::array<int, 4> sides{{-1, -1, -1, -1}};
  };

  /// 2D: a section is the body. 3D: sections in layers, one above the other.
  template <int dim>
  struct BlockGrid
  {
    std::vector<Patch>       patches;
    unsigned int             n_layers = 1;   ///< 3D
    std::array<int, 2>       ends{{-1, -1}}; ///< 3D: boundary below the first, above the last
    std::vector<std::string> names;          ///< of the boundaries
    bool                     has_flat_sides = true; ///< edges of the cells are straight then
    /// From (a / n[0], b / n[1], layer / n_layers) to the body, positively oriented.
    std::function<dealii::Point<dim>(unsigned int patch, const dealii::Point<dim> &unit)> map;
  };

  /// Fill @p grid with cells: the blocks themselves, or each cut as @p split says.
  template <int dim>
  RawMesh<dim>
  fill(const BlockGrid<dim> &grid, CellKind kind, Split split, unsigned int geometry_order);
} // namespace isochor
