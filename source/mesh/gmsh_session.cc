#include "gmsh_session.h"

#include <isochor/mesh/geo_constant.h>

#include <gmsh.h>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

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

    std::string last_error()
    {
      std::vector<std::string> log;
      gmsh::logger::get(log);
      const std::string mark = "Error: ";
      for (auto line = log.rbegin(); line != log.rend(); ++line)
        if (line->rfind(mark, 0) == 0)
          return line->substr(mark.size());
      return "(nothing)";
    }

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
  } // namespace

  GmshSession::GmshSession()
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

  GmshSession::~GmshSession()
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

  void GmshSession::guarded(const std::string &origin, const std::function<void()> &action) const
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

  // Through a file of ours that includes the user's. A constant that exists before DefineConstant
  // wins; given on gmsh's command line (-setnumber) it would outlive gmsh::finalize(). And a last
  // line without a newline is lost if gmsh 4.8 opens the file itself, an endless loop if it
  // merges it, but sound if it includes it.
  void
  open_geometry(const GmshSession &session, const MeshRequest &request, const std::string &origin)
  {
    if (request.source.find('"') != std::string::npos)
      throw UserError(origin + ": gmsh takes no double quotes in file names");
    const bool         sized = request.size > 0;
    const bool         named = sized && geo_constant(request.source, "size");
    std::ostringstream text;
    text.precision(17);
    if (named)
      text << "size = " << request.size << ";\n";
    if (geo_constant(request.source, "hexahedra"))
      text << "hexahedra = " << (request.kind == CellKind::hypercube ? 1 : 0) << ";\n";
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
} // namespace isochor
