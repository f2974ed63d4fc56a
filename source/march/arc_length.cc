#include <isochor/march/arc_length.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /// A point of the path, or a step along it.
    struct PathVector
    {
      Vector x;
      double load = 0;

      void add(const double factor, const PathVector &other)
      {
        x.add(factor, other.x);
        load += factor * other.load;
      }
    };

    template <int dim>
    class Path
    {
    public:
      /// @p state follows the path.
      Path(const LoadControl<dim> &control, const SteppingOptions &options, Vector &state)
        : control(control)
        , options(options)
        , step_control(options)
        , state(state)
        , here{state, 0.}
        , residual(state)
      {
      }

      MarchReport follow(const MarchState &begin);

    private:
      double dot(const PathVector &a, const PathVector &b) const;
      double largest_displacement() const;
      bool   find_tangent();
      void   try_step(PathVector &trial);
      void   correct(PathVector &trial);
      bool   land_on_full_load(const PathVector &beyond);
      void   accept(PathVector &trial);
      bool   has_ended() const;

      const LoadControl<dim> &control;
      SteppingOptions         options;
      StepControl             step_control;
      MarchReport             report;
      Stopwatch               clock;

      Vector    &state;         ///< of `here`, for those who watch
      PathVector here, tangent; ///< tangent of length 1, forwards
      Vector     residual;
      double     displacement_scale = 1; ///< U
      bool       has_tangent        = false;

      NewtonReport newton; ///< of the step that is being tried
      ResidualSize size;
    };

    template <int dim>
    double Path<dim>::dot(const PathVector &a, const PathVector &b) const
    {
      double sum = 0;
      for (LocalIndex i = 0; i < control.equilibrium.discretisation().n_owned_displacements; ++i)
        sum += a.x.local_element(i) * b.x.local_element(i);
      sum = dealii::Utilities::MPI::sum(sum, a.x.get_mpi_communicator());
      return sum / (displacement_scale * displacement_scale) + a.load * b.load;
    }

    template <int dim>
    double Path<dim>::largest_displacement() const
    {
      double largest = 0;
      for (LocalIndex i = 0; i < control.equilibrium.discretisation().n_owned_displacements;
           i += dim)
        {
          double squared = 0;
          for (unsigned int c = 0; c < dim; ++c)
            squared += std::pow(here.x.local_element(i + c), 2);
          largest = std::max(largest, squared);
        }
      return std::sqrt(dealii::Utilities::MPI::max(largest, here.x.get_mpi_communicator()));
    }

    /// At `here`; the first one points to larger loads, the others go on from the one before.
    template <int dim>
    bool Path<dim>::find_tangent()
    {
      PathVector rate{Vector(here.x), 1.};
      if (const std::string failure = control.find_rate(here.x, here.load, rate.x);
          !failure.empty())
        {
          report.reason = "the path has no tangent: " + failure;
          return false;
        }
      if (!has_tangent)
        {
          rate.load          = 0.;
          displacement_scale = 1.;
          const double speed = std::sqrt(dot(rate, rate));
          displacement_scale = speed > 0. ? speed : 1.;
          rate.load          = 1.;
        }
      double length = std::sqrt(dot(rate, rate));
      if (has_tangent && dot(rate, tangent) < 0.)
        length *= -1.;
      if (!std::isfinite(length))
        {
          report.reason = "the loads have no derivative with respect to the load factor at "
                          + std::to_string(here.load);
          return false;
        }
      rate.x *= 1. / length;
      rate.load /= length;
      tangent     = rate;
      has_tangent = true;
      return true;
    }

    /// One step of the step control's size; newton says how it went.
    template <int dim>
    void Path<dim>::try_step(PathVector &trial)
    {
      newton = {};
      trial  = here;
      trial.add(step_control.step(), tangent);
      correct(trial);
      control.tell(trial.load, newton);
      if (newton.outcome != NewtonOutcome::converged)
        return;

      PathVector increment = trial;
      increment.add(-1., here);
      // A step at more than 30 degrees to its tangent cuts a corner, or leads to another path.
      if (std::sqrt(dot(increment, increment)) > 1.15 * step_control.step())
        {
          newton.outcome = NewtonOutcome::stalled;
          newton.reason  = "the path turns too much in a step";
        }
    }

    /// Newton in the plane through @p trial that is perpendicular to the tangent.
    template <int dim>
    void Path<dim>::correct(PathVector &trial)
    {
      const NewtonOptions &limits = control.newton_options;
      const auto           fail   = [&](const NewtonOutcome outcome, const std::string &reason) {
        newton.outcome = outcome;
        newton.reason  = reason;
      };
      PathVector          rate{Vector(here.x), 1.}, step{Vector(here.x), 0.}, next;
      NewtonProblem::Size now = control.residual(trial.x, trial.load, residual, size);
      if (!now.admissible)
        return fail(NewtonOutcome::inverted, "the predicted state has inverted cells");
      newton.iterates.push_back({0, now, 0.});
      while (true)
        {
          newton.merit = now.merit;
          // Written so that NaN goes on, and fails below.
          if (now.gap == 0. && now.merit <= now.target)
            return;
          if (newton.iterations == limits.max_iterations)
            return fail(NewtonOutcome::iterations,
                        "no convergence in " + std::to_string(newton.iterations)
                            + " iterations along the path");
          const auto correction = control.tangent_solver.correction(
              trial.x, trial.load, residual, limits.largest_linear_tolerance, step.x, &rate.x);
          ++newton.iterations;
          if (!correction.succeeded)
            return fail(NewtonOutcome::linear, correction.failure);

          // (trial + step + d_load rate - here) . tangent = size of the step
          PathVector increment = trial;
          step.load            = 0.;
          increment.add(-1., here);
          increment.add(1., step);
          const double d_load
              = (step_control.step() - dot(increment, tangent)) / dot(rate, tangent);
          step.add(d_load, rate);

          double       length  = 1.;
          unsigned int halving = 0;
          for (; halving <= limits.max_halvings; ++halving, length *= 0.5)
            {
              next = trial;
              next.add(length, step);
              now = control.residual(next.x, next.load, residual, size);
              if (now.admissible && std::isfinite(now.merit))
                break;
            }
          newton.halvings += halving;
          if (halving > limits.max_halvings)
            return fail(NewtonOutcome::inverted, "every step along the path inverts a cell");
          trial = next;
          newton.iterates.push_back({newton.iterations, now, length});
          if (control.callbacks.interrupted())
            return fail(NewtonOutcome::interrupted, "interrupted");
        }
    }

    /// Newton at load factor 1, from where the line to @p beyond meets it; true if that is on the
    /// path between. Then it is `here`.
    template <int dim>
    bool Path<dim>::land_on_full_load(const PathVector &beyond)
    {
      PathVector start = here, way = beyond;
      way.add(-1., here);
      start.add((1. - here.load) / (beyond.load - here.load), way);
      PathVector landed = start;
      landed.load       = 1.;
      newton            = control.solve(1., landed.x, size, CurvatureFilter::none);
      report.newton_iterations += newton.iterations;
      PathVector off = landed;
      off.add(-1., start);
      if (newton.outcome == NewtonOutcome::converged && dot(off, off) > dot(way, way))
        {
          newton.outcome = NewtonOutcome::stalled;
          newton.reason  = "load factor 1 was found off the path";
        }
      if (newton.outcome != NewtonOutcome::converged)
        return false;
      accept(landed);
      return true;
    }

    template <int dim>
    void Path<dim>::accept(PathVector &trial)
    {
      std::swap(here, trial);
      here.x.update_ghost_values();
      state = here.x;
      state.update_ghost_values();
      control.tangent_solver.certify(here.x, here.load);
      report.pivot_excess = control.tangent_solver.statistics().pivot_excess;
      report.load         = here.load;
      report.size         = size;
      ++report.load_steps;
      control.callbacks.converged(
          {report.load_steps, here.load, newton, size, clock.total(), report.pivot_excess}, here.x);
      clock = Stopwatch();
    }

    template <int dim>
    bool Path<dim>::has_ended() const
    {
      return here.load == 1.
             || (options.path_displacement > 0.
                 && largest_displacement() >= options.path_displacement);
    }

    template <int dim>
    MarchReport Path<dim>::follow(const MarchState &begin)
    {
      report = begin.report;
      if (begin.state.size() > 0)
        {
          here = {begin.state, report.load};
          here.x.update_ghost_values();
          state = here.x;
          state.update_ghost_values();
          step_control.resume(begin.next_step);
        }
      if (begin.path_history)
        {
          tangent            = {begin.path_history->tangent, begin.path_history->tangent_load};
          has_tangent        = true;
          displacement_scale = begin.path_history->displacement_scale;
        }
      // Some materials are not at rest without a load.
      newton = control.solve(here.load, here.x, size, CurvatureFilter::none);
      report.newton_iterations += newton.iterations;
      if (newton.outcome != NewtonOutcome::converged)
        report.reason = "no equilibrium to begin with: " + newton.reason;

      PathVector trial = here;
      while (report.reason.empty() && !has_ended())
        {
          if (report.load_steps == options.path_steps)
            {
              report.reason = "the path has not ended after " + std::to_string(options.path_steps)
                              + " steps (Path steps), at load factor " + std::to_string(here.load);
              break;
            }
          if (!find_tangent())
            break;
          while (true)
            {
              try_step(trial);
              report.newton_iterations += newton.iterations;
              const unsigned int iterations = newton.iterations;
              bool               succeeded  = newton.outcome == NewtonOutcome::converged;
              if (succeeded && here.load < 1. && trial.load >= 1.)
                succeeded = land_on_full_load(trial);
              else if (succeeded)
                accept(trial);
              if (succeeded)
                {
                  step_control.succeeded(iterations);
                  if (control.callbacks.resumable && !has_ended())
                    control.callbacks.resumable(
                        {report,
                         here.x,
                         step_control.step(),
                         {},
                         MarchState::PathHistory{tangent.x, tangent.load, displacement_scale}});
                  break;
                }
              if (newton.outcome == NewtonOutcome::interrupted)
                break;
              ++report.failed_steps;
              const double step = step_control.step();
              if (!step_control.failed(step))
                {
                  report.reason
                      = describe_failure(newton, size, control.tangent_solver.statistics())
                        + describe_minimum(here.load, step, options.minimum_step);
                  break;
                }
              control.callbacks.failed(trial.load, newton, step_control.step());
            }
          if (newton.outcome == NewtonOutcome::interrupted
              || (!has_ended() && control.callbacks.interrupted()))
            {
              report.status = RunStatus::interrupted;
              report.reason = "interrupted after load factor " + std::to_string(here.load);
              return report;
            }
        }
      control.finish(here.x, report);
      return report;
    }
  } // namespace

  template <int dim>
  MarchReport march_along_path(const LoadControl<dim> &control,
                               const SteppingOptions  &stepping,
                               Vector                 &state,
                               const MarchState       &begin)
  {
    return Path<dim>(control, stepping, state).follow(begin);
  }

  template MarchReport
  march_along_path(const LoadControl<2> &, const SteppingOptions &, Vector &, const MarchState &);
  template MarchReport
  march_along_path(const LoadControl<3> &, const SteppingOptions &, Vector &, const MarchState &);
} // namespace isochor
