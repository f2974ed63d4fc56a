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
    /// Absolute path of a .geo or .msh file, or a generator (generator_forms(), metres):
    /// - "box(lx, ly, lz)", "rectangle(lx, ly)": one corner at the origin;
    /// - "quadrilateral(x0,y0, x1,y1, x2,y2, x3,y3)": corners counterclockwise, bottom side first,
    ///   sides named bottom, right, top, left;
    /// - "cylinder(radius, length)", "tube(inner, outer, length)": around the x axis from x = 0,
    ///   with the ends left and right, and side, or inner and outer;
    /// - "sphere_octant(inner, outer)": a thick shell around the origin where x, y, z >= 0; left
    ///   (x = 0), bottom (y = 0), back (z = 0), inner, outer;
    /// - "annulus_quarter(inner, outer)": the same in 2D, where x, y >= 0.
    std::string source;
    /// Edge length wanted, metres. 0: as the .geo file has it; not used by .msh files. In curved
    /// generators of the mean of the edges.
    double size = 0;
    /// Generators: blocks in each direction, as GeneratorForm::counts says; empty:
    /// round(length / size), at least 1.
    std::vector<unsigned int> cells;
    Split                     split = Split::six_tets; ///< not used for hypercubes
    /// What cells the element is made for. A .geo file may offer both: its constant `hexahedra`, if
    /// it has one (DefineConstant[ hexahedra = 0 ]), is set to 1 for quadrilaterals and hexahedra
    /// and to 0 for simplices, so that it can recombine.
    CellKind kind = CellKind::simplex;
    /// 1: straight cells; 2: quadratic cells, which follow a curved surface. A .geo file is meshed
    /// with that order; a .msh file must hold cells of it.
    unsigned int geometry_order = 1;

    bool operator==(const MeshRequest &) const = default;
  };
} // namespace isochor
