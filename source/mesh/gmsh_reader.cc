#include <isochor/mesh/gmsh_reader.h>

#include <gmsh.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <unordered_map>

#include <unistd.h>

// gmsh brings the OpenMP runtime along and sets its number of threads to one for good. Weak, so that
// nothing depends on OpenMP where gmsh is built without it.
extern "C"
{
  int  omp_get_max_threads() __attribute__((weak));
  void omp_set_num_threads(int) __attribute__((weak));
}

namespace isochor
{
  namespace
  {
    namespace fs = std::filesystem;

    template <int dim>
    const std::string cells_word = dim == 2 ? "triangles" : "tetrahedra";

    // gmsh's numbers of first-order simplices by dimension: line, triangle, tetrahedron.
    constexpr std::array<int, 4> simplex_type = {15, 1, 2, 4};

    // gmsh from start to end: silent, one thread, a log instead of a terminal. A static: gmsh is one
    // global state. What gmsh throws is a std::string, which nobody else would catch.
    class Session
    {
    public:
      Session()
        : threads(omp_get_max_threads ? omp_get_max_threads() : 0)
        , locale(std::setlocale(LC_ALL, nullptr))
      {
        // No ~/.gmshrc: the mesh depends on the file and the size alone.
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.NumThreads", 1);
        gmsh::option::setNumber("Mesh.RandomSeed", 1);
        gmsh::logger::start();
      }
      ~Session()
      {
        try
          {
            gmsh::logger::stop();
            gmsh::finalize();
          }
        catch (...)
          {
          }
        if (omp_set_num_threads && threads > 0)
          omp_set_num_threads(threads);
        std::setlocale(LC_ALL, locale.c_str()); // gmsh takes the user's
      }
      Session(const Session &)            = delete;
      Session &operator=(const Session &) = delete;

      // Run @p action; what gmsh complains of becomes a UserError.
      template <typename Action>
      void guarded(const std::string &origin, const Action &action) const
      {
        std::string message;
        try
          {
            action();
            return;
          }
        catch (const std::string &text)
          {
            message = text;
          }
        catch (const UserError &)
          {
            throw;
          }
        catch (const std::exception &error)
          {
            message = error.what();
          }
        catch (...)
          {
          }
        if (message.empty())
          message = last_error();
        throw UserError(origin + ": gmsh says: " + message);
      }

    private:
      static std::string last_error()
      {
        std::vector<std::string> log;
        gmsh::logger::get(log);
        const std::string mark = "Error: ";
        for (auto line = log.rbegin(); line != log.rend(); ++line)
          if (line->rfind(mark, 0) == 0)
            return line->substr(mark.size());
        return "(nothing)";
      }

      int         threads;
      std::string locale;
    };

    // A file that is removed at the end of its scope.
    class TemporaryFile
    {
    public:
      TemporaryFile(const std::string &text, const std::string &suffix)
      {
        std::string name   = (fs::temp_directory_path() / ("isochor-XXXXXX" + suffix)).string();
        const int   handle = mkstemps(name.data(), suffix.size());
        if (handle < 0)
          throw UserError("cannot write a temporary file in '" + fs::temp_directory_path().string()
                          + "'");
        close(handle);
        path = name;
        std::ofstream(path) << text;
      }
      ~TemporaryFile()
      {
        std::error_code ignored;
        fs::remove(path, ignored);
      }
      TemporaryFile(const TemporaryFile &)            = delete;
      TemporaryFile &operator=(const TemporaryFile &) = delete;

      std::string path;
    };

    // Does the .geo file let its parameter `size` be set from outside?
    bool has_size_parameter(const std::string &path)
    {
      std::ifstream     file(path);
      std::stringstream text;
      text << file.rdbuf();
      std::string source = text.str();
      // Comments first: the second pattern must not see a DefineConstant that is out of use.
      // (Not by std::regex: it recurses per character and overflows the stack on long files.)
      for (std::size_t begin = 0; (begin = source.find('/', begin)) != std::string::npos;)
        {
          std::size_t end = std::string::npos;
          if (source.compare(begin, 2, "//") == 0)
            end = source.find('\n', begin);
          else if (source.compare(begin, 2, "/*") == 0)
            end = source.find("*/", begin + 2) == std::string::npos
                      ? std::string::npos
                      : source.find("*/", begin + 2) + 2;
          else
            {
              ++begin;
              continue;
            }
          source.replace(begin, end == std::string::npos ? end : end - begin, " ");
        }
      static const std::regex size(R"((^|[\s,\[])size\s*(=|,|$))");
      for (std::size_t begin = 0;
           (begin = source.find("DefineConstant", begin)) != std::string::npos;
           ++begin)
        {
          const std::size_t open  = source.find('[', begin);
          const std::size_t close = source.find(']', begin);
          if (open < close && close != std::string::npos
              && std::regex_search(source.substr(open + 1, close - open - 1), size))
            return true;
        }
      return false;
    }

    // Through a file of ours that includes the user's. A constant that exists before DefineConstant
    // wins; given on gmsh's command line (-setnumber) it would outlive gmsh::finalize(). And a last
    // line without a newline is lost if gmsh 4.8 opens the file itself, an endless loop if it
    // merges it, but sound if it includes it.
    void
    open_geometry(const Session &session, const MeshRequest &request, const std::string &origin)
    {
      if (request.source.find('"') != std::string::npos)
        throw UserError(origin + ": gmsh takes no double quotes in file names");
      const bool         sized = request.size > 0;
      const bool         named = sized && has_size_parameter(request.source);
      std::ostringstream text;
      text.precision(17);
      if (named)
        text << "size = " << request.size << ";\n";
      text << "Include \"" << fs::absolute(request.source).string() << "\";\n";
      const TemporaryFile wrapper(text.str(), ".geo");
      session.guarded(origin, [&] {
        gmsh::open(wrapper.path);
        if (sized && !named)
          {
            gmsh::option::setNumber("Mesh.MeshSizeMin", request.size);
            gmsh::option::setNumber("Mesh.MeshSizeMax", request.size);
          }
      });
    }

    // Copies of what gmsh holds, with vertices numbered as they come.
    template <int dim>
    class Reader
    {
    public:
      Reader(const std::string &origin)
        : origin(origin)
      {
      }

      RawMesh<dim> read()
      {
        read_positions();
        read_cells();
        read_boundaries();
        return std::move(mesh);
      }

    private:
      using Tags     = std::vector<std::size_t>;
      using Entities = std::vector<int>;

      const std::string                                      origin;
      RawMesh<dim>                                           mesh;
      std::unordered_map<std::size_t, std::array<double, 3>> positions;
      std::unordered_map<std::size_t, unsigned int>          vertex_of_node;

      void read_positions()
      {
        Tags                nodes;
        std::vector<double> x, parameters;
        gmsh::model::mesh::getNodes(nodes, x, parameters);
        positions.reserve(nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i)
          positions[nodes[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
      }

      static Entities entities_of_group(const int dimension, const int group)
      {
        Entities entities;
        gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
        return entities;
      }

      // Node numbers of the first-order simplices of one entity; anything else is refused.
      Tags simplices(const int dimension, const int entity) const
      {
        std::vector<int>  types;
        std::vector<Tags> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
        Tags found;
        for (std::size_t i = 0; i < types.size(); ++i)
          {
            if (types[i] == simplex_type[dimension])
              {
                found.insert(found.end(), nodes[i].begin(), nodes[i].end());
                continue;
              }
            std::string         name;
            int                 d, order, n, n_primary;
            std::vector<double> local;
            gmsh::model::mesh::getElementProperties(types[i], name, d, order, n, local, n_primary);
            throw UserError(
                origin + ": it holds " + std::to_string(elements[i].size()) + " elements of type '"
                + name + "'; only first-order " + cells_word<dim> + " can be used ("
                + (order > 1 ? "in the .geo file: Mesh.ElementOrder = 1"
                             : "in the .geo file: no Recombine, no extruded layers with it")
                + ")");
          }
        return found;
      }

      unsigned int vertex(const std::size_t node)
      {
        const auto [entry, is_new] = vertex_of_node.try_emplace(node, mesh.vertices.size());
        if (is_new)
          {
            const auto position = positions.find(node);
            if (position == positions.end())
              throw UserError(origin + ": a cell refers to node " + std::to_string(node)
                              + ", which does not exist");
            dealii::Point<dim> point;
            for (unsigned int d = 0; d < dim; ++d)
              point[d] = position->second[d];
            mesh.vertices.push_back(point);
          }
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

        for (const int entity : entities)
          {
            const Tags        nodes = simplices(dim, entity);
            const std::size_t first = mesh.cells.size();
            for (std::size_t i = 0; i < nodes.size(); i += dim + 1)
              {
                dealii::CellData<dim> cell(dim + 1);
                for (unsigned int v = 0; v <= dim; ++v)
                  cell.vertices[v] = vertex(nodes[i + v]);
                mesh.cells.push_back(cell);
              }
            if constexpr (dim == 2)
              face_upwards(first);
          }
        if constexpr (dim == 2)
          check_plane();
      }

      // A plane surface whose curves go clockwise has its normal downwards in gmsh, and all its
      // triangles with it. That is no fault.
      void face_upwards(const std::size_t first)
      {
        const auto downwards = [&](const dealii::CellData<dim> &cell) {
          const auto &p = mesh.vertices[cell.vertices[0]];
          const auto  a = mesh.vertices[cell.vertices[1]] - p;
          const auto  b = mesh.vertices[cell.vertices[2]] - p;
          return a[0] * b[1] - a[1] * b[0] < 0;
        };
        if (std::all_of(mesh.cells.begin() + first, mesh.cells.end(), downwards))
          for (std::size_t i = first; i < mesh.cells.size(); ++i)
            std::swap(mesh.cells[i].vertices[1], mesh.cells[i].vertices[2]);
      }

      void check_plane() const
      {
        double extent = 0, height = 0;
        for (const auto &[node, vertex] : vertex_of_node)
          {
            const auto &x = positions.at(node);
            extent        = std::max({extent, std::abs(x[0]), std::abs(x[1])});
            height        = std::max(height, std::abs(x[2]));
          }
        if (height > 1e-10 * extent)
          throw UserError(origin + ": a two-dimensional mesh must lie in the plane z = 0");
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
              add_faces(simplices(dim - 1, entity), id);
          }
        if (mesh.names.empty())
          throw UserError(origin + ": no boundary has a name"
                          + (groups.empty() ? "" : " (its physical groups have numbers only)")
                          + ". Name them in the .geo file, for instance: Physical "
                          + (dim == 2 ? "Curve" : "Surface") + "(\"left\") = {1};");
      }

      void add_faces(const Tags &nodes, const dealii::types::boundary_id id)
      {
        for (std::size_t i = 0; i < nodes.size(); i += dim)
          {
            dealii::CellData<dim - 1> face(dim);
            for (unsigned int v = 0; v < dim; ++v)
              {
                const auto vertex = vertex_of_node.find(nodes[i + v]);
                if (vertex == vertex_of_node.end())
                  throw UserError(origin + ": boundary '" + mesh.names[id]
                                  + "' has faces that belong to no cell");
                face.vertices[v] = vertex->second;
              }
            face.boundary_id = id;
            if constexpr (dim == 2)
              mesh.boundary.boundary_lines.push_back(face);
            else
              mesh.boundary.boundary_quads.push_back(face);
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
        throw UserError(origin
                        + ": a mesh is a .geo or .msh file of gmsh, or one of the generators "
                          "box(lx, ly, lz), rectangle(lx, ly), quadrilateral(x0,y0, ..., x3,y3)");
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

  template <int dim>
  RawMesh<dim> read_with_gmsh(const MeshRequest &request)
  {
    const std::string origin = "Mesh '" + request.source + "'";
    const std::string ending = check_file(request.source);
    const Session     session;
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
        });
      }
    else
      session.guarded(origin, [&] {
        gmsh::open(request.source);
        check_dimension(gmsh::model::getDimension(), dim, true, origin);
      });
    session.guarded(origin, [&] { mesh = Reader<dim>(origin).read(); });
    return mesh;
  }

  template RawMesh<2> read_with_gmsh<2>(const MeshRequest &);
  template RawMesh<3> read_with_gmsh<3>(const MeshRequest &);
} // namespace isochor
