#include "cell_order.h"

#include <isochor/mesh/generator.h>
#include <isochor/mesh/gmsh_reader.h>
#include <isochor/mesh/mesh_check.h>
#include <isochor/mesh/quality.h>

namespace isochor
{
  namespace
  {
    /// Checked. Tetrahedra that their curved edges invert are untangled, where that makes a sound mesh
    /// of them; of hexahedra it takes long.
    template <int dim>
    RawMesh<dim> read_sound(const MeshRequest &request, const std::string &origin)
    {
      RawMesh<dim> mesh = read_with_gmsh<dim>(request);
      try
        {
          check_and_complete(mesh, origin);
          return mesh;
        }
      catch (const UserError &)
        {
          if (request.geometry_order == 1 || request.kind != CellKind::simplex
              || !request.source.ends_with(".geo"))
            throw;
          mesh = read_with_gmsh<dim>(request, true);
          try
            {
              check_and_complete(mesh, origin);
              return mesh;
            }
          catch (const UserError &)
            {
            }
          throw; // what is wrong with the mesh as it was
        }
    }
  } // namespace

  template <int dim>
  RawMesh<dim> make_raw_mesh(const MeshRequest &request)
  {
    const std::string origin = "Mesh '" + request.source + "'";
    RawMesh<dim>      mesh;
    if (is_generator(request.source))
      {
        mesh = generate<dim>(request);
        check_and_complete(mesh, origin);
      }
    else
      mesh = read_sound<dim>(request, origin);
    // Only now: deal.II expects sound cells.
    if (!is_generator(request.source)) // whose edges are directed alike
      direct_edges_alike(mesh);
    mesh.quality = measure_quality(mesh);
    return mesh;
  }

  template RawMesh<2> make_raw_mesh<2>(const MeshRequest &);
  template RawMesh<3> make_raw_mesh<3>(const MeshRequest &);
} // namespace isochor
