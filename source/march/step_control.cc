#include <isochor/core/patterns.h>
#include <isochor/core/text.h>
#include <isochor/march/step_control.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  void SteppingOptions::declare(dealii::ParameterHandler &prm)
  {
    const SteppingOptions defaults;
    prm.declare_entry("Stepping",
                      stepping_names.name(defaults.kind),
                      dealii::Patterns::Selection(stepping_names.selection()),
                      "fixed: Load steps equal steps; one that fails is halved, and steps grow "
                      "again up to this size. adaptive: the first step is 1 / Load steps; the "
                      "others follow Newton's iterations, larger after few, smaller after many. "
                      "arc length: along the path of equilibria, through limit points at which "
                      "the load factor falls; the first step is 1 / Load steps, the path ends "
                      "where the load factor first reaches 1, or at Path displacement.");
    prm.declare_entry("Load steps",
                      std::to_string(defaults.load_steps),
                      dealii::Patterns::Integer(1, 1000000),
                      "Number of equal steps in which the load factor goes from 0 to 1; for the "
                      "other ways of stepping, 1 / first step.");
    prm.declare_entry("Minimum load step",
                      "1e-3",
                      dealii::Patterns::Double(1e-12, 1.),
                      "Smallest step of the load factor; below it the run ends as not "
                      "converged. No unit. (Arc length is in units of the load factor at the "
                      "start of the path.)");
    prm.declare_entry("Extrapolation",
                      defaults.extrapolates ? "true" : "false",
                      dealii::Patterns::Bool(),
                      "Start Newton from the straight line through the last two states, where "
                      "that leaves smaller unbalanced forces than the last state.");
    prm.declare_entry("Target Newton iterations",
                      std::to_string(defaults.target_iterations),
                      dealii::Patterns::Integer(1, 1000),
                      "Stepping = adaptive, arc length: the iterations that a step should take.");
    prm.declare_entry("Path steps",
                      std::to_string(defaults.path_steps),
                      dealii::Patterns::Integer(1, 1000000),
                      "Stepping = arc length: most steps; a path that has not ended by then ends "
                      "as not converged.");
    prm.declare_entry("Curvature filter",
                      curvature_filter_names.name(defaults.filter),
                      dealii::Patterns::Selection(curvature_filter_names.selection()),
                      "For a Newton iteration at which the tangent has negative pivots too many: "
                      "negative eigenvalues of dP/dF at the quadrature points become zero "
                      "(projected) or positive (absolute), so that the step leads to smaller "
                      "energies; at most 15 times a load step. Where no length of a step will "
                      "do, the filter is tried, and absolute after projected. none, and Stepping = "
                      "arc length: Newton's own step.");
    prm.declare_entry("Path displacement",
                      to_text(defaults.path_displacement),
                      NumberPattern::at_least(0),
                      "Stepping = arc length: the path ends after the step on which a node has "
                      "moved this far, m; 0: wherever the load factor reaches 1.");
  }

  void SteppingOptions::parse(dealii::ParameterHandler &prm)
  {
    kind              = stepping_names.value(prm.get("Stepping"), "Method/Stepping");
    load_steps        = prm.get_integer("Load steps");
    minimum_step      = prm.get_double("Minimum load step");
    extrapolates      = prm.get_bool("Extrapolation");
    target_iterations = prm.get_integer("Target Newton iterations");
    filter = curvature_filter_names.value(prm.get("Curvature filter"), "Method/Curvature filter");
    path_steps        = prm.get_integer("Path steps");
    path_displacement = parse_number(prm.get("Path displacement"), "Method/Path displacement");
  }

  StepControl::StepControl(const SteppingOptions &options)
    : options(options)
    , next(1. / options.load_steps)
  {
  }

  void StepControl::succeeded(const unsigned int iterations)
  {
    if (options.kind == Stepping::fixed)
      {
        next = std::min(2. * next, 1. / options.load_steps);
        return;
      }
    const double ratio = double(options.target_iterations) / std::max(iterations, 1u);
    next *= std::clamp(std::sqrt(ratio), 0.5, 2.);
    next = std::max(next, options.minimum_step);
  }

  bool StepControl::failed(const double size)
  {
    next = 0.5 * size;
    return next >= options.minimum_step;
  }
} // namespace isochor
