#include <isochor/mesh/mesh_check.h>
#include <isochor/mesh/quality.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

namespace isochor
{
  namespace
  {
    // Of longest edge to smallest height. Rounding makes flat cells of about 1e16; slivers that
    // someone means to compute on have hundreds or thousands.
    constexpr double degenerate_aspect = 1e9;

    template <int dim>
    std::string cells_word(const RawMesh<dim> &mesh)
    {
      return cells_name(mesh.kind, dim);
    }

    // Padded with the largest number where a face has fewer vertices.
    template <int dim>
    using FaceVertices = std::array<unsigned int, 2 * (dim - 1)>;

    template <int dim>
    struct Face
    {
      FaceVertices<dim> key;       ///< vertices, ascending
      bool         even   = false; ///< does the cell see its smallest, then its smaller neighbour?
      unsigned int across = 0;     ///< of four vertices the one opposite to the smallest
      std::size_t  cell   = 0;
      unsigned int number = 0; ///< which of the cell's faces
    };

    template <int dim>
    FaceVertices<dim> sorted(const std::vector<unsigned int> &vertices)
    {
      FaceVertices<dim> key;
      key.fill(dealii::numbers::invalid_unsigned_int);
      std::copy(vertices.begin(), vertices.end(), key.begin());
      std::sort(key.begin(), key.end());
      return key;
    }

    // Each face's vertices, going round it counterclockwise as seen from outside.
    template <int dim>
    std::vector<std::vector<unsigned int>> face_cycles(const CellKind kind)
    {
      auto faces = reference_faces<dim>(kind);
      for (auto &face : faces)
        {
          if (face.size() == 4)
            std::swap(face[2], face[3]);
          std::array<dealii::Point<dim>, dim> corner;
          for (unsigned int i = 0; i < dim; ++i)
            corner[i] = reference_vertex<dim>(kind, face[i]);
          dealii::Tensor<2, dim> frame;
          frame[0] = corner[0] - reference_centre<dim>(kind);
          for (unsigned int i = 1; i < dim; ++i)
            frame[i] = corner[i] - corner[0];
          if (determinant(frame) < 0)
            std::reverse(face.begin(), face.end());
        }
      return faces;
    }

    template <int dim>
    std::vector<Face<dim>> sorted_faces(const RawMesh<dim> &mesh)
    {
      const auto             cycles = face_cycles<dim>(mesh.kind);
      std::vector<Face<dim>> faces;
      faces.reserve(mesh.cells.size() * cycles.size());
      std::vector<unsigned int> cycle;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        for (unsigned int number = 0; number < cycles.size(); ++number)
          {
            cycle.clear();
            for (const unsigned int v : cycles[number])
              cycle.push_back(mesh.cells[cell].vertices[v]);
            std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
            Face<dim> face;
            face.key    = sorted<dim>(cycle);
            face.even   = dim == 2 ? cycle[0] == mesh.cells[cell].vertices[cycles[number][0]]
                                   : cycle[1] < cycle.back();
            face.across = cycle.size() == 4 ? cycle[2] : 0;
            face.cell   = cell;
            face.number = number;
            faces.push_back(face);
          }
      std::sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
        return a.key != b.key ? a.key < b.key : a.cell < b.cell;
      });
      return faces;
    }

    template <int dim>
    std::string near(const RawMesh<dim> &mesh, const std::size_t cell)
    {
      const auto         vertices = cell_vertices(mesh, cell);
      dealii::Point<dim> centre;
      for (const auto &vertex : vertices)
        centre += vertex / static_cast<double>(vertices.size());
      std::ostringstream text;
      text.precision(4);
      text << "near (";
      for (unsigned int d = 0; d < dim; ++d)
        text << (d == 0 ? "" : ", ") << (std::abs(centre[d]) < 1e-12 ? 0. : centre[d]);
      text << ")";
      return text.str();
    }

    // "3 of 20 hexahedra are <how>, the first near (...)".
    template <int dim>
    std::string
    complaint(const RawMesh<dim> &mesh, const std::vector<std::size_t> &bad, const std::string &how)
    {
      return std::to_string(bad.size()) + " of " + std::to_string(mesh.cells.size()) + " "
             + cells_word(mesh) + " " + (bad.size() == 1 ? "is " : "are ") + how + ", the first "
             + near(mesh, bad.front());
    }

    // Where the sign of the Jacobian determinant is looked at: vertices, middles of edges and
    // faces, and a fine quadrature's points inside.
    template <int dim>
    CellMap<dim> sampled_map(const CellKind kind, const unsigned int order)
    {
      const auto quadratic = make_shape_functions<dim>(kind, {Family::lagrange, 2});
      std::vector<dealii::Point<dim>> points;
      for (unsigned int i = 0; i < quadratic->n_nodes(); ++i)
        points.push_back(quadratic->node(i));
      const auto inside = kind == CellKind::simplex
                              ? dealii::Quadrature<dim>(dealii::QGaussSimplex<dim>(3))
                              : dealii::Quadrature<dim>(dealii::QGauss<dim>(3));
      points.insert(points.end(), inside.get_points().begin(), inside.get_points().end());
      return CellMap<dim>(kind, order, points);
    }

    // Written so that a coordinate that is not a number fails.
    template <int dim>
    bool is_positive(const CellMap<dim> &map, const std::vector<dealii::Point<dim>> &nodes)
    {
      for (unsigned int q = 0; q < map.n_points(); ++q)
        if (!(map.determinant(q, nodes) > 0))
          return false;
      return true;
    }

    // Of the cells with straight edges.
    template <int dim>
    void check_shapes(const RawMesh<dim> &mesh, const std::string &origin)
    {
      const bool               is_simplex = mesh.kind == CellKind::simplex;
      const CellMap<dim>       map        = sampled_map<dim>(mesh.kind, 1);
      std::vector<std::size_t> inverted, degenerate;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        {
          const auto      vertices = cell_vertices(mesh, cell);
          const CellShape shape    = cell_shape(mesh.kind, vertices);
          // Also true where a coordinate is not a number.
          if (!(shape.smallest_height * degenerate_aspect > shape.longest_edge))
            degenerate.push_back(cell);
          else if (is_simplex ? shape.volume < 0 : !is_positive(map, vertices))
            inverted.push_back(cell);
        }
      if (!degenerate.empty())
        throw UserError(
            origin + ": "
            + complaint(mesh,
                        degenerate,
                        is_simplex ? "degenerate (no volume)" : "degenerate (flat at a vertex)"));
      if (!inverted.empty())
        throw UserError(origin + ": "
                        + complaint(mesh,
                                    inverted,
                                    is_simplex
                                        ? "inverted (negative volume; wrong order of vertices)"
                                        : "inverted (not convex, or wrong order of vertices)"));
    }

    // The named boundary that shares most vertices with the cell: a face, an edge, or none.
    template <int dim>
    std::string touched_boundary(const RawMesh<dim> &mesh, const std::size_t cell)
    {
      const auto &vertices = mesh.cells[cell].vertices;
      std::size_t most     = 1;
      std::string name;
      for (const auto &face : boundary_faces(mesh))
        {
          std::size_t shared = 0;
          for (const unsigned int v : face.vertices)
            shared += std::count(vertices.begin(), vertices.end(), v);
          if (face.boundary_id != unnamed_boundary && shared > most)
            {
              most = shared;
              name = mesh.names[face.boundary_id];
            }
        }
      return name;
    }

    template <int dim>
    void check_curved(const RawMesh<dim> &mesh, const std::string &origin)
    {
      if (mesh.geometry.points.size()
          != mesh.cells.size() * n_geometry_nodes<dim>(mesh.kind, mesh.geometry.order))
        throw std::logic_error("a mesh of wrong geometry order");
      const CellMap<dim>       map = sampled_map<dim>(mesh.kind, mesh.geometry.order);
      std::vector<std::size_t> inverted;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        if (!is_positive(map, cell_nodes(mesh, cell)))
          inverted.push_back(cell);
      if (inverted.empty())
        return;
      const std::string name = touched_boundary(mesh, inverted.front());
      throw UserError(origin + ": " + complaint(mesh, inverted, "inverted by their curved edges")
                      + (name.empty() ? "" : ", at boundary '" + name + "'")
                      + "; choose a smaller Mesh size, or Geometry order = 1 (straight edges)");
    }

    // The faces of one cell only. Neighbours must share whole faces and lie on both sides.
    template <int dim>
    std::vector<Face<dim>> surface_of(const RawMesh<dim> &mesh, const std::string &origin)
    {
      const std::vector<Face<dim>> faces = sorted_faces(mesh);
      std::vector<Face<dim>>       surface;
      std::vector<std::size_t>     parent(mesh.cells.size());
      std::iota(parent.begin(), parent.end(), 0);
      const auto root = [&](std::size_t cell) {
        while (parent[cell] != cell)
          cell = parent[cell] = parent[parent[cell]];
        return cell;
      };

      for (std::size_t i = 0, next; i < faces.size(); i = next)
        {
          next = i + 1;
          while (next < faces.size() && faces[next].key == faces[i].key)
            ++next;
          if (next - i == 1)
            surface.push_back(faces[i]);
          else if (next - i > 2 || faces[i].even == faces[i + 1].even
                   || faces[i].across != faces[i + 1].across)
            throw UserError(origin + ": " + cells_word(mesh) + " overlap "
                            + near(mesh, faces[i].cell) + "; is a part of the body meshed twice?");
          else
            parent[root(faces[i].cell)] = root(faces[i + 1].cell);
        }

      std::size_t n_parts = 0, other = 0;
      for (std::size_t cell = 0; cell < parent.size(); ++cell)
        if (root(cell) == cell)
          {
            ++n_parts;
            if (cell != root(0))
              other = cell;
          }
      if (n_parts > 1)
        throw UserError(origin + ": the body is in " + std::to_string(n_parts)
                        + " parts that share no faces; one lies " + near(mesh, std::size_t(0))
                        + ", another " + near(mesh, other)
                        + ". Parts that should touch need common "
                        + (dim == 2 ? "curves" : "surfaces")
                        + " (in a .geo file with OpenCASCADE: BooleanFragments; else: Coherence)");
      return surface;
    }
  } // namespace

  template <int dim>
  void check_and_complete(RawMesh<dim> &mesh, const std::string &origin)
  {
    if (mesh.cells.empty())
      throw UserError(origin + ": there are no " + cells_word(mesh) + " in it");
    check_shapes(mesh, origin);

    const std::vector<Face<dim>>            surface = surface_of(mesh, origin);
    std::vector<dealii::types::boundary_id> ids(surface.size(), unnamed_boundary);
    for (const auto &named : boundary_faces(mesh))
      {
        const FaceVertices<dim> key  = sorted<dim>(named.vertices);
        const std::string      &name = mesh.names[named.boundary_id];
        const auto              face = std::lower_bound(surface.begin(),
                                           surface.end(),
                                           key,
                                           [](const auto &a, const auto &b) { return a.key < b; });
        if (face == surface.end() || face->key != key)
          throw UserError(origin + ": boundary '" + name
                          + "' has faces that are not on the surface of the body (inside it, or "
                            "on a part that is not meshed)");
        auto &id = ids[face - surface.begin()];
        if (id != unnamed_boundary && id != named.boundary_id)
          throw UserError(origin + ": boundaries '" + mesh.names[id] + "' and '" + name
                          + "' have a face in common, " + near(mesh, face->cell)
                          + "; a face belongs to one boundary");
        id = named.boundary_id;
      }

    boundary_faces(mesh).clear();
    for (std::size_t i = 0; i < surface.size(); ++i)
      {
        const auto               &vertices = reference_faces<dim>(mesh.kind)[surface[i].number];
        dealii::CellData<dim - 1> face(vertices.size());
        for (unsigned int v = 0; v < vertices.size(); ++v)
          face.vertices[v] = mesh.cells[surface[i].cell].vertices[vertices[v]];
        face.boundary_id = ids[i];
        boundary_faces(mesh).push_back(face);
      }
    if (mesh.geometry.order > 1)
      check_curved(mesh, origin);
  }

  template void check_and_complete<2>(RawMesh<2> &, const std::string &);
  template void check_and_complete<3>(RawMesh<3> &, const std::string &);
} // namespace isochor
