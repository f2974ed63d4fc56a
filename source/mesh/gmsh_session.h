#pragma once

// gmsh in this process, from start to end.

#include <isochor/mesh/mesh_request.h>

#include <functional>

namespace isochor
{
  /// Silent, one thread, a log instead of a terminal. A static: gmsh is one global state. What gmsh
  /// throws is a std::string, which nobody else would catch.
  class GmshSession
  {
  public:
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession &)            = delete;
    GmshSession &operator=(const GmshSession &) = delete;

    /// Run @p action; what gmsh complains of becomes a UserError that starts with @p origin.
    void guarded(const std::string &origin, const std::function<void()> &action) const;

  private:
    int         threads;
    std::string locale;
  };

  /// Open the .geo file of @p request, with its size and its kind of cells given to it.
  void
  open_geometry(const GmshSession &session, const MeshRequest &request, const std::string &origin);
} // namespace isochor
