#pragma once

// What mesh a scene asks for, as the parameter file says it.

#include <isochor/core/reference_cell.h>

#include <string>
#include <vector>

namespace isochor
{
  /// How a generator cuts a block of the grid into simplices. The 5-tet alternating split hardly
  /// locks where the 6-tet split locks 20 to 40 times, so a scene names its split.
  enum class Split
  {
    six_tets,      ///< Kuhn: six congruent tetrahedra around one diagonal
    five_tets,     ///< alternating: four corners and a core, mirrored from block to block
    right_diagonal ///< 2D: every quadrilateral cut from lower left to upper right
  };
  inline constexpr auto split_names = name_table<Split>(
      {{Split::six_tets, "6-tet"}, {Split::five_tets, "5-tet"}, {Split::right_diagonal, "right"}});

  struct MeshRequest
  {
    /// Absolute path of a .geo or .msh file, or a generator: "box(lx, ly, lz)",
    /// "rectangle(lx, ly)" (one corner at the origin, metres), or
    /// "quadrilateral(x0,y0, x1,y1, x2,y2, x3,y3)" (corners counterclockwise, bottom side first,
    /// sides named bottom, right, top, left).
    std::string source;
    /// Edge length wanted, metres. 0: as the .geo file has it; not used by .msh files.
    double size = 0;
    /// Generators: blocks per direction; empty: round(length / size), at least 1.
    std::vector<unsigned int> cells;
    Split                     split = Split::six_tets;
    /// What cells the element is made for.
    CellKind kind = CellKind::simplex;
    /// 1: straight cells; 2: quadratic cells, which follow a curved surface.
    unsigned int geometry_order = 1;
  };
} // namespace isochor
