#include <isochor/core/text.h>
#include <isochor/march/quasi_static.h>
#include <isochor/mesh/generator.h>
#include <isochor/run/nested.h>
#include <isochor/run/saved_run.h>
#include <isochor/space/interpolation.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    // Newton's tolerance on the coarse meshes: far below what interpolation leaves.
    constexpr double coarse_tolerance = 1e-4;

    MeshRequest coarser(MeshRequest request)
    {
      request.size *= 2.;
      for (unsigned int &blocks : request.cells)
        blocks = std::max(1u, blocks / 2);
      return request;
    }
  } // namespace

  void check_nested(const MeshRequest &request, const unsigned int levels)
  {
    const bool is_file = !is_generator(request.source);
    if (levels > 0 && is_file && (request.source.ends_with(".msh") || !(request.size > 0)))
      throw UserError(
          "Method/Nested levels: the mesh '" + request.source
          + "' cannot be made coarser; allowed: 0, or a generator or a .geo file with a "
            "Scene/Mesh size");
  }

  MeshRequest mesh_request_for(MeshRequest wanted, const Method &method)
  {
    wanted.kind = method.element.kind;
    // A linear displacement on a quadratic cell would not even hold a linear field.
    wanted.geometry_order = std::min(wanted.geometry_order, method.element.displacement.degree);
    return wanted;
  }

  namespace
  {
    /// Set @p state to @p from, which belongs to @p other, with the prescribed displacements of @p
    /// control at the full load.
    template <int dim>
    void begin_with(const Discretisation<dim> &other,
                    const Vector              &from,
                    const LoadControl<dim>    &control,
                    Vector                    &state)
    {
      const auto scope = control.stopwatch.measure(Phase::setup);
      interpolate(other, from, control.equilibrium.discretisation(), state);
      Vector gap(state);
      control.equilibrium.prescribed().gap(state, 1., gap);
      state += gap;
      state.update_ghost_values();
    }

    /// Set @p state to the equilibrium at the full load on the coarser mesh, with the prescribed
    /// displacements of @p fine. False, and a remark, if the coarse mesh has none.
    template <int dim>
    bool begin_coarse(const Scene<dim>       &fine_scene,
                      const Method           &fine_method,
                      const LoadControl<dim> &fine,
                      NestedReport           &report,
                      Vector                 &state)
    {
      Scene<dim> scene = fine_scene;
      scene.mesh       = coarser(scene.mesh);
      Method method    = fine_method;
      --method.nested_levels;
      method.newton.tolerance = std::max(method.newton.tolerance, coarse_tolerance);
      Stopwatch &stopwatch    = fine.stopwatch;

      std::unique_ptr<Mesh<dim>> mesh;
      {
        const auto scope = stopwatch.measure(Phase::mesh);
        mesh = make_mesh<dim>(mesh_request_for(scene.mesh, method), state.get_mpi_communicator());
      }
      std::optional<Stopwatch::Scope> setup(std::in_place, stopwatch, Phase::setup);
      const Discretisation<dim> discretisation(mesh->triangulation, method.element, mesh->geometry);
      const Equilibrium<dim>    equilibrium(
          discretisation,
          scene,
          [&](const std::string &name, const std::string &what) {
            return mesh->boundary_id(name, what);
          },
          method.compliance);
      setup.reset();

      TangentSolver<dim> tangent_solver(equilibrium, method.linear, stopwatch);
      MarchCallbacks     callbacks;
      callbacks.converged   = [](const LoadStep &, const Vector &) {};
      callbacks.failed      = [](double, const NewtonReport &, double) {};
      callbacks.interrupted = fine.callbacks.interrupted;
      const LoadControl<dim> control(
          equilibrium, tangent_solver, method.newton, callbacks, stopwatch);
      Vector coarse_state = discretisation.make_vector();
      coarse_state.update_ghost_values();

      const MarchState  rest;
      const MarchReport march = march_nested(scene, method, control, report, coarse_state, rest);
      report.newton_iterations += march.newton_iterations;
      report.linear = joined(report.linear, tangent_solver.statistics());
      if (!march.converged())
        {
          report.remarks.push_back("nested iteration: no equilibrium on the mesh of "
                                   + std::to_string(discretisation.n_cells) + " cells ("
                                   + march.reason + "); begun from rest");
          return false;
        }

      begin_with(discretisation, coarse_state, fine, state);
      return true;
    }

    /// March in one step from @p state, which is near the equilibrium at the full load; if that
    /// fails, from rest in the steps that @p stepping asks for.
    template <int dim>
    MarchReport march_from_guess(const LoadControl<dim>   &control,
                                 const SteppingOptions    &stepping,
                                 std::vector<std::string> &remarks,
                                 Vector                   &state)
    {
      SteppingOptions one_step = stepping;
      one_step.kind            = Stepping::fixed;
      one_step.load_steps      = 1;
      one_step.minimum_step    = 1.;
      MarchState        begin;
      const MarchReport report = march_quasi_static(control, one_step, state, begin);
      if (report.status != RunStatus::not_converged)
        return report;

      remarks.push_back(
          "nested iteration: the interpolated state led to no equilibrium on the mesh of "
          + std::to_string(control.equilibrium.discretisation().n_cells)
          + " cells; begun from rest");
      state = 0.;
      state.update_ghost_values();
      begin.report.failed_steps      = report.failed_steps;
      begin.report.newton_iterations = report.newton_iterations;
      return march_quasi_static(control, stepping, state, begin);
    }
  } // namespace

  template <int dim>
  MarchReport march_nested(const Scene<dim>       &scene,
                           const Method           &method,
                           const LoadControl<dim> &control,
                           NestedReport           &report,
                           Vector                 &state,
                           const MarchState       &begin,
                           const SolvedBody<dim>  *solved)
  {
    // A run that was interrupted is past its beginning.
    if (begin.report.load_steps == 0)
      {
        if (solved != nullptr)
          begin_with(*solved->discretisation, solved->state, control, state);
        if (solved != nullptr
            || (method.nested_levels > 0 && begin_coarse(scene, method, control, report, state)))
          return march_from_guess(control, method.stepping, report.remarks, state);
      }
    return march_quasi_static(control, method.stepping, state, begin);
  }

#define INSTANTIATE(dim)                                      \
  template MarchReport march_nested(const Scene<dim> &,       \
                                    const Method &,           \
                                    const LoadControl<dim> &, \
                                    NestedReport &,           \
                                    Vector &,                 \
                                    const MarchState &,       \
                                    const SolvedBody<dim> *);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace isochor
