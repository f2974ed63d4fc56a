#pragma once

// Nested iteration: the equilibrium on a coarse mesh, interpolated, is where Newton's method begins
// on the fine one, at the full load. Coarse steps cost little, and few are left on the fine mesh.

#include <isochor/march/load_control.h>
#include <isochor/mesh/mesh.h>
#include <isochor/run/run.h>

namespace isochor
{
  /// The mesh @p wanted by a scene, of what cells @p method needs.
  MeshRequest mesh_request_for(MeshRequest wanted, const Method &method);

  /// Throws UserError if the mesh of @p method.nested_levels coarser meshes cannot be named.
  void check_nested(const MeshRequest &request, unsigned int levels);

  /// A body in equilibrium at the full load, which a run on another mesh or with another element may
  /// begin with.
  template <int dim>
  struct SolvedBody
  {
    MeshRequest                          request; ///< of the mesh; equal ones make equal meshes
    std::shared_ptr<Mesh<dim>>           mesh;
    std::unique_ptr<Discretisation<dim>> discretisation;
    Vector                               state;
  };

  struct NestedReport
  {
    unsigned int             newton_iterations = 0; ///< on all coarse meshes
    LinearStatistics         linear;                ///< likewise
    std::vector<std::string> remarks;               ///< what did not work
  };

  /// March to the full load. With @p solved it begins with that body's equilibrium, else with @p
  /// method.nested_levels with the equilibrium on a mesh of twice the edge length, itself begun on
  /// coarser ones, and takes one step; where that does not work, and if @p begin is past the first
  /// step, it is march_quasi_static(). Collective.
  template <int dim>
  MarchReport march_nested(const Scene<dim>       &scene,
                           const Method           &method,
                           const LoadControl<dim> &control,
                           NestedReport           &report,
                           Vector                 &state,
                           const MarchState       &begin,
                           const SolvedBody<dim>  *solved = nullptr);
} // namespace isochor
