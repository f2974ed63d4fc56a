#pragma once

// From a scene to its equilibrium in one call.

#include "fields.h"
#include "report.h"

#include <isochor/march/quasi_static.h>
#include <isochor/mesh/mesh.h>
#include <isochor/solver/dual_ascent.h>

namespace isochor::testing
{
  template <int dim>
  struct Solution
  {
    MarchReport           report;
    LinearStatistics      statistics;
    Vector                state;
    Vector                reactions;
    std::vector<LoadStep> steps;
    DualReport            dual; ///< the most of any load step
  };

  struct SolveOptions
  {
    unsigned int      load_steps   = 1;
    double            tolerance    = 1e-12;
    double            minimum_step = 0.05;
    ComplianceOptions compliance;
    LinearOptions     linear;

    std::optional<DualOptions> dual; ///< dual ascent in the place of Newton's method
  };

  template <int dim>
  Solution<dim> solve(const Mesh<dim>           &mesh,
                      const Discretisation<dim> &discretisation,
                      const Scene<dim>          &scene,
                      const SolveOptions        &options = {})
  {
    const Equilibrium<dim> equilibrium(
        discretisation,
        scene,
        [&](const std::string &name, const std::string &what) {
          return mesh.boundary_id(name, what);
        },
        options.compliance);
    Stopwatch          stopwatch;
    TangentSolver<dim> tangent_solver(equilibrium, options.linear, stopwatch);

    Solution<dim> solution{
        {}, {}, discretisation.make_vector(), discretisation.make_vector(), {}, {}};
    MarchCallbacks callbacks;
    callbacks.converged
        = [&](const LoadStep &step, const Vector &) { solution.steps.push_back(step); };
    callbacks.failed      = [](double, const NewtonReport &, double) {};
    callbacks.interrupted = []() { return false; };
    NewtonOptions newton;
    newton.tolerance = options.tolerance;
    std::optional<DualAscent<dim>> dual_ascent;
    if (options.dual)
      {
        dual_ascent.emplace(equilibrium, tangent_solver, newton, *options.dual, stopwatch);
        callbacks.solve = [&](const double load, ResidualSize &size, Vector &state) {
          const auto report = dual_ascent->solve(load, callbacks.interrupted, size, state);
          solution.dual     = most(solution.dual, dual_ascent->report());
          return report;
        };
      }
    const LoadControl<dim> control(equilibrium, tangent_solver, newton, callbacks, stopwatch);
    const MarchState       rest;
    solution.report = march_quasi_static(
        control, {options.load_steps, options.minimum_step}, solution.state, rest);
    Vector residual = discretisation.make_vector();
    equilibrium.residual(solution.state, solution.report.load, residual, &solution.reactions);
    solution.statistics = tangent_solver.statistics();
    return solution;
  }

  /// Largest distance of the displacement from @p exact(X), and of the pressure from
  /// @p pressure, over all nodes.
  template <int dim, typename Exact>
  std::array<double, 2> distance(const Discretisation<dim> &discretisation,
                                 const Vector              &state,
                                 const Exact               &exact,
                                 const double               pressure)
  {
    const auto           &cells = discretisation.cells;
    std::array<double, 2> largest{};
    for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
      {
        for (unsigned int a = 0; a < cells.n_x; ++a)
          {
            const auto                   xi = discretisation.x_shape.node(a);
            const dealii::Tensor<1, dim> u  = exact(cells.position(cell, xi));
            const auto                   d  = u - displacement_at(discretisation, state, cell, xi);
            for (unsigned int c = 0; c < dim; ++c)
              raise(largest[0], std::abs(d[c]));
            if (cells.n_p > 0)
              raise(largest[1], std::abs(pressure - pressure_at(discretisation, state, cell, xi)));
          }
      }
    for (double &entry : largest)
      entry = dealii::Utilities::MPI::max(entry, MPI_COMM_WORLD);
    return largest;
  }
} // namespace isochor::testing
