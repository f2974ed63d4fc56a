#include <isochor/mesh/mesh_check.h>
#include <isochor/mesh/quality.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

namespace isochor
{
  namespace
  {
    template <int dim>
    const std::string cells_word = dim == 2 ? "triangles" : "tetrahedra";

    // Of longest edge to smallest height. Rounding makes flat cells of about 1e16; slivers that
    // someone means to compute on have hundreds or thousands.
    constexpr double degenerate_aspect = 1e9;

    template <int dim>
    using FaceVertices = std::array<unsigned int, dim>;

    template <int dim>
    struct Face
    {
      FaceVertices<dim> key;          ///< vertices, ascending
      bool              even = false; ///< is key, as oriented by the cell, an even permutation?
      std::size_t       cell = 0;
    };

    // Sort in place; true if the permutation was even.
    template <std::size_t n>
    bool sort_and_parity(std::array<unsigned int, n> &values)
    {
      bool even = true;
      for (std::size_t i = 1; i < n; ++i)
        for (std::size_t j = i; j > 0 && values[j] < values[j - 1]; --j, even = !even)
          std::swap(values[j], values[j - 1]);
      return even;
    }

    template <int dim>
    std::vector<Face<dim>> sorted_faces(const RawMesh<dim> &mesh)
    {
      std::vector<Face<dim>> faces;
      faces.reserve(mesh.cells.size() * (dim + 1));
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        for (unsigned int opposite = 0; opposite <= dim; ++opposite)
          {
            Face<dim>    face;
            unsigned int n = 0;
            for (unsigned int v = 0; v <= dim; ++v)
              if (v != opposite)
                face.key[n++] = mesh.cells[cell].vertices[v];
            face.even = (opposite % 2 == 0) == sort_and_parity(face.key);
            face.cell = cell;
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
      dealii::Point<dim> centre;
      for (const auto &vertex : cell_vertices(mesh, cell))
        centre += vertex / (dim + 1);
      std::ostringstream text;
      text.precision(4);
      text << "near (";
      for (unsigned int d = 0; d < dim; ++d)
        text << (d == 0 ? "" : ", ") << (std::abs(centre[d]) < 1e-12 ? 0. : centre[d]);
      text << ")";
      return text.str();
    }

    template <int dim>
    void check_shapes(const RawMesh<dim> &mesh, const std::string &origin)
    {
      std::vector<std::size_t> inverted, degenerate;
      for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
        {
          const CellShape shape = cell_shape<dim>(cell_vertices(mesh, cell));
          // Also true where a coordinate is not a number.
          if (!(shape.smallest_height * degenerate_aspect > shape.longest_edge))
            degenerate.push_back(cell);
          else if (shape.volume < 0)
            inverted.push_back(cell);
        }
      const auto fail = [&](const std::vector<std::size_t> &bad, const std::string &how) {
        throw UserError(origin + ": " + std::to_string(bad.size()) + " of "
                        + std::to_string(mesh.cells.size()) + " " + cells_word<dim> + " "
                        + (bad.size() == 1 ? "is " : "are ") + how + ", the first "
                        + near(mesh, bad.front()));
      };
      if (!degenerate.empty())
        fail(degenerate, "degenerate (no volume)");
      if (!inverted.empty())
        fail(inverted, "inverted (negative volume; wrong order of vertices)");
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
          else if (next - i > 2 || faces[i].even == faces[i + 1].even)
            throw UserError(origin + ": " + cells_word<dim> + " overlap "
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

    template <int dim>
    std::vector<dealii::CellData<dim - 1>> &boundary_faces(RawMesh<dim> &mesh)
    {
      if constexpr (dim == 2)
        return mesh.boundary.boundary_lines;
      else
        return mesh.boundary.boundary_quads;
    }
  } // namespace

  template <int dim>
  void check_and_complete(RawMesh<dim> &mesh, const std::string &origin)
  {
    if (mesh.cells.empty())
      throw UserError(origin + ": there are no " + cells_word<dim> + " in it");
    check_shapes(mesh, origin);

    const std::vector<Face<dim>>            surface = surface_of(mesh, origin);
    std::vector<dealii::types::boundary_id> ids(surface.size(), unnamed_boundary);
    for (const auto &named : boundary_faces(mesh))
      {
        FaceVertices<dim> key;
        std::copy_n(named.vertices.begin(), dim, key.begin());
        sort_and_parity(key);
        const std::string &name = mesh.names[named.boundary_id];
        const auto         face = std::lower_bound(surface.begin(),
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
        dealii::CellData<dim - 1> face(dim);
        std::copy_n(surface[i].key.begin(), dim, face.vertices.begin());
        face.boundary_id = ids[i];
        boundary_faces(mesh).push_back(face);
      }
  }

  template void check_and_complete<2>(RawMesh<2> &, const std::string &);
  template void check_and_complete<3>(RawMesh<3> &, const std::string &);
} // namespace isochor
