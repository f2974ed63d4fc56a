#pragma once

// Nested iteration: the equilibrium on a coarse mesh, interpolated, is where Newton's method begins
// on the fine one, at the full load. Coarse steps cost little, and few are left on the fine mesh.

#include <isochor/mesh/mesh.h>
#include <isochor/run/run.h>

namespace isochor
{
  /// The mesh of @p scene with what cells @p method needs. Collective.
  template <int dim>
  std::unique_ptr<Mesh<dim>>
  make_mesh_for(const Scene<dim> &scene, const Method &method, MPI_Comm communicator);

  /// Throws UserError if the mesh of @p method.nested_levels coarser meshes cannot be named.
  void check_nested(const MeshRequest &request, unsigned int levels);

  struct NestedReport
  {
    unsigned int             newton_iterations = 0; ///< on all coarse meshes
    LinearStatistics         linear;                ///< likewise
    std::vector<std::string> remarks;               ///< what did not work
  };

  /// Set @p state to the equilibrium at the full load on a mesh of twice the edge length, itself
  /// begun on coarser ones, with the prescribed displacements of @p fine. False, and a remark, if
  /// the coarse mesh has none. Seconds go to @p stopwatch. Collective.
  template <int dim>
  bool begin_coarse(const Scene<dim>            &scene,
                    const Method                &method,
                    const Equilibrium<dim>      &fine,
                    const std::function<bool()> &interrupted,
                    Stopwatch                   &stopwatch,
                    NestedReport                &report,
                    Vector                      &state);

  /// March in one step from @p state, which is near the equilibrium at the full load; if that fails,
  /// from rest in the steps that @p method asks for. Collective.
  template <int dim>
  MarchReport march_from_guess(const Equilibrium<dim>   &equilibrium,
                               TangentSolver<dim>       &tangent_solver,
                               const Method             &method,
                               const MarchCallbacks     &callbacks,
                               Stopwatch                &stopwatch,
                               std::vector<std::string> &remarks,
                               Vector                   &state);
} // namespace isochor
