#include <isochor/mesh/cell_geometry.h>
#include <isochor/mesh/generator.h>
#include <isochor/mesh/gmsh_reader.h>

#include "cell_order.h"
#include "gmsh_elements.h"
#include "gmsh_session.h"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <unordered_map>

namespace isochor
{
  namespace
  {
    namespace fs = std::filesystem;

    using Tags = std::vector<std::size_t>;

    // Copies of what gmsh holds, with vertices numbered as they come.
    template <int dim>
    class Reader
    {
    public:
      Reader(const MeshRequest &request, const std::string &origin)
        : request(request)
        , origin(origin)
      {
        mesh.kind           = request.kind;
        mesh.geometry.order = request.geometry_order;
      }

      RawMesh<dim> read()
      {
        read_positions();
        read_cells();
        read_boundaries();
        return std::move(mesh);
      }

    private:
      // Of one entity: node numbers by type of element.
      using Elements = std::map<int, Tags>;

      const MeshRequest                                     &request;
      const std::string                                      origin;
      RawMesh<dim>                                           mesh;
      std::unordered_map<std::size_t, std::array<double, 3>> positions;
      std::unordered_map<std::size_t, unsigned int>          vertex_of_node;
      double                                                 extent = 0, height = 0; ///< x and y; z

      void read_positions()
      {
        Tags                nodes;
        std::vector<double> x, parameters;
        gmsh::model::mesh::getNodes(nodes, x, parameters);
        positions.reserve(nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i)
          positions[nodes[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
      }

      static std::vector<int> entities_of_group(const int dimension, const int group)
      {
        std::vector<int> entities;
        gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
        return entities;
      }

      static Elements elements_of_entity(const int dimension, const int entity)
      {
        std::vector<int>  types;
        std::vector<Tags> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
        Elements found;
        for (std::size_t i = 0; i < types.size(); ++i)
          if (!elements[i].empty())
            found[types[i]] = nodes[i];
        return found;
      }

      dealii::Point<dim> position(const std::size_t node)
      {
        const auto entry = positions.find(node);
        if (entry == positions.end())
          throw UserError(origin + ": a cell refers to node " + std::to_string(node)
                          + ", which does not exist");
        const auto        &x = entry->second;
        dealii::Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = x[d];
        extent = std::max({extent, std::abs(x[0]), std::abs(x[1])});
        height = std::max(height, std::abs(x[2]));
        return point;
      }

      unsigned int vertex(const std::size_t node)
      {
        const auto [entry, is_new] = vertex_of_node.try_emplace(node, mesh.vertices.size());
        if (is_new)
          mesh.vertices.push_back(position(node));
        return entry->second;
      }

      void read_cells()
      {
        gmsh::vectorpair groups, all;
        gmsh::model::getPhysicalGroups(groups, dim);
        gmsh::model::getEntities(all, dim);
        // Like gmsh when it saves: where groups are defined, only what is in one.
        std::set<int> entities;
        for (const auto &[d, group] : groups)
          for (const int entity : entities_of_group(dim, group))
            entities.insert(entity);
        if (groups.empty())
          for (const auto &[d, entity] : all)
            entities.insert(entity);

        std::vector<Elements>      parts;
        std::map<int, std::size_t> n_cells;
        for (const int entity : entities)
          {
            parts.push_back(elements_of_entity(dim, entity));
            for (const auto &[type, nodes] : parts.back())
              n_cells[type] += nodes.size() / ElementType(type).n_nodes;
          }
        check_types<dim>(n_cells, request, origin);
        for (const Elements &part : parts)
          for (const auto &[type, nodes] : part)
            add_cells(ElementType(type), nodes);
        if (dim == 2 && height > 1e-10 * extent)
          throw UserError(origin + ": a two-dimensional mesh must lie in the plane z = 0");
      }

      void add_cells(const ElementType &type, const Tags &nodes)
      {
        const auto  order = node_order<dim>(type, mesh.kind, mesh.geometry.order);
        const auto  n     = n_vertices(mesh.kind, dim);
        std::size_t first = mesh.cells.size();
        for (std::size_t i = 0; i < nodes.size(); i += order.size())
          {
            dealii::CellData<dim> cell(n);
            for (unsigned int v = 0; v < n; ++v)
              cell.vertices[v] = vertex(nodes[i + order[v]]);
            mesh.cells.push_back(cell);
            if (mesh.geometry.order == 2)
              for (const unsigned int place : order)
                mesh.geometry.points.push_back(position(nodes[i + place]));
          }
        if constexpr (dim == 2)
          face_upwards(first);
      }

      // A plane surface whose curves go clockwise has its normal downwards in gmsh, and all its
      // cells with it. That is no fault.
      void face_upwards(const std::size_t first)
      {
        const auto downwards = [&](const dealii::CellData<dim> &cell) {
          const auto &p = mesh.vertices[cell.vertices[0]];
          const auto  a = mesh.vertices[cell.vertices[1]] - p;
          const auto  b = mesh.vertices[cell.vertices[2]] - p;
          return a[0] * b[1] - a[1] * b[0] < 0;
        };
        if (!std::all_of(mesh.cells.begin() + first, mesh.cells.end(), downwards))
          return;
        std::vector<unsigned int> mirrored = {0, 2, 1, 3};
        mirrored.resize(n_vertices(mesh.kind, dim));
        for (std::size_t i = first; i < mesh.cells.size(); ++i)
          renumber_vertices(mesh, i, mirrored);
      }

      void read_boundaries()
      {
        gmsh::vectorpair groups;
        gmsh::model::getPhysicalGroups(groups, dim - 1);
        for (const auto &[d, group] : groups)
          {
            std::string name;
            gmsh::model::getPhysicalName(dim - 1, group, name);
            if (name.empty())
              continue;
            const auto id
                = std::find(mesh.names.begin(), mesh.names.end(), name) - mesh.names.begin();
            if (id == static_cast<std::ptrdiff_t>(mesh.names.size()))
              mesh.names.push_back(name);
            for (const int entity : entities_of_group(dim - 1, group))
              for (const auto &[type, nodes] : elements_of_entity(dim - 1, entity))
                add_faces(ElementType(type), nodes, id);
          }
        if (mesh.names.empty())
          throw UserError(origin + ": no boundary has a name"
                          + (groups.empty() ? "" : " (its physical groups have numbers only)")
                          + ". Name them in the .geo file, for instance: Physical "
                          + (dim == 2 ? "Curve" : "Surface") + "(\"left\") = {1};");
      }

      void
      add_faces(const ElementType &type, const Tags &nodes, const dealii::types::boundary_id id)
      {
        for (std::size_t i = 0; i < nodes.size(); i += type.n_nodes)
          {
            // gmsh's order: the check of the mesh looks for the set of vertices only.
            dealii::CellData<dim - 1> face(type.n_vertices);
            for (int v = 0; v < type.n_vertices; ++v)
              {
                const auto vertex = vertex_of_node.find(nodes[i + v]);
                if (vertex == vertex_of_node.end())
                  throw UserError(origin + ": boundary '" + mesh.names[id]
                                  + "' has faces that belong to no cell");
                face.vertices[v] = vertex->second;
              }
            face.boundary_id = id;
            boundary_faces(mesh).push_back(face);
          }
      }
    };

    std::string check_file(const std::string &path)
    {
      const std::string origin = "Mesh '" + path + "'";
      if (!fs::exists(path))
        throw UserError(origin + ": there is no such file");
      if (fs::is_directory(path))
        throw UserError(origin + ": that is a directory");
      const std::string ending = fs::path(path).extension();
      if (ending != ".geo" && ending != ".msh")
        {
          std::vector<std::string> calls;
          for (const GeneratorForm &form : generator_forms())
            calls.push_back(form.call);
          throw UserError(
              origin + ": a mesh is a .geo or .msh file of gmsh, or a generator: " + listed(calls));
        }
      if (!std::ifstream(path))
        throw UserError(origin + ": the file cannot be read");
      return ending;
    }

    // @p saved: a .msh file, into which gmsh puts only what is in a physical group.
    void
    check_dimension(const int found, const int dim, const bool saved, const std::string &origin)
    {
      if (found == dim)
        return;
      const std::string words[] = {"empty", "two-dimensional", "three-dimensional"};
      std::string       text    = origin + ": it is " + words[std::clamp(found - 1, 0, 2)]
                         + ", the scene is " + words[dim - 1];
      if (saved && found < dim)
        text += std::string(". With physical groups gmsh saves only what is in one; name the body "
                            "too: Physical ")
                + (dim == 2 ? "Surface" : "Volume") + "(\"body\") = {1};";
      throw UserError(text);
    }
  } // namespace

  namespace
  {
    /// Mend tetrahedra that their curved edges turn inside out, as far as gmsh can.
    void untangle()
    {
      gmsh::option::setNumber("Mesh.HighOrderThresholdMin", 0.01);
      gmsh::option::setNumber("Mesh.HighOrderPassMax", 3);
      try
        {
          gmsh::model::mesh::optimize("HighOrder");
        }
      catch (...) // thrown if a cell is left; the check of the mesh has better words
        {
        }
    }
  } // namespace

  template <int dim>
  RawMesh<dim> read_with_gmsh(const MeshRequest &request, const bool untangles)
  {
    const std::string origin = "Mesh '" + request.source + "'";
    const std::string ending = check_file(request.source);
    const GmshSession session;
    RawMesh<dim>      mesh;
    if (ending == ".geo")
      {
        open_geometry(session, request, origin);
        session.guarded(origin, [&] {
          check_dimension(gmsh::model::getDimension(), dim, false, origin);
          // The file may have asked for more.
          gmsh::option::setNumber("General.NumThreads", 1);
          for (const auto option : {"1D", "2D", "3D"})
            gmsh::option::setNumber("Mesh.MaxNumThreads" + std::string(option), 1);
          gmsh::model::mesh::generate(dim);
          if (request.geometry_order == 2)
            {
              gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 0);
              gmsh::model::mesh::setOrder(2);
              if (untangles)
                untangle();
            }
        });
      }
    else
      session.guarded(origin, [&] {
        gmsh::open(request.source);
        check_dimension(gmsh::model::getDimension(), dim, true, origin);
      });
    session.guarded(origin, [&] { mesh = Reader<dim>(request, origin).read(); });
    return mesh;
  }

  template RawMesh<2> read_with_gmsh<2>(const MeshRequest &, bool);
  template RawMesh<3> read_with_gmsh<3>(const MeshRequest &, bool);
} // namespace isochor
