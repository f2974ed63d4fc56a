#include "trials.h"

#include <isochor/core/text.h>
#include <isochor/mesh/generator.h>
#include <isochor/mesh/geo_constant.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /// Edge length of the scene's mesh over that of the first pilots', of a generator's body and of
    /// one whose shape a coarse mesh spoils; a pilot that fails is followed by finer ones, up to the
    /// scene's own mesh.
    constexpr double coarsest_generated = 0.125, coarsest_meshed = 0.25, finest_pilot = 1.;
    /// From pilot to pilot, and bounds of what a prediction asks for.
    constexpr double pilot_step = 1.5, largest_step = 1.6, smallest_step = 1.4;
    /// A pilot that takes longer than this many times the one before is given up.
    constexpr double patience = 3.;
    /// Of a run that begins near its equilibrium, as those of the chain do if nothing fails.
    constexpr double newton_iterations_nearby = 5.;
    /// Part of a run's seconds from which on its mesh is what is dear about it.
    constexpr double mesh_share = 0.5;
    /// Of the body's size: with larger displacements small strain is not even tried.
    constexpr double small_displacement = 0.05;
    /// Part of the accuracy that a prediction aims at: no mesh is quite what was asked for.
    constexpr double       aim              = 0.8;
    constexpr unsigned int most_refinements = 5;
    /// Another element is tried if the next run is expected to cost this many times what the last did.
    constexpr double dear = 6.;
    /// Small strain is good enough if it changes the probe by less than this part of the accuracy.
    constexpr double small_strain_share = 0.25;

    template <int dim>
    class Search
    {
    public:
      explicit Search(Trials<dim> &trials)
        : trials(trials)
        , accuracy(trials.options.accuracy)
      {
      }

      /// Number of the run to choose; the last one, if that has not converged.
      std::size_t find()
      {
        if (const auto last = pilots())
          return refine(*last);
        return trials.size() - 1;
      }

    private:
      /// Stable mixed elements that @p condition holds for, on cells that the mesh can have.
      template <typename Condition>
      std::vector<const Element *> stable_elements(const Condition &condition) const
      {
        std::vector<const Element *> found;
        for (const Element &element : element_table())
          if (element.is_mixed() && element.is_stable && condition(element)
              && (element.kind == CellKind::simplex || offers_hypercubes(trials.scene.mesh)))
            found.push_back(&element);
        return found;
      }

      /// Number of the run with this @p wish; none if it has not converged.
      std::optional<std::size_t> converged(const typename Trials<dim>::Wish &wish)
      {
        const std::size_t k = trials.make(wish);
        if (trials[k].converged())
          return k;
        is_over = !can_go_on(k);
        return {};
      }

      /// Runs on coarse meshes. Number of the last one, of the element to go on with; none if no run
      /// has converged.
      std::optional<std::size_t> pilots()
      {
        std::optional<std::size_t> lowest, lead;
        double                     refinement
            = is_generator(trials.scene.mesh.source) ? coarsest_generated : coarsest_meshed;
        for (; refinement <= finest_pilot && !lead && !is_over; refinement *= pilot_step)
          {
            // Newton's long way from rest in steps is cheapest with few unknowns.
            if (!lowest && trials.goes_in_steps())
              lowest = converged({lowest_order(), refinement, {}});
            if (!is_over)
              lead = quadratic_pilot(refinement);
          }
        if (!lead || is_over)
          return {};
        trials.estimate(*lead);
        if (lowest)
          {
            trials[*lowest].verdict = "pilot";
            if (const auto bound = difference_by_order(*lowest, *lead))
              trials[*lead].estimate = std::min(trials[*lead].estimate.value_or(*bound), *bound);
          }
        if (is_enough(*lead))
          return lead;
        trials[*lead].verdict = "pilot";
        choose_strain(*lead);
        if (const auto second = converged({trials[*lead].element, refinement, energy}))
          return second;
        failed_refinement = refinement;
        return is_over ? std::nullopt : lead;
      }

      /// A stable one: from the equilibrium of Q1-P0 the quadratic elements did not always find theirs.
      const Element *lowest_order() const
      {
        return stable_elements([](const Element &element) {
                 return element.displacement.degree == 1 && !element.has_bubble();
               })
            .front();
      }

      /// Hexahedra first: of equal cost they are the more accurate ones. Others, too, where it is the
      /// mesh that is dear.
      std::optional<std::size_t> quadratic_pilot(const double refinement)
      {
        auto elements = stable_elements(
            [](const Element &element) { return element.displacement.degree == 2; });
        std::ranges::stable_partition(
            elements, [](const Element *element) { return element->kind == CellKind::hypercube; });
        std::optional<std::size_t> best;
        for (const Element *element : elements)
          {
            if (is_over || (best && !is_mesh_dear(*best)))
              break;
            const double limit = best ? patience * trials[*best].trial.seconds : 0.;
            const auto   k     = converged({element, refinement, {}, true, limit});
            if (k)
              best = best ? cheaper(*best, *k) : *k;
          }
        return best;
      }

      /// Of two elements with equal meshes the one of lower order errs more: by about as much as they
      /// differ, so that the other one errs by no more than that. None if the meshes differ, or if the
      /// values are equal: zero, for example, is what a mesh cannot show.
      std::optional<double> difference_by_order(const std::size_t lower,
                                                const std::size_t higher) const
      {
        const Trial &low = trials[lower].trial, &high = trials[higher].trial;
        if (low.refinement != high.refinement)
          return {};
        const double difference = relative_difference(low.values, high.values);
        return difference > 0 ? std::optional(difference) : std::nullopt;
      }

      bool is_enough(const std::size_t k) const
      {
        return trials[k].estimate && *trials[k].estimate <= accuracy;
      }

      bool is_mesh_dear(const std::size_t k) const
      {
        const RunResult &result = trials[k].result;
        return result.seconds[static_cast<std::size_t>(Phase::mesh)]
               > mesh_share * result.seconds_total;
      }

      std::size_t cheaper(const std::size_t a, const std::size_t b)
      {
        const bool        is_a = trials[a].trial.seconds <= trials[b].trial.seconds;
        const std::size_t best = is_a ? a : b, other = is_a ? b : a;
        trials[other].verdict = "rejected: dearer than " + trials[best].trial.element;
        return best;
      }

      /// A mesh too coarse may fail; what the user has stopped or only wants checked is no failure.
      bool can_go_on(const std::size_t k) const
      {
        return trials[k].result.status == refused || trials[k].result.status == left_out
               || trials[k].result.status == run_status_names.name(RunStatus::not_converged);
      }

      void choose_strain(const std::size_t finite)
      {
        const Energy own = trials.scene.material.energy;
        if (own == Energy::linear || own == Energy::linear_as_printed
            || trials.scene.material.kappa != KappaConvention::consistent
            || trials.largest_displacement() > small_displacement)
          return;
        // Both energies leave the same part of the stress to the pressure, so that on a coarse mesh,
        // too, they differ by strain alone.
        const Trial      &at         = trials[finite].trial;
        const Element    *element    = trials[finite].element;
        const double      refinement = at.refinement;
        const std::size_t large = trials.make({element, refinement, Energy::bonet_wood, false});
        const std::size_t small = trials.make({element, refinement, hookes_law, false});
        if (!trials[large].converged() || !trials[small].converged())
          return;
        const double change
            = relative_difference(trials[small].trial.values, trials[large].trial.values);
        const bool is_small = change < small_strain_share * accuracy;
        if (is_small)
          energy = hookes_law;
        trials[large].verdict = "to compare small strain with";
        trials[small].verdict = (is_small ? "pilot: finite strain changes the probe by "
                                          : "rejected: finite strain changes the probe by ")
                                + percent(change);
      }

      /// From run @p best on until its estimate is what is asked for.
      std::size_t refine(std::size_t best)
      {
        trials.estimate(best);
        for (unsigned int n_solved = 0, n_tried = 0;
             !is_enough(best) && n_solved < most_refinements && n_tried < 2 * most_refinements;
             ++n_tried)
          {
            if (const auto other = try_others(best))
              {
                trials[best].verdict = "pilot";
                best                 = *other;
              }
            const auto wish = next_wish(best);
            if (!wish)
              break;
            const std::size_t finer = trials.make(*wish);
            n_solved += trials[finer].result.status != left_out;
            if (!trials[finer].converged())
              {
                if (!can_go_on(finer))
                  return finer;
                if (trials[finer].result.reason.starts_with(time_limit_words))
                  break; // a finer mesh would take longer
                failed_refinement = trials[finer].trial.refinement;
                continue;
              }
            trials[best].verdict = "pilot";
            trials.estimate(finer);
            best = finer;
          }
        return best;
      }

      Prediction predicted(const std::size_t k, const double growth) const
      {
        return predict(from_nearby(k), trials[k].estimate.value_or(1.), aim * accuracy, growth);
      }

      /// Run @p k, as if it had begun near its equilibrium: a way from rest says nothing of the next run.
      Trial from_nearby(const std::size_t k) const
      {
        Trial        trial      = trials[k].trial;
        const double iterations = trials[k].result.march.newton_iterations;
        trial.seconds *= std::min(1., newton_iterations_nearby / std::max(1., iterations));
        return trial;
      }

      /// The run after run @p k; none if it would take longer than a run may.
      std::optional<typename Trials<dim>::Wish> next_wish(const std::size_t k) const
      {
        const Trial &now   = trials[k].trial;
        const double least = smallest_step * std::max(1., failed_refinement / now.refinement);
        double       step  = std::clamp(
            predicted(k, dim).refinement / now.refinement, smallest_step, largest_step);
        if (const double limit = trials.time_limit(); limit > 0)
          {
            const double most = finest_step(from_nearby(k), limit, trials.growth(k));
            if (most < least)
              return {};
            step = std::min(step, most);
          }
        return typename Trials<dim>::Wish{
            trials[k].element, now.refinement * std::max(step, least), energy};
      }

      /// Before a dear run: other elements on meshes of about as many unknowns as run @p best has.
      /// Number of the one that promises the accuracy for less, if there is one.
      std::optional<std::size_t> try_others(const std::size_t best)
      {
        if (has_tried_others || !trials[best].estimate || !trials.coarser_than(best))
          return {};
        const double growth   = trials.growth(best);
        Prediction   cheapest = predicted(best, growth);
        if (cheapest.seconds < dear * from_nearby(best).seconds)
          return {};
        has_tried_others = true;

        const double               lead_seconds = cheapest.seconds;
        const Attempt              lead         = trials[best];
        const std::vector<double>  limit        = extrapolated(best);
        std::optional<std::size_t> found;
        const auto                 others = stable_elements([&](const Element &element) {
          return element.kind == lead.element->kind && !element.has_bubble()
                 && element.displacement.degree != lead.element->displacement.degree;
        });
        for (const Element *element : others)
          {
            const double      degree = element->displacement.degree;
            const std::size_t k      = trials.make({element,
                                                    lead.trial.refinement * lead.trial.degree / degree,
                                                    energy,
                                                    false,
                                                    patience * lead.trial.seconds});
            if (!trials[k].converged())
              continue;
            trials[k].estimate = relative_difference(trials[k].trial.values, limit)
                                 + 0.25 * lead.estimate.value_or(1.);
            const Prediction prediction = predicted(k, growth);
            trials[k].verdict = "rejected: would take " + rounded(prediction.seconds, 2) + " s, "
                                + lead.trial.element + " " + rounded(lead_seconds, 2);
            if (prediction.seconds < cheapest.seconds)
              {
                cheapest          = prediction;
                found             = k;
                trials[k].verdict = "pilot";
              }
          }
        return found;
      }

      /// Where the values of run @p fine and the coarser one point to.
      std::vector<double> extrapolated(const std::size_t fine) const
      {
        std::vector<double> limit = trials[fine].trial.values;
        if (const auto coarse = trials.coarser_than(fine))
          {
            const double change
                = relative_difference(trials[*coarse].trial.values, trials[fine].trial.values);
            const double share = change > 0 ? *trials[fine].estimate / change : 0.;
            for (std::size_t c = 0; c < limit.size(); ++c)
              limit[c] += share * (limit[c] - trials[*coarse].trial.values[c]);
          }
        return limit;
      }

      Trials<dim>          &trials;
      const double          accuracy;
      std::optional<Energy> energy;          ///< small strain, if that is enough
      bool                  is_over = false; ///< the user has stopped it, or only wants checks
      bool                  has_tried_others  = false;
      double                failed_refinement = 0; ///< of the last mesh on which a run failed
    };
  } // namespace

  void AutomaticOptions::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Method");
    prm.declare_entry("Accuracy",
                      "1%",
                      dealii::Patterns::Anything(),
                      "Element = auto: relative error of the probe that is allowed, a number or a "
                      "percentage, above 0 and below 1. No unit.");
    prm.declare_entry("Accuracy of",
                      "",
                      dealii::Patterns::Anything(),
                      "Element = auto: name of the probe that must be that accurate. Empty: the "
                      "first one in Scene/Probes.");
    prm.leave_subsection();
  }

  AutomaticOptions AutomaticOptions::parse(dealii::ParameterHandler &prm)
  {
    AutomaticOptions options;
    prm.enter_subsection("Method");
    const std::string written = trim(prm.get("Accuracy")), what = "Method/Accuracy";
    const bool        is_percentage = written.ends_with('%');
    options.accuracy = parse_number(trim(written.substr(0, written.size() - is_percentage)), what)
                       * (is_percentage ? 0.01 : 1.);
    if (!(options.accuracy > 0 && options.accuracy < 1))
      throw UserError(what + ": '" + written
                      + "' is not allowed; choose a number or a percentage above 0 and below 1, as "
                        "0.01 or 1%");
    options.probe = trim(prm.get("Accuracy of"));
    prm.leave_subsection();
    return options;
  }

  template <int dim>
  RunResult run_automatic(const Scene<dim>       &scene,
                          const Method           &method,
                          const RunSettings      &settings,
                          const AutomaticOptions &options)
  {
    Trials<dim>       trials(scene, method, settings, options);
    const std::size_t chosen = Search<dim>(trials).find();
    return trials.finish(chosen);
  }

  template RunResult
  run_automatic(const Scene<2> &, const Method &, const RunSettings &, const AutomaticOptions &);
  template RunResult
  run_automatic(const Scene<3> &, const Method &, const RunSettings &, const AutomaticOptions &);
} // namespace isochor
