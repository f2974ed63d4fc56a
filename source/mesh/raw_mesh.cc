#include "cell_order.h"

#include <isochor/mesh/generator.h>
#include <isochor/mesh/gmsh_reader.h>
#include <isochor/mesh/mesh_check.h>
#include <isochor/mesh/quality.h>

namespace isochor
{
  template <int dim>
  RawMesh<dim> make_raw_mesh(const MeshRequest &request)
  {
    RawMesh<dim> mesh
        = is_generator(request.source) ? generate<dim>(request) : read_with_gmsh<dim>(request);
    const std::string origin = "Mesh '" + request.source + "'";
    check_and_complete(mesh, origin);
    // Only now: deal.II expects sound cells.
    if (!is_generator(request.source)) // whose edges are directed alike
      direct_edges_alike(mesh);
    mesh.quality = measure_quality(mesh);
    return mesh;
  }

  template RawMesh<2> make_raw_mesh<2>(const MeshRequest &);
  template RawMesh<3> make_raw_mesh<3>(const MeshRequest &);
} // namespace isochor
