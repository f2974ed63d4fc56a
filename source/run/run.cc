#include <isochor/core/text.h>
#include <isochor/output/vtu.h>
#include <isochor/run/error_estimate.h>
#include <isochor/run/interrupt.h>
#include <isochor/run/nested.h>
#include <isochor/run/progress.h>
#include <isochor/run/saved_run.h>
#include <isochor/run/step_tables.h>
#include <isochor/run/turns.h>
#include <isochor/run/warnings.h>
#include <isochor/space/interpolation.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <fstream>
#include <iostream>

namespace isochor
{
  namespace
  {
    /// Linux keeps the peak for the process; a study wants it for each run.
    void reset_peak_memory()
    {
      std::ofstream("/proc/self/clear_refs") << "5";
    }

    double peak_megabytes(MPI_Comm communicator)
    {
      dealii::Utilities::System::MemoryStats memory;
      dealii::Utilities::System::get_memory_stats(memory);
      return dealii::Utilities::MPI::max(memory.VmHWM / 1024., communicator);
    }

    /// What the scene begins with, the supports where they are before any load. Throws UserError
    /// if it inverts cells.
    template <int dim>
    Vector initial_state(const Scene<dim> &scene, const Equilibrium<dim> &equilibrium)
    {
      Vector state = equilibrium.discretisation().make_vector();
      if (scene.initial_displacement.empty())
        {
          state.update_ghost_values();
          return state;
        }
      collectively(state.get_mpi_communicator(), [&]() {
        set_displacements<dim>(
            equilibrium.discretisation(),
            [&](const dealii::Point<dim> &position) {
              dealii::Tensor<1, dim> u;
              for (unsigned int d = 0; d < dim; ++d)
                u[d] = scene.initial_displacement[d].value(position, 0.);
              return u;
            },
            state);
      });
      Vector scratch(state);
      equilibrium.prescribed().gap(state, 0., scratch);
      state += scratch;
      const double min_jacobian = equilibrium.residual(state, 0., scratch).min_jacobian;
      // Rounding must not decide whether a flat cell is inverted.
      if (!equilibrium.is_linear() && !(min_jacobian > 1e-6))
        throw UserError("Scene/Initial displacement: it flattens or inverts cells (min J "
                        + to_text(min_jacobian)
                        + "); allowed: a displacement that keeps every J above 0, the supports "
                          "being where they are before any load");
      return state;
    }

    /// Of this rank, by phase.
    auto seconds_of(const Stopwatch &stopwatch)
    {
      decltype(RunResult::seconds) seconds;
      for (std::size_t k = 0; k < seconds.size(); ++k)
        seconds[k] = stopwatch.seconds(static_cast<Phase>(k));
      return seconds;
    }
  } // namespace

  template <int dim>
  RunResult run(const Scene<dim>      &scene,
                const Method          &method,
                const RunSettings     &settings,
                const SolvedBody<dim> *begin,
                SolvedBody<dim>       *end)
  {
    const MPI_Comm communicator = settings.communicator;
    const bool     talks
        = settings.show_steps && dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    check_legal(method, scene.material, dealii::Utilities::MPI::n_mpi_processes(communicator));
    check_loads_against_supports(scene);
    check_nested(scene.mesh, method.nested_levels);
    reset_peak_memory();

    Stopwatch stopwatch;
    RunResult result;

    const MeshRequest          request = mesh_request_for(scene.mesh, method);
    std::shared_ptr<Mesh<dim>> mesh;
    if (begin != nullptr && begin->request == request)
      mesh = begin->mesh;
    else
      {
        const auto scope = stopwatch.measure(Phase::mesh);
        mesh             = make_mesh<dim>(request, communicator);
      }
    result.quality         = mesh->quality;
    const auto boundary_id = [&](const std::string &name, const std::string &what) {
      return mesh->boundary_id(name, what);
    };

    std::optional<Stopwatch::Scope> setup_scope(std::in_place, stopwatch, Phase::setup);
    auto                            own_discretisation = std::make_unique<Discretisation<dim>>(
        mesh->triangulation, method.element, mesh->geometry);
    const Discretisation<dim> &discretisation = *own_discretisation;
    const Equilibrium<dim>     equilibrium(discretisation, scene, boundary_id, method.compliance);
    const Probes<dim>          probes(discretisation, scene.material, scene.probes, boundary_id);
    setup_scope.reset();
    result.cells         = discretisation.n_cells;
    result.unknowns      = discretisation.n_unknowns();
    result.probe_columns = probes.columns();
    if (settings.most_unknowns > 0 && result.unknowns > settings.most_unknowns)
      {
        result.status = left_out;
        result.reason
            = std::to_string(result.unknowns) + " unknowns, more than Study/Most unknowns";
        return result;
      }
    if (result.unknowns < settings.least_unknowns)
      {
        result.status = left_out;
        result.reason = std::to_string(result.unknowns) + " unknowns, hardly a finer mesh";
        return result;
      }
    check_turns(equilibrium, method.stepping.load_steps);
    Vector state = initial_state(scene, equilibrium);
    if (talks)
      print_summary(result, std::string(method.element.name));
    if (settings.check_only)
      {
        result.status = "checked";
        return result;
      }
    RunCheckpoints checkpoints(settings, discretisation);
    const SavedRun earlier
        = settings.restart ? checkpoints.load(state, result.warnings) : SavedRun();
    settings.before_output();

    TangentSolver<dim> tangent_solver(equilibrium, method.linear, stopwatch);
    if (const std::string &note = tangent_solver.statistics().note; talks && !note.empty())
      std::cout << "  " << note << '\n';
    Vector scratch(state.get_partitioner()), reactions(scratch);

    const auto stability = [&](const Vector &at) {
      const auto scope = stopwatch.measure(Phase::output);
      return inf_sup(discretisation,
                     equilibrium.prescribed(),
                     scene.material.volumetric_strain,
                     method.compliance.stabilisation,
                     at);
    };
    if (settings.inf_sup)
      {
        scratch.update_ghost_values();
        result.inf_sup_at_rest = stability(scratch); // zero
      }

    for (std::size_t k = 0; k < earlier.seconds.size(); ++k)
      stopwatch.add(static_cast<Phase>(k), earlier.seconds[k]);

    VtuSeries<dim> vtu(discretisation, scene.material, settings.folder);
    vtu.resume(earlier.pictures);
    const unsigned int            n_kept = earlier.march.report.load_steps;
    StepTable                     steps(settings, probes.columns(), n_kept);
    std::optional<IterationTable> iterations;
    if (settings.iterations)
      iterations.emplace(settings, n_kept);
    const auto measure = [&](const double load) {
      equilibrium.residual(state, load, scratch, &reactions);
      return probes.measure(state, reactions, load);
    };

    NestedReport nested = earlier.nested;
    result.dual         = earlier.dual;
    MarchCallbacks callbacks;
    bool           is_late = false;
    callbacks.interrupted  = [&]() {
      is_late = is_late
                || (method.time_limit > 0
                    && dealii::Utilities::MPI::max(stopwatch.total(), communicator)
                           > method.time_limit);
      return interrupted(communicator) || is_late;
    };
    std::optional<DualAscent<dim>> dual_ascent;
    if (method.solver == Solver::dual_ascent)
      {
        dual_ascent.emplace(equilibrium, tangent_solver, method.newton, method.dual, stopwatch);
        callbacks.solve = [&](const double load, ResidualSize &size, Vector &x) {
          return dual_ascent->solve(load, callbacks.interrupted, size, x);
        };
      }
    callbacks.converged = [&](const LoadStep &step, const Vector &) {
      const auto                scope = stopwatch.measure(Phase::output);
      std::optional<DualReport> dual;
      if (dual_ascent)
        {
          dual        = dual_ascent->report();
          result.dual = result.dual ? most(*result.dual, *dual) : *dual;
        }
      steps.add(step, dual, measure(step.load));
      if (iterations)
        iterations->step_converged();
      if (settings.vtu == VtuOutput::every_step)
        vtu.write(state, step.load, step.number);
      if (talks)
        print_step(step);
    };
    if (iterations)
      callbacks.solved = [&](const double load, const NewtonReport &newton) {
        const auto scope = stopwatch.measure(Phase::output);
        iterations->add(load, newton, dual_ascent ? &dual_ascent->report() : nullptr);
      };
    callbacks.failed = [&](const double load, const NewtonReport &report, const double next_step) {
      if (talks)
        print_failed_step(load, report, next_step);
    };
    callbacks.resumable = [&](const MarchState &march) {
      const auto scope = stopwatch.measure(Phase::output);
      if (checkpoints.is_due())
        checkpoints.save({march,
                          nested,
                          vtu.written(),
                          joined(earlier.linear, tangent_solver.statistics()),
                          result.dual,
                          seconds_of(stopwatch),
                          earlier.seconds_total + stopwatch.total(),
                          peak_megabytes(communicator)});
    };

    if (talks)
      print_step_header();
    const LoadControl<dim> control(
        equilibrium, tangent_solver, method.newton, callbacks, stopwatch);
    result.march = march_nested(scene, method, control, nested, state, earlier.march, begin);
    if (is_late && result.march.status == RunStatus::interrupted)
      {
        result.march.status = RunStatus::not_converged;
        result.march.reason = std::string(time_limit_words) + " of " + to_text(method.time_limit)
                              + " s: " + result.march.reason;
      }
    result.coarse_newton_iterations = nested.newton_iterations;
    result.warnings.insert(result.warnings.end(), nested.remarks.begin(), nested.remarks.end());

    {
      const auto scope    = stopwatch.measure(Phase::output);
      result.probe_values = measure(result.march.load);
      if (result.march.load_steps == 0) // the state that is left is the one it began with
        result.march.size = equilibrium.residual(state, result.march.load, scratch);
      // The last converged state is on disk whatever happened.
      if (settings.vtu == VtuOutput::final_state
          || (settings.vtu == VtuOutput::every_step && result.march.load_steps == 0))
        vtu.write(state, result.march.load, result.march.load_steps);
      result.volume_ratio = deformed_volume(discretisation, state) / mesh->quality.total_volume;
      result.oscillation  = pressure_oscillation(discretisation, state);
    }
    if (result.converged() && settings.estimates_error_of)
      result.estimated_errors = estimated_errors(settings.estimates_error_of,
                                                 scene,
                                                 probes,
                                                 equilibrium,
                                                 tangent_solver,
                                                 stopwatch,
                                                 state,
                                                 result.march.load);
    if (settings.inf_sup)
      result.inf_sup_at_end = stability(state);
    result.status  = result.march.status_text();
    result.reason  = result.march.reason;
    result.linear  = joined(joined(nested.linear, earlier.linear), tangent_solver.statistics());
    result.seconds = seconds_of(stopwatch);
    for (double &seconds : result.seconds)
      seconds = dealii::Utilities::MPI::max(seconds, communicator);
    result.seconds_total
        = earlier.seconds_total + dealii::Utilities::MPI::max(stopwatch.total(), communicator);
    result.peak_megabytes = std::max(earlier.peak_megabytes, peak_megabytes(communicator));
    const auto warnings
        = warnings_of(result, method.element, scene.material, trust_figures(equilibrium, state));
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
    if (!result.linear.note.empty())
      result.warnings.push_back(result.linear.note);
    if (end != nullptr && result.converged())
      *end = {request, std::move(mesh), std::move(own_discretisation), std::move(state)};
    return result;
  }

#define INSTANTIATE(dim)                          \
  template RunResult run(const Scene<dim> &,      \
                         const Method &,          \
                         const RunSettings &,     \
                         const SolvedBody<dim> *, \
                         SolvedBody<dim> *);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace isochor
