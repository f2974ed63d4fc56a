// Generators: counts (6 or 5 tetrahedra per block, 2 triangles per quadrilateral), volume and
// boundary areas from the lengths, conformity, positive cells. More on curved bodies: curved_cells.

#include "mesh_figures.h"

#include <isochor/mesh/generator.h>

using namespace isochor;
using namespace isochor::testing;

template <int dim>
void show(const MeshRequest &request, const double volume)
{
  const RawMesh<dim> mesh   = make_raw_mesh<dim>(request);
  const auto         counts = face_counts(mesh);
  double             sum = 0, smallest = 1e300;
  for (const auto &cell : mesh.cells)
    {
      const double v = orientation(mesh, cell);
      sum += v;
      smallest = std::min(smallest, v);
    }
  std::cout << request.source << " "
            << (request.kind == CellKind::simplex ? split_names.name(request.split)
                                                  : cells_name(request.kind, dim))
            << "\n  " << mesh.cells.size() << " cells, " << mesh.vertices.size()
            << " vertices\n  faces of 1, 2, "
            << "more cells: " << counts[0] << " " << counts[1] << " " << counts[2]
            << ", boundary faces listed " << boundary_faces(mesh).size() << "\n  volume ratio ";
  if (request.kind == CellKind::simplex)
    std::cout << sum / volume << " ";
  std::cout << mesh.quality.total_volume / volume << ", all cells positive: " << (smallest > 0)
            << "\n  min angle " << mesh.quality.min_angle << ", max aspect "
            << mesh.quality.max_aspect << "\n ";
  for (const auto &[name, area] : areas(mesh))
    std::cout << " " << name << " " << area;
  std::cout << "\n";
}

void refuse(const int                        dim,
            const std::string               &source,
            const double                     size,
            const std::vector<unsigned int> &cells,
            const Split                      split = Split::six_tets)
{
  static const Folder folder;
  print_error(source, folder, [&] {
    const MeshRequest request{source, size, cells, split};
    if (dim == 2)
      make_raw_mesh<2>(request);
    else
      make_raw_mesh<3>(request);
  });
}

int main()
{
  show<3>({"box(1, 1, 1)", 0, {1, 1, 1}, Split::six_tets}, 1);
  show<3>({"box(1, 1, 1)", 0, {1, 1, 1}, Split::five_tets}, 1);
  show<3>({"box(0.2, 0.2, 0.2)", 0, {12, 12, 12}, Split::six_tets}, 0.008);
  show<3>({"box(0.2, 0.2, 0.2)", 0.2 / 12, {}, Split::six_tets}, 0.008);
  show<3>({"box(1, 2, 3)", 0, {3, 4, 5}, Split::five_tets}, 6);
  show<3>({"box( 1,.1 ,1e-1)", 0, {30, 3, 3}, Split::five_tets}, 0.01);
  show<2>({"rectangle(2, 1)", 0.25, {}}, 2);
  show<2>({"rectangle(2, 1)", 5, {}, Split::right_diagonal}, 2);
  // Cook's membrane: area by the shoelace formula 1440.
  show<2>({"quadrilateral(0,0, 48,44, 48,60, 0,44)", 0, {8, 8}}, 1440);

  // Bricks: aspect 0.6 / (1 / 3). Cook's: angle atan(48 / 44) at the lower left; aspect at the lower
  // right, where edges of 65.115 / 8 along (48, 44) and of 2 upwards span a height of 1.474.
  const auto hex = CellKind::hypercube;
  show<3>({"box(1, 1, 1)", 0, {1, 1, 1}, {}, hex}, 1);
  show<3>({"box(1, 2, 3)", 0, {3, 4, 5}, {}, hex}, 6);
  show<2>({"rectangle(2, 1)", 0.25, {}, Split::five_tets, hex}, 2); // no split to be wrong
  show<2>({"quadrilateral(0,0, 48,44, 48,60, 0,44)", 0, {8, 8}, {}, hex}, 1440);

  // Curved bodies by size, 0.25: lengths over it, rounded.
  const auto count = [](const std::string &source, const auto &mesh) {
    std::cout << source << " by size: " << mesh.cells.size() << "\n";
  };
  // Core 1.2 / 0.25 = 5 squared, ring 4 x 5 x 0.47 / 0.25 = 2, length 8.
  count("cylinder", make_raw_mesh<3>({"cylinder(1, 2)", 0.25, {}, {}, hex}));
  // Wall 4, around 4 x (pi / 2 x 1.5 / 0.25 = 9), length 12.
  count("tube", make_raw_mesh<3>({"tube(1, 2, 3)", 0.25, {}, {}, hex}));
  // Wall 4, three times (pi / 4 x 1.5 / 0.25 = 5) squared.
  count("sphere_octant", make_raw_mesh<3>({"sphere_octant(1, 2)", 0.25, {}, {}, hex}));
  count("annulus_quarter", make_raw_mesh<2>({"annulus_quarter(1, 2)", 0.25, {}, {}, hex}));
  count("cylinder, 6-tet", make_raw_mesh<3>({"cylinder(1, 2)", 0.25, {}}));
  count("tube, 5-tet", make_raw_mesh<3>({"tube(1, 2, 3)", 0.25, {}, Split::five_tets}));

  // The cut runs from corner (i, j) to (i + 1, j + 1).
  const auto square = make_raw_mesh<2>({"rectangle(1, 1)", 1, {}});
  for (const auto &cell : square.cells)
    for (const unsigned int v : cell.vertices)
      std::cout << "(" << square.vertices[v] << ") ";
  std::cout << "\n";

  refuse(3, "box(1, 1)", 0.1, {});
  refuse(3, "box(1, 1, 0)", 0.1, {});
  refuse(3, "box(1, 1, nan)", 0.1, {});
  refuse(3, "box(1, 1, 1m)", 0.1, {});
  refuse(3, "box(1, 1, )", 0.1, {});
  refuse(3, "box()", 0.1, {});
  refuse(3, "box(1, 1, 1)", 0, {});
  refuse(3, "box(1, 1, 1)", 1e-6, {});
  refuse(3, "box(1, 1, 1)", 0, {2, 2});
  refuse(3, "box(1, 1, 1)", 0, {2, 0, 2});
  refuse(3, "box(1, 1, 1)", 1, {}, Split::right_diagonal);
  refuse(2, "rectangle(1, 1)", 1, {}, Split::five_tets);
  refuse(2, "box(1, 1, 1)", 1, {});
  refuse(3, "rectangle(1, 1)", 1, {});
  refuse(3, "sphere(1)", 1, {});
  refuse(2, "quadrilateral(0,0, 0,1, 1,1, 1,0)", 1, {});
  refuse(2, "quadrilateral(0,0, 1,0, 0.2,0.2, 0,1)", 1, {});
  refuse(2, "quadrilateral(0,0, 1,0, 2,0, 0,1)", 1, {});

  refuse(3, "cylinder(1, -2)", 1, {});
  refuse(3, "tube(2, 1, 3)", 1, {});
  refuse(3, "tube(1, 2)", 1, {});
  refuse(3, "sphere_octant(0, 1)", 1, {});
  refuse(3, "sphere_octant(1, 2)", 0, {2, 2, 2});
  refuse(2, "annulus_quarter(1, 1)", 1, {});
  refuse(2, "annulus_quarter(1, 2)", 1, {}, Split::five_tets);

  std::cout << is_generator("box(1,1,1)") << is_generator("/a/box(1).geo")
            << is_generator("box(1).msh") << is_generator(" rectangle (1, 2) ") << "\n";
}
