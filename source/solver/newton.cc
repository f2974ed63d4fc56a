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
    prm.declare_entry(
        "Maximum Newton iterations",
        std::to_string(defaults.max_iterations),
        dealii::Patterns::Integer(1, 10000),
        "Per load step; a step that needs more is halved. Where the line search first "
        "finds no step that reduces the residual, but one along the filtered tangent, "
        "as many again are allowed.");
  }

  void NewtonOptions::parse(dealii::ParameterHandler &prm)
  {
    tolerance      = prm.get_double("Newton tolerance");
    max_iterations = prm.get_integer("Maximum Newton iterations");
  }

  namespace
  {
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
    struct Iterate
    {
      Vector              x, residual;
      NewtonProblem::Size size;

      bool is_admissible() const
      {
        return size.admissible && std::isfinite(size.merit);
      }
    };

    /// newton() at work.
    class Newton
    {
    public:
      Newton(const NewtonProblem &problem, const NewtonOptions &options, const Vector &x)
        : problem(problem)
        , options(options)
        , here{x, Vector(x.get_partitioner()), {}}
        , step(here.residual)
        , limit(options.max_iterations)
      {
      }

      NewtonReport  run();
      const Vector &solution() const
      {
        return here.x;
      }

    private:
      enum class Search
      {
        found,
        stalled, ///< admissible steps, none of which will do
        inverted
      };

      NewtonReport finished(NewtonOutcome outcome, const std::string &why);
      Search       find_step(const NewtonProblem::Correction &correction);
      template <typename IsGood>
      Search search(const IsGood &is_good);
      void   keep_or_return(bool comparable);

      const NewtonProblem &problem;
      const NewtonOptions &options;
      NewtonReport         report;
      Iterate              here, trial;
      Vector               step;
      double               length        = 0;     ///< of the step to trial
      bool                 strict        = false; ///< only steps that reduce the residual are taken
      bool                 has_descended = false; ///< by the energy, to trial
      // The iterate of the smallest residual so far, and how many iterations ago that was.
      Iterate      best;
      unsigned int since_best = 0;
      double       forcing = 0., merit_before = 0.;
      unsigned int limit; ///< of iterations
    };

    NewtonReport Newton::finished(const NewtonOutcome outcome, const std::string &why)
    {
      report.outcome = outcome;
      report.reason  = why;
      return report;
    }

    /// Shorten the step until it leads to an admissible trial that @p is_good.
    template <typename IsGood>
    Newton::Search Newton::search(const IsGood &is_good)
    {
      bool was_admissible = false;
      length              = 1.;
      for (unsigned int halving = 0; halving <= options.max_halvings; ++halving, length *= 0.5)
        {
          trial.x = here.x;
          trial.x.add(length, step);
          trial.size = problem.residual(trial.x, trial.residual);
          was_admissible |= trial.is_admissible();
          if (trial.is_admissible() && is_good())
            return Search::found;
          ++report.halvings;
        }
      return was_admissible ? Search::stalled : Search::inverted;
    }

    Newton::Search Newton::find_step(const NewtonProblem::Correction &correction)
    {
      constexpr double sufficient = 1e-4;
      has_descended               = false;
      const Search by_residual    = search([&]() {
        return trial.size.merit <= trial.size.target
               || trial.size.merit < (1. - sufficient * length) * here.size.merit || !strict
               || here.size.gap > 0.;
      });
      if (by_residual != Search::stalled || !correction.descends || std::isnan(here.size.energy))
        return by_residual;
      const double slope = here.residual * step;
      if (!(slope < 0.)) // written so that NaN is none
        return by_residual;
      has_descended = true;
      return search(
          [&]() { return trial.size.energy < here.size.energy + sufficient * length * slope; });
    }

    /// @p comparable: here, with the residuals before.
    void Newton::keep_or_return(const bool comparable)
    {
      if (!comparable || here.size.merit < best.size.merit || has_descended)
        {
          best       = here;
          since_best = 0;
          strict     = has_descended;
        }
      else if (++since_best == options.patience)
        {
          here       = best;
          since_best = 0;
          strict     = true;
        }
    }

    NewtonReport Newton::run()
    {
      here.size = problem.residual(here.x, here.residual);
      if (!here.is_admissible())
        return finished(NewtonOutcome::inverted, "the initial state has inverted cells");
      report.iterates.push_back({0, here.size, 0.});
      trial = best = here;
      forcing      = options.largest_linear_tolerance;
      while (true)
        {
          const NewtonProblem::Size &size = here.size;
          report.merit                    = size.merit;
          // Written so that NaN goes on, and fails below.
          if (size.gap == 0. && size.merit <= size.target)
            return report;
          if (report.iterations == limit)
            {
              std::ostringstream why;
              why << "no convergence in " << report.iterations
                  << " Newton iterations (relative residual " << size.merit << ")";
              return finished(NewtonOutcome::iterations, why.str());
            }

          forcing = forcing_term(forcing, merit_before, size, options.largest_linear_tolerance);
          merit_before    = size.merit;
          auto correction = problem.correction(here.x, here.residual, forcing, step);
          ++report.iterations;
          if (!correction.succeeded)
            return finished(NewtonOutcome::linear, correction.failure);

          Search outcome = find_step(correction);
          if (outcome != Search::found && problem.fallback && report.iterations < limit)
            {
              correction = problem.fallback(here.x, here.residual, forcing, step);
              if (correction.succeeded)
                {
                  ++report.iterations;
                  outcome = find_step(correction);
                  report.fallbacks += outcome == Search::found;
                }
            }
          // The way downhill is longer, and a shorter load step would only begin it elsewhere.
          if (limit == options.max_iterations && (has_descended || report.fallbacks > 0))
            limit += report.iterations;
          if (outcome == Search::stalled)
            return finished(NewtonOutcome::stalled,
                            "the line search found no step that reduces the residual");
          if (outcome == Search::inverted)
            return finished(NewtonOutcome::inverted,
                            "every step of the line search inverts a cell");

          // While prescribed values move, residuals of different boundary positions do not compare.
          const bool comparable = size.gap == 0.;
          std::swap(here, trial);
          report.iterates.push_back({report.iterations, here.size, length});
          if (problem.accepted(report.iterations, here.size, length))
            return finished(NewtonOutcome::interrupted, "interrupted");
          keep_or_return(comparable);
        }
    }
  } // namespace

  NewtonReport newton(const NewtonProblem &problem, const NewtonOptions &options, Vector &x)
  {
    Newton             newton(problem, options, x);
    const NewtonReport report = newton.run();
    x                         = newton.solution();
    return report;
  }
} // namespace isochor
