#include <isochor/measure/recovered_error.h>
#include <isochor/run/error_estimate.h>

#include <limits>

namespace isochor
{
  namespace
  {
    /// Of an adjoint, which weighs what is known within a factor of two.
    constexpr double adjoint_tolerance = 1e-3;
  } // namespace

  template <int dim>
  std::vector<double>
  estimated_errors(const std::function<bool(const std::string &probe)> &is_wanted,
                   const Scene<dim>                                    &scene,
                   const Probes<dim>                                   &probes,
                   const Equilibrium<dim>                              &equilibrium,
                   TangentSolver<dim>                                  &tangent_solver,
                   Stopwatch                                           &stopwatch,
                   const Vector                                        &state,
                   const double                                         load)
  {
    state.update_ghost_values();
    const RecoveredError<dim> recovered(equilibrium.discretisation(), scene.material);
    std::vector<double> errors(probes.columns().size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto &probe : scene.probes)
      if (is_wanted(probe.name))
        {
          std::vector<std::size_t> columns;
          std::vector<Vector>      adjoints;
          for (const auto &[column, derivative] : probes.derivatives(probe.name, state))
            {
              Vector adjoint(state.get_partitioner());
              if (!tangent_solver.adjoint(state, load, derivative, adjoint_tolerance, adjoint)
                       .succeeded)
                continue; // there is no matrix, or it is singular
              adjoint.update_ghost_values();
              columns.push_back(column);
              adjoints.push_back(std::move(adjoint));
            }
          if (columns.empty())
            continue;
          const auto scope = stopwatch.measure(Phase::output);
          if (const auto estimates = recovered.estimate(state, adjoints))
            for (std::size_t k = 0; k < columns.size(); ++k)
              errors[columns[k]] = (*estimates)[k];
        }
    return errors;
  }

#define INSTANTIATE(dim)                                                                          \
  template std::vector<double> estimated_errors(const std::function<bool(const std::string &)> &, \
                                                const Scene<dim> &,                               \
                                                const Probes<dim> &,                              \
                                                const Equilibrium<dim> &,                         \
                                                TangentSolver<dim> &,                             \
                                                Stopwatch &,                                      \
                                                const Vector &,                                   \
                                                double);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace isochor
