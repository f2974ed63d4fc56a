#include <isochor/solver/newton.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <sstream>

namespace isochor
{
  void NewtonOptions::declare(dealii::ParameterHandler &prm)
  {
    const NewtonOptions defaults;
    prm.declare_entry("Newton tolerance",
                      "1e-8",
                      dealii::Patterns::Double(1e-14, 1e-1),
                      "Newton stops when the unbalanced forces are this small against the forces "
                      "that act (loads or reactions), and the volume constraint against the "
                      "volume, or when both are at the level of rounding. No unit.");
    prm.declare_entry("Maximum Newton iterations",
                      std::to_string(defaults.max_iterations),
                      dealii::Patterns::Integer(1, 10000),
                      "Per load step; a step that needs more is halved.");
  }

  void NewtonOptions::parse(dealii::ParameterHandler &prm)
  {
    tolerance      = prm.get_double("Newton tolerance");
    max_iterations = prm.get_integer("Maximum Newton iterations");
  }

  namespace
  {
    NewtonReport finished(NewtonReport report, const NewtonOutcome outcome, const std::string &why)
    {
      report.outcome = outcome;
      report.reason  = why;
      return report;
    }

    /// Norms of the displacement and pressure parts cannot be compared, but a step and its
    /// simplified successor can: the ratio of Euclidean norms is what the natural test needs.
    bool natural_test(const NewtonProblem &problem,
                      const Vector        &residual,
                      const double         step_norm,
                      const double         length,
                      Vector              &simplified)
    {
      if (!problem.simplified_correction(residual, simplified).succeeded)
        return false;
      return simplified.l2_norm() <= (1. - length / 4.) * step_norm;
    }
  } // namespace

  NewtonReport newton(const NewtonProblem &problem, const NewtonOptions &options, Vector &x)
  {
    NewtonReport report;
    Vector       residual(x.get_partitioner()), step(x.get_partitioner()), trial(x), scratch(x);

    NewtonProblem::Size size = problem.residual(x, residual);
    if (!size.admissible || !std::isfinite(size.merit))
      return finished(report, NewtonOutcome::inverted, "the initial state has inverted cells");

    while (true)
      {
        report.merit = size.merit;
        // Written so that NaN goes on, and fails below.
        if (size.gap == 0. && size.merit <= size.target)
          return report;
        if (report.iterations == options.max_iterations)
          {
            std::ostringstream why;
            why << "no convergence in " << report.iterations
                << " Newton iterations (relative residual " << size.merit << ")";
            return finished(report, NewtonOutcome::iterations, why.str());
          }

        const auto correction = problem.correction(x, residual, step);
        ++report.iterations;
        if (!correction.succeeded)
          return finished(report, NewtonOutcome::linear, correction.failure);
        const double step_norm = step.l2_norm();

        // Backtracking. A step is good when it stays admissible and either the residual falls or,
        // since stiff modes make the residual rise on the way to a good state (a bending beam
        // stretches first), the next simplified step is shorter (natural monotonicity test,
        // Deuflhard 2004, section 3.3). While prescribed values move, residuals of different
        // boundary positions cannot be compared and admissibility has to do.
        double length = 1.;
        bool   good = false, was_admissible = false;
        for (unsigned int halving = 0; halving <= options.max_halvings; ++halving)
          {
            trial = x;
            trial.add(length, step);
            const auto trial_size = problem.residual(trial, scratch);
            const bool admissible = trial_size.admissible && std::isfinite(trial_size.merit);
            was_admissible |= admissible;
            if (admissible)
              {
                good = size.gap > 0. || trial_size.merit <= trial_size.target
                       || trial_size.merit < (1. - 1e-4 * length) * size.merit;
                if (!good)
                  {
                    Vector simplified(x.get_partitioner());
                    good = natural_test(problem, scratch, step_norm, length, simplified);
                  }
              }
            if (good)
              {
                x.swap(trial);
                residual.swap(scratch);
                size = trial_size;
                break;
              }
            length *= 0.5;
            ++report.halvings;
          }
        if (!good)
          return was_admissible
                     ? finished(report,
                                NewtonOutcome::stalled,
                                "the line search found no step that improves the residual")
                     : finished(report,
                                NewtonOutcome::inverted,
                                "every step of the line search inverts a cell");
        if (problem.accepted(report.iterations, size, length))
          return finished(report, NewtonOutcome::interrupted, "interrupted");
      }
  }
} // namespace isochor
