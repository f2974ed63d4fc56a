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

    /// How exactly to solve the next linear system: as well as Newton's method does, which is
    /// quadratic once it is close, and not far below its target. The second choice of Eisenstat
    /// and Walker (SIAM J. Sci. Comput. 17, 1996) with their safeguard: not much less than the
    /// square of the term before.
    double forcing_term(const double               before,
                        const double               merit_before,
                        const NewtonProblem::Size &size,
                        const double               largest)
    {
      constexpr double gamma     = 0.9;
      const double     ratio     = size.merit / merit_before;
      double           term      = gamma * ratio * ratio;
      const double     safeguard = gamma * before * before;
      if (safeguard > 0.1)
        term = std::max(term, safeguard);
      // Written so that NaN gives the largest.
      term = term < largest ? term : largest;
      return std::max(term, std::min(0.1, 0.5 * size.target / size.merit));
    }
  } // namespace

  NewtonReport newton(const NewtonProblem &problem, const NewtonOptions &options, Vector &x)
  {
    NewtonReport report;
    Vector       residual(x.get_partitioner()), trial_residual(residual), step(residual);
    Vector       trial(x);

    NewtonProblem::Size size = problem.residual(x, residual);
    if (!size.admissible || !std::isfinite(size.merit))
      return finished(report, NewtonOutcome::inverted, "the initial state has inverted cells");

    // The iterate of the smallest residual so far, and how many iterations ago that was.
    Vector              best(x), best_residual(residual);
    NewtonProblem::Size best_size  = size;
    unsigned int        since_best = 0;
    // Only steps that reduce the residual are taken.
    bool   strict  = false;
    double forcing = options.largest_linear_tolerance, merit_before = 0.;

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

        forcing      = forcing_term(forcing, merit_before, size, options.largest_linear_tolerance);
        merit_before = size.merit;
        const auto correction = problem.correction(x, residual, forcing, step);
        ++report.iterations;
        if (!correction.succeeded)
          return finished(report, NewtonOutcome::linear, correction.failure);

        double              length         = 1.;
        bool                was_admissible = false;
        NewtonProblem::Size trial_size;
        unsigned int        halving = 0;
        for (; halving <= options.max_halvings; ++halving, length *= 0.5)
          {
            trial = x;
            trial.add(length, step);
            trial_size            = problem.residual(trial, trial_residual);
            const bool admissible = trial_size.admissible && std::isfinite(trial_size.merit);
            was_admissible |= admissible;
            const bool reduced = trial_size.merit <= trial_size.target
                                 || trial_size.merit < (1. - 1e-4 * length) * size.merit;
            if (admissible && (reduced || !strict || size.gap > 0.))
              break;
          }
        report.halvings += halving;
        if (halving > options.max_halvings)
          return was_admissible
                     ? finished(report,
                                NewtonOutcome::stalled,
                                "the line search found no step that reduces the residual")
                     : finished(report,
                                NewtonOutcome::inverted,
                                "every step of the line search inverts a cell");

        // While prescribed values move, residuals of different boundary positions do not compare.
        const bool comparable = size.gap == 0.;
        x.swap(trial);
        residual.swap(trial_residual);
        size = trial_size;
        if (problem.accepted(report.iterations, size, length))
          return finished(report, NewtonOutcome::interrupted, "interrupted");

        if (!comparable || size.merit < best_size.merit)
          {
            best          = x;
            best_residual = residual;
            best_size     = size;
            since_best    = 0;
            strict        = false;
          }
        else if (++since_best == options.patience)
          {
            x          = best;
            residual   = best_residual;
            size       = best_size;
            since_best = 0;
            strict     = true;
          }
      }
  }
} // namespace isochor
