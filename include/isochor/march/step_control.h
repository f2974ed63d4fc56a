#pragma once

// How far the load factor, or the arc length, goes in one step.

#include <isochor/form/curvature_filter.h>

#include <algorithm>
#include <string>

namespace dealii
{
  class ParameterHandler;
}

namespace isochor
{
  enum class Stepping
  {
    fixed,     ///< equal steps of the load factor
    adaptive,  ///< steps of the load factor by Newton's iterations
    arc_length ///< along the path of equilibria, on which the load factor may fall
  };
  inline constexpr auto stepping_names
      = name_table<Stepping>({{Stepping::fixed, "fixed"},
                              {Stepping::adaptive, "adaptive"},
                              {Stepping::arc_length, "arc length"}});

  struct SteppingOptions
  {
    unsigned int load_steps        = 1;
    double       minimum_step      = 1e-3; ///< of the load factor
    Stepping     kind              = Stepping::fixed;
    bool         extrapolates      = true; ///< start Newton from the last two states
    unsigned int target_iterations = 6;    ///< of Newton per step, unless fixed
    unsigned int path_steps        = 500;  ///< of arc length at most
    double       path_displacement = 0;    ///< end of the path, m; 0: none
    /// Under load control, where a tangent has negative pivots too many.
    CurvatureFilter filter = CurvatureFilter::projected;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
  };

  /// The size of the next step: in units of the load factor, or of arc length that starts like it.
  class StepControl
  {
  public:
    explicit StepControl(const SteppingOptions &options);

    /// Go on with a step of this size.
    void resume(const double step)
    {
      next = options.kind == Stepping::fixed ? std::min(step, 1. / options.load_steps) : step;
    }

    double step() const
    {
      return next;
    }
    /// After a step that took Newton so many @p iterations.
    void succeeded(unsigned int iterations);
    /// After a failed step of @p size, which may have been less than step(): false if half of
    /// it is below the minimum.
    bool failed(double size);

  private:
    SteppingOptions options;
    double          next;
  };
} // namespace isochor
