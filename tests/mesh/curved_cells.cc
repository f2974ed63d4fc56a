// Bodies with curved surfaces, of straight and of quadratic cells. Volumes against the exact ones:
// straight cells err by O(h^2), quadratic cells on a circle or sphere by O(h^4), and between circles
// of equal arcs by what the segments cut off, see arc_error. Where the nodes are:
// on the surface, at one place for all cells that share them, and each in the order of
// GeometryNodes, so nearest to the middle of its own edge, face or cell.

#include "../common/report.h"
#include "mesh_figures.h"

#include <isochor/mesh/cell_geometry.h>

#include <gmsh.h>

#include <fstream>

using namespace isochor;
using namespace isochor::testing;

const std::string meshes = ISOCHOR_SOURCE_DIR "/meshes/";

template <int dim>
using Distance = std::function<double(const dealii::Point<dim> &)>; ///< to the curved boundary

// What is known of a body.
template <int dim>
struct Body
{
  std::string                          source;
  std::vector<unsigned int>            cells; ///< of generators
  double                               size;  ///< of files
  double                               volume;
  std::map<std::string, double>        areas;
  std::map<std::string, Distance<dim>> distances; ///< of each boundary
  /// The radii and the axis of a ring; 0: not one.
  double       inner = 0, outer = 0;
  unsigned int axis = 0;
};

MeshRequest request(const std::string              &source,
                    const CellKind                  kind,
                    const unsigned int              order,
                    const double                    size,
                    const std::vector<unsigned int> cells = {},
                    const Split                     split = Split::six_tets)
{
  MeshRequest result;
  result.source         = source;
  result.kind           = kind;
  result.geometry_order = order;
  result.size           = size;
  result.cells          = cells;
  result.split          = split;
  return result;
}

// Of a disc whose circle is cut into n arcs: relative error of its area where each arc is replaced
// by its chord (order 1) or by the parabola through its ends and its middle (order 2). With t half
// an arc's angle, the segment's area is R^2 (t - sin t cos t), and the parabola's (Archimedes) 2/3 of
// chord 2 R sin t times height R (1 - cos t).
double arc_error(const unsigned int n, const unsigned int order)
{
  const double t        = M_PI / n;
  const double segment  = t - std::sin(t) * std::cos(t);
  const double parabola = 4. / 3 * std::sin(t) * (1 - std::cos(t));
  return ((order == 2 ? parabola : 0) - segment) / t;
}

// Into how many arcs is a full circle of this radius cut, in the plane 0 of the axis (3D)?
template <int dim>
unsigned int n_arcs(const RawMesh<dim> &mesh, const double radius, const unsigned int axis)
{
  unsigned int n = 0;
  for (const auto &p : mesh.vertices)
    if (dim == 2 || std::abs(p[axis]) < 1e-12)
      {
        double square = 0;
        for (unsigned int d = 0; d < dim; ++d)
          square += dim == 3 && d == axis ? 0 : p[d] * p[d];
        n += std::abs(std::sqrt(square) - radius) < 1e-9;
      }
  return dim == 2 ? 4 * (n - 1) : n; // in 2D here: a quarter
}

// The relative error of a ring's volume; @p sign 1: an upper bound of its size.
template <int dim>
double ring_error(const RawMesh<dim> &mesh, const Body<dim> &body, const int sign = -1)
{
  const auto error = [&](const double radius) {
    return radius == 0
               ? 0
               : radius * radius * arc_error(n_arcs(mesh, radius, body.axis), mesh.geometry.order);
  };
  return (error(body.outer) + sign * error(body.inner))
         / (body.outer * body.outer - body.inner * body.inner);
}

// Edges that two cells direct differently.
template <int dim>
std::size_t n_conflicts(const RawMesh<dim> &mesh)
{
  std::set<std::pair<unsigned int, unsigned int>> directed;
  std::size_t                                     n = 0;
  for (const auto &cell : mesh.cells)
    for (const auto &[a, b] : reference_edges<dim>(mesh.kind))
      directed.emplace(cell.vertices[a], cell.vertices[b]);
  for (const auto &[a, b] : directed)
    n += a < b && directed.count({b, a}) > 0;
  return n;
}

template <int dim>
void show_nodes(const RawMesh<dim> &mesh, const std::map<std::string, Distance<dim>> &distances)
{
  const auto  &middles   = node_vertices<dim>(mesh.kind);
  unsigned int n_swapped = 0;
  double       apart = 0, off_surface = 0;

  std::map<std::set<unsigned int>, dealii::Point<dim>> place_of_node;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    {
      const auto vertices = cell_vertices(mesh, c), nodes = cell_nodes(mesh, c);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          unsigned int nearest = 0;
          for (unsigned int j = 0; j < nodes.size(); ++j)
            if (nodes[i].distance(middle(middles[j], vertices))
                < nodes[i].distance(middle(middles[nearest], vertices)))
              nearest = j;
          n_swapped += nearest != i;

          std::set<unsigned int> key;
          for (unsigned int v = 0; v < vertices.size(); ++v)
            if (middles[i] >> v & 1)
              key.insert(mesh.cells[c].vertices[v]);
          const auto [known, is_new] = place_of_node.try_emplace(key, nodes[i]);
          apart                      = std::max(apart, known->second.distance(nodes[i]));
        }
    }
  // The nodes of a face: those whose vertices are among the face's.
  for (const auto &face : boundary_faces(mesh))
    {
      const auto distance = distances.find(
          face.boundary_id == unnamed_boundary ? "(unnamed)" : mesh.names[face.boundary_id]);
      if (distance == distances.end())
        continue;
      const std::set<unsigned int> corners(face.vertices.begin(), face.vertices.end());
      for (const auto &[key, place] : place_of_node)
        if (std::includes(corners.begin(), corners.end(), key.begin(), key.end()))
          off_surface = std::max(off_surface, std::abs(distance->second(place)));
    }
  std::cout << "  nodes out of order " << n_swapped << ", apart " << below(apart, 1e-14)
            << ", off the surface " << below(off_surface, 1e-10) << "\n";
}

// A family of two meshes, the second with half the size.
template <int dim>
void show(const Body<dim> &body, const CellKind kind, const unsigned int order, const Split split)
{
  const bool is_generator = !body.cells.empty();
  const auto member       = [&](const unsigned int refined) {
    auto n = body.cells;
    for (unsigned int &number : n)
      number *= refined;
    return make_raw_mesh<dim>(request(body.source, kind, order, body.size / refined, n, split));
  };
  const auto coarse = member(1), fine = member(2);
  const auto counts   = face_counts(fine);
  double     smallest = 1e300;
  for (const auto &cell : fine.cells)
    smallest = std::min(smallest, orientation(fine, cell));
  std::cout << std::filesystem::path(body.source).filename().string() << ", ";
  if (is_generator && dim == 3 && kind == CellKind::simplex)
    std::cout << split_names.name(split) << ", ";
  std::cout << cells_name(kind, dim) << " of order " << order << ": " << coarse.cells.size()
            << " and " << fine.cells.size() << " cells";
  if (is_generator) // of files it is gmsh's affair
    std::cout << ", min angle " << one_decimal(fine.quality.min_angle) << ", max aspect "
              << one_decimal(fine.quality.max_aspect);
  std::cout << "\n  surface listed " << yes(counts[0] == boundary_faces(fine).size())
            << ", faces of more than two cells " << counts[2]
            << ", all positive: " << yes(smallest > 0) << "\n  volume errs ";

  const double e1 = coarse.quality.total_volume / body.volume - 1;
  const double e2 = fine.quality.total_volume / body.volume - 1;
  if (is_generator)
    std::cout << "with order " << one_decimal(std::log2(e1 / e2)) << " ";
  if (body.outer == 0)
    ;
  else if (dim == 3 && !is_generator && kind == CellKind::simplex)
    // Flat or parabolic triangles all over the surface cut off more than strips of it.
    std::cout << "less than thrice what strips would: "
              << yes(std::abs(e2) < -3 * ring_error(fine, body, 1)) << " ";
  else
    std::cout << "as its arcs predict: " << below(std::abs(e2 - ring_error(fine, body)), 1e-12);
  std::cout << "\n";

  if (order == 2)
    return show_nodes(fine, body.distances);
  std::cout << "  area errs by";
  for (const auto &[name, area] : areas(fine))
    std::cout << " " << name << " "
              << below(std::abs(area / (body.areas.count(name) ? body.areas.at(name) : 0) - 1),
                       0.02);
  std::cout << "\n";
}

template <int dim>
void show(const Body<dim> &body)
{
  for (const auto kind : {CellKind::simplex, CellKind::hypercube})
    for (const unsigned int order : {1u, 2u})
      {
        show(body, kind, order, Split::six_tets);
        if (dim == 3 && kind == CellKind::simplex && !body.cells.empty())
          show(body, kind, order, Split::five_tets);
      }
}

// Distance from a cylinder around the x axis (axis 0) or z axis (2), or from a sphere (-1).
template <int dim>
Distance<dim> from_radius(const double radius, const int axis)
{
  return [=](const dealii::Point<dim> &p) {
    double square = 0;
    for (int d = 0; d < dim; ++d)
      square += d == axis ? 0 : p[d] * p[d];
    return std::sqrt(square) - radius;
  };
}

template <int dim>
Distance<dim> from_plane(const int axis, const double place)
{
  return [=](const dealii::Point<dim> &p) { return p[axis] - place; };
}

int main()
{
  const double pi = M_PI;
  show<2>({"annulus_quarter(1, 2)",
           {3, 5},
           0,
           3 * pi / 4,
           {{"inner", pi / 2}, {"outer", pi}, {"bottom", 1}, {"left", 1}},
           {{"inner", from_radius<2>(1, -1)},
            {"outer", from_radius<2>(2, -1)},
            {"bottom", from_plane<2>(1, 0)},
            {"left", from_plane<2>(0, 0)}},
           1,
           2});
  show<3>({"cylinder(2, 3)",
           {3, 2, 3},
           0,
           12 * pi,
           {{"left", 4 * pi}, {"right", 4 * pi}, {"side", 12 * pi}},
           {{"left", from_plane<3>(0, 0)},
            {"right", from_plane<3>(0, 3)},
            {"side", from_radius<3>(2, 0)}},
           0,
           2});
  show<3>({"tube(1, 2, 3)",
           {2, 3, 3},
           0,
           9 * pi,
           {{"left", 3 * pi}, {"right", 3 * pi}, {"inner", 6 * pi}, {"outer", 12 * pi}},
           {{"left", from_plane<3>(0, 0)},
            {"right", from_plane<3>(0, 3)},
            {"inner", from_radius<3>(1, 0)},
            {"outer", from_radius<3>(2, 0)}},
           1,
           2});
  show<3>({"sphere_octant(1, 2)",
           {2, 3},
           0,
           7 * pi / 6,
           {{"left", 3 * pi / 4},
            {"bottom", 3 * pi / 4},
            {"back", 3 * pi / 4},
            {"inner", pi / 2},
            {"outer", 2 * pi}},
           {{"left", from_plane<3>(0, 0)},
            {"bottom", from_plane<3>(1, 0)},
            {"back", from_plane<3>(2, 0)},
            {"inner", from_radius<3>(1, -1)},
            {"outer", from_radius<3>(2, -1)}}});

  // Through gmsh.
  show<2>({meshes + "quarter_annulus.geo",
           {},
           0.25,
           3 * pi / 4,
           {{"inner", pi / 2}, {"outer", pi}, {"bottom", 1}, {"left", 1}},
           {{"inner", from_radius<2>(1, -1)},
            {"outer", from_radius<2>(2, -1)},
            {"bottom", from_plane<2>(1, 0)},
            {"left", from_plane<2>(0, 0)}},
           1,
           2});
  const double ring = pi * (0.03 * 0.03 - 0.02 * 0.02);
  show<3>(
      {meshes + "inflated_tube.geo",
       {},
       0.012,
       0.08 * ring,
       {{"bottom", ring}, {"top", ring}, {"inner", 0.08 * 0.04 * pi}, {"outer", 0.08 * 0.06 * pi}},
       {{"bottom", from_plane<3>(2, 0)},
        {"top", from_plane<3>(2, 0.08)},
        {"inner", from_radius<3>(0.02, 2)},
        {"outer", from_radius<3>(0.03, 2)}},
       0.02,
       0.03,
       2});

  // Straight bodies: the same volume.
  for (const auto kind : {CellKind::simplex, CellKind::hypercube})
    {
      const auto box = make_raw_mesh<3>(request("box(1, 2, 3)", kind, 2, 0.5));
      const auto cook
          = make_raw_mesh<2>(request("quadrilateral(0,0, 48,44, 48,60, 0,44)", kind, 2, 8));
      const auto beam = make_raw_mesh<3>(request(meshes + "cantilever.geo", kind, 2, 0.05));
      std::cout << "straight, " << cells_name(kind, 3) << ": volume errs by "
                << below(std::abs(box.quality.total_volume / 6 - 1), 1e-13) << ", "
                << below(std::abs(cook.quality.total_volume / 1440 - 1), 1e-13) << ", "
                << below(std::abs(beam.quality.total_volume / 0.01 - 1), 1e-13) << "\n";
      show_nodes<3>(box, {{"right", from_plane<3>(0, 1)}});
      show_nodes<2>(cook, {{"right", from_plane<2>(0, 48)}});
      show_nodes<3>(beam, {{"right", from_plane<3>(0, 1)}});
    }

  // Unstructured: deal.II wants cells turned until they direct their edges alike, and their nodes
  // turn with them.
  const Folder folder;
  std::ofstream(folder.file("disc.geo"))
      << "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1}; Physical Curve(\"rim\") = {1};\n"
         "Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 1; Mesh.SubdivisionAlgorithm = 1;\n";
  std::ofstream(folder.file("cylinder.geo"))
      << "SetFactory(\"OpenCASCADE\"); Cylinder(1) = {0, 0, 0, 0, 0, 1, 1};\n"
         "Physical Surface(\"side\") = {1}; Mesh.SubdivisionAlgorithm = 2;\n";
  const auto disc = make_raw_mesh<2>(request(folder.file("disc.geo"), CellKind::hypercube, 2, 0.4));
  const auto cylinder
      = make_raw_mesh<3>(request(folder.file("cylinder.geo"), CellKind::hypercube, 2, 0.8));
  std::cout << "recombined disc: edges in conflict " << n_conflicts(disc) << ", volume errs by "
            << below(std::abs(disc.quality.total_volume / pi - 1), 1e-4) << "\n";
  show_nodes<2>(disc, {{"rim", from_radius<2>(1, -1)}});
  std::cout << "subdivided cylinder: edges in conflict " << n_conflicts(cylinder)
            << ", volume errs by " << below(std::abs(cylinder.quality.total_volume / pi - 1), 1e-3)
            << "\n";
  show_nodes<3>(cylinder, {{"side", from_radius<3>(1, 2)}});

  // A file that gmsh saved with second order, and a surface that looks down.
  for (const int hexahedra : {0, 1})
    {
      gmsh::initialize(0, nullptr, false);
      gmsh::option::setNumber("General.Terminal", 0);
      std::ofstream(folder.file("saved.geo"))
          << "hexahedra = " << hexahedra << "; Include \"" << meshes << "quarter_annulus.geo\";\n"
          << "Mesh.ElementOrder = 2; ReverseMesh Surface{1};\n";
      gmsh::open(folder.file("saved.geo"));
      gmsh::model::mesh::generate(2);
      gmsh::write(folder.file("saved.msh"));
      gmsh::finalize();
      const auto kind = hexahedra ? CellKind::hypercube : CellKind::simplex;
      const auto mesh = make_raw_mesh<2>(request(folder.file("saved.msh"), kind, 2, 0));
      const auto same = make_raw_mesh<2>(request(meshes + "quarter_annulus.geo", kind, 2, 0));
      std::cout << "saved, " << cells_name(kind, 2) << ": as many cells "
                << yes(mesh.cells.size() == same.cells.size()) << ", same volume "
                << yes(std::abs(mesh.quality.total_volume / same.quality.total_volume - 1) < 1e-12)
                << "\n";
      show_nodes<2>(mesh, {{"outer", from_radius<2>(2, -1)}});
    }
}
