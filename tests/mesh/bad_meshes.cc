// Every mesh that cannot be used, and what the user is told.

#include "mesh_figures.h"

#include <fstream>

using namespace isochor;
using namespace isochor::testing;

const Folder folder;

template <int dim>
void refuse(const std::string &title,
            const std::string &name,
            const std::string &text,
            const double       size  = 0,
            const CellKind     kind  = CellKind::simplex,
            const unsigned int order = 1)
{
  if (!text.empty())
    std::ofstream(folder.file(name)) << text;
  print_error(title, folder, [&] {
    make_raw_mesh<dim>({folder.file(name), size, {}, Split::six_tets, kind, order});
  });
}

// A .msh 2.2 file. Elements are "type tags... nodes" without their number.
std::string msh(const std::vector<std::string> &names,
                const std::vector<std::string> &nodes,
                const std::vector<std::string> &elements)
{
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (!names.empty())
    {
      text += "$PhysicalNames\n" + std::to_string(names.size()) + "\n";
      for (const auto &name : names)
        text += name + "\n";
      text += "$EndPhysicalNames\n";
    }
  text += "$Nodes\n" + std::to_string(nodes.size()) + "\n";
  for (std::size_t i = 0; i < nodes.size(); ++i)
    text += std::to_string(i + 1) + " " + nodes[i] + "\n";
  text += "$EndNodes\n$Elements\n" + std::to_string(elements.size()) + "\n";
  for (std::size_t i = 0; i < elements.size(); ++i)
    text += std::to_string(i + 1) + " " + elements[i] + "\n";
  return text + "$EndElements\n";
}

int main()
{
  const std::string box    = "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\n";
  const std::string name   = "Physical Surface(\"left\") = {1};\n";
  const std::string square = "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};\n"
                             "Physical Curve(\"bottom\") = {1};\n";

  refuse<3>("missing", "missing.geo", "");
  std::filesystem::create_directory(folder.path / "folder.msh");
  refuse<3>("directory", "folder.msh", "");
  refuse<3>("other ending", "mesh.stl", "solid\n");
  refuse<3>("syntax", "syntax.geo", box + "Box(2) = ;\n");
  refuse<3>("syntax, with size", "syntax.geo", "", 0.5);
  refuse<3>("undefined point", "point.geo", "Point(1) = {0, 0, 0}; Line(1) = {1, 2};\n");
  refuse<3>("blank geometry", "blank.geo", "\n");
  refuse<3>("blank mesh", "blank.msh", "\n");
  refuse<3>("not a mesh", "text.msh", "Dear reader,\n");
  refuse<3>("cut off", "cut.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 7 1 7\n");
  refuse<3>("plane in 3D", "square.geo", square);
  refuse<2>("body in 2D", "box.geo", box + name);
  refuse<2>("out of plane",
            "lifted.geo",
            "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 1, 1, 1};\n"
            "Physical Curve(\"bottom\") = {1};\n");
  refuse<3>("no names", "nameless.geo", box);
  refuse<2>(
      "no names, plane", "nameless2.geo", "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1};\n");
  refuse<3>("numbers only", "numbers.geo", box + "Physical Surface(7) = {1};\n");
  refuse<3>("second order", "quadratic.geo", box + name + "Mesh.ElementOrder = 2;\n");
  refuse<3>("hexahedra",
            "hexahedra.geo",
            box + name
                + "Transfinite Curve{:} = 3; Transfinite Surface{:}; Transfinite Volume{:};\n"
                  "Recombine Surface{:};\n");
  refuse<3>("prisms",
            "prisms.geo",
            "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};\n"
            "Extrude{0, 0, 1}{ Surface{1}; Layers{2}; Recombine; }\n"
                + name);
  refuse<2>("quadrilaterals", "quads.geo", square + "Recombine Surface{:};\n");
  refuse<3>(
      "two parts",
      "parts.geo",
      "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {2, 0, 0, 1, 1, 1};\n"
          + name,
      0.5);
  refuse<3>(
      "touching, not joined",
      "touching.geo",
      "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 1, 1, 1};\n"
          + name,
      0.5);
  refuse<3>("two names", "twice.geo", box + name + "Physical Surface(\"again\") = {1, 2};\n", 0.5);
  refuse<3>(
      "inner face",
      "inner.geo",
      "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 1, 1, 1};\n"
      "BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n"
      "middle() = Surface In BoundingBox{.9, -.1, -.1, 1.1, 1.1, 1.1};\n"
      "Physical Surface(\"middle\") = middle();\n",
      0.5);
  refuse<3>(
      "face of a volume that is left out",
      "outside.geo",
      "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {2, 0, 0, 1, 1, 1};\n"
      "Physical Surface(\"left\") = {1, 7}; Physical Volume(\"body\") = {1};\n",
      0.5);

  const std::vector<std::string> nodes = {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 1 1", "0.5 0.5 0"};
  const std::vector<std::string> names = {"2 1 \"left\""};
  const std::string              face  = "2 2 1 1 1 3 4";
  const std::string              tet   = "4 2 0 1 1 2 3 4";
  refuse<3>("one tetrahedron (good)", "one.msh", msh(names, nodes, {face, tet}));
  refuse<3>("inverted", "inverted.msh", msh(names, nodes, {face, tet, "4 2 0 1 2 4 3 5"}));
  refuse<3>("inverted", "mirrored.msh", msh(names, nodes, {face, "4 2 0 1 1 3 2 4"}));
  refuse<3>("degenerate", "flat.msh", msh(names, nodes, {face, tet, "4 2 0 1 1 2 3 6"}));
  refuse<3>(
      "vertex twice in a cell", "twice.msh", msh(names, nodes, {face, tet, "4 2 0 1 1 2 3 3"}));
  refuse<3>("cell twice", "double.msh", msh(names, nodes, {face, tet, tet}));
  refuse<3>("overlap",
            "overlap.msh",
            msh(names,
                {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "0.1 0.1 0.5"},
                {face, tet, "4 2 0 1 1 2 3 5"}));
  refuse<3>("joined by an edge",
            "hinge.msh",
            msh(names,
                {"0 0 0", "1 0 0", "0 1 0", "0 0 1", "-1 0 0", "0 -1 0"},
                {face, tet, "4 2 0 1 1 4 5 6"}));
  refuse<3>("node that is not there", "node.msh", msh(names, nodes, {face, "4 2 0 1 1 2 3 9"}));
  refuse<3>("face with two names",
            "faces.msh",
            msh({"2 1 \"left\"", "2 2 \"back\""}, nodes, {face, "2 2 2 2 1 3 4", tet}));
  refuse<3>("surfaces only, as gmsh saves them", "surface.msh", msh(names, nodes, {face}));
  refuse<2>("inverted triangle",
            "fold.msh",
            msh({"1 1 \"left\""},
                {"0 0 0", "1 0 0", "0 1 0", "1 1 0"},
                {"1 2 1 1 1 3", "2 2 0 1 1 2 3", "2 2 0 1 2 3 4"}));
  refuse<3>("coordinate that is no number",
            "nan.msh",
            msh(names, {"0 0 0", "nan 0 0", "0 1 0", "0 0 1"}, {face, tet}));

  // Another kind of cells than the element is made for, or several kinds.
  const auto        hex       = CellKind::hypercube;
  const std::string recombine = "Transfinite Curve{:} = 3; Transfinite Surface{:}; "
                                "Transfinite Volume{:}; Recombine Surface{:};\n";
  refuse<3>("tetrahedra for a hexahedral element", "tets.geo", box + name, 0.5, hex);
  refuse<3>("hexahedra on request (good)",
            "both.geo",
            "DefineConstant[ hexahedra = 0 ];\n" + box + name + "If (hexahedra)\n" + recombine
                + "EndIf\n",
            0,
            hex);
  refuse<3>("the same as tetrahedra (good)", "both.geo", "");
  refuse<3>("constant without effect",
            "idle.geo",
            "DefineConstant[ hexahedra = 0 ];\n" + box + name,
            0.5,
            hex);
  refuse<3>("constant without effect",
            "stuck.geo",
            "DefineConstant[ hexahedra = 0 ];\n" + box + name + recombine);
  refuse<2>("triangles for a quadrilateral element", "plane.geo", square, 0.5, hex);
  refuse<3>("a tetrahedron for a hexahedral element", "one.msh", "", 0, hex);
  const std::vector<std::string> cube
      = {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1", "0.5 0.5 2"};
  const std::string left = "3 2 1 1 1 4 8 5", brick = "5 2 0 1 1 2 3 4 5 6 7 8";
  refuse<3>("one hexahedron (good)", "cube.msh", msh(names, cube, {left, brick}), 0, hex);
  refuse<3>("a hexahedron for a tetrahedral element", "cube.msh", "");
  refuse<3>("mixed", "mixed.msh", msh(names, cube, {left, brick, "7 2 0 1 5 6 7 8 9"}), 0, hex);
  refuse<3>("mixed, for tetrahedra", "mixed.msh", "");

  // Bad hexahedra and quadrilaterals.
  refuse<3>(
      "inverted", "inside_out.msh", msh(names, cube, {left, "5 2 0 1 5 6 7 8 1 2 3 4"}), 0, hex);
  auto dented = cube;
  dented[6]   = "0.3 0.3 0.3";
  refuse<3>("inverted at one vertex", "dented.msh", msh(names, dented, {left, brick}), 0, hex);
  auto flat = cube;
  flat[6]   = "1 1 0";
  refuse<3>("flat at a vertex", "flat_vertex.msh", msh(names, flat, {left, brick}), 0, hex);
  refuse<3>("cell twice", "twice_hex.msh", msh(names, cube, {left, brick, brick}), 0, hex);
  refuse<2>("quadrilateral with a reentrant corner",
            "arrow.msh",
            msh({"1 1 \"left\""},
                {"0 0 0", "1 0 0", "0.2 0.2 0", "0 1 0"},
                {"1 2 1 1 4 1", "3 2 0 1 1 2 3 4"}),
            0,
            hex);

  // Geometry order.
  refuse<3>("second order on request (good)", "second.geo", box + name, 0.5, CellKind::simplex, 2);
  refuse<3>("and by the file too (good)", "quadratic.geo", "", 0.5, CellKind::simplex, 2);
  refuse<3>("straight .msh, curved cells wanted", "one.msh", "", 0, CellKind::simplex, 2);
  refuse<3>("third order", "cubic.geo", box + name + "Mesh.ElementOrder = 3;\n");
  const std::vector<std::string> quad8
      = {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0.5 0 0", "1 0.5 0", "0.5 1 0", "0 0.5 0"};
  refuse<2>("quadrilateral of 8 nodes",
            "quad8.msh",
            msh({"1 1 \"left\""}, quad8, {"8 2 1 1 4 1 8", "16 2 0 1 1 2 3 4 5 6 7 8"}),
            0,
            hex,
            2);
  // One edge's node pushed past the opposite vertex: the edge from (1, 0) to (0, 1) as a parabola
  // through (0.1, 0.1). At its ends the determinant is 4 * 0.1 - 1 < 0 (and 2 * area = 1 if straight).
  const auto curved = [](const std::string &node) {
    return msh({"1 1 \"outer\""},
               {"0 0 0", "1 0 0", "0 1 0", "0.5 0 0", node, "0 0.5 0"},
               {"8 2 1 1 2 3 5", "9 2 0 1 1 2 3 4 5 6"});
  };
  refuse<2>("curved (good)", "curved.msh", curved("0.6 0.6 0"), 0, CellKind::simplex, 2);
  refuse<2>("inverted by a curved edge", "dent.msh", curved("0.1 0.1 0"), 0, CellKind::simplex, 2);
  // Single tetrahedra through a thin wall.
  refuse<3>("curved cells too large for a thin wall",
            "thin.geo",
            "SetFactory(\"OpenCASCADE\"); Cylinder(1) = {0, 0, 0, 0, 0, 1, 1};\n"
            "Cylinder(2) = {0, 0, 0, 0, 0, 1, 0.99};\n"
            "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n"
            "outer() = Surface In BoundingBox{-1.1, -1.1, -0.1, 1.1, 1.1, 1.1};\n"
            "Physical Surface(\"skin\") = outer();\n",
            1,
            CellKind::simplex,
            2);
}
