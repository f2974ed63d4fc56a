#pragma once

// How a scene is computed: element, linear solver, Newton, stepping. And where results go.

#include <isochor/element/element_table.h>
#include <isochor/march/quasi_static.h>
#include <isochor/scene/scene.h>
#include <isochor/solver/dual_ascent.h>

namespace isochor
{
  /// Method/Element of a run whose element is to be chosen; run/automatic.h.
  inline constexpr const char *automatic_element = "auto";

  struct Method
  {
    Element           element; ///< any, if it is to be chosen
    ComplianceOptions compliance;
    LinearOptions     linear;
    NewtonOptions     newton;
    SteppingOptions   stepping;
    unsigned int      nested_levels = 0; ///< coarser meshes that are solved on first
    Solver            solver        = Solver::newton;
    DualOptions       dual;
    double            time_limit      = 0;     ///< s; 0: none
    bool              chooses_element = false; ///< Element = auto

    static void   declare(dealii::ParameterHandler &prm);
    static Method parse(dealii::ParameterHandler &prm);
  };

  /// Throws UserError if @p method cannot compute @p material on @p n_ranks ranks, with what can.
  void check_legal(const Method &method, const Material &material, unsigned int n_ranks);

  enum class VtuOutput
  {
    none,
    final_state,
    every_step
  };
  inline constexpr auto vtu_output_names
      = name_table<VtuOutput>({{VtuOutput::none, "none"},
                               {VtuOutput::final_state, "final"},
                               {VtuOutput::every_step, "steps"}});

  struct OutputOptions
  {
    std::string folder; ///< empty: results/<stem of the parameter file>
    VtuOutput   vtu             = VtuOutput::every_step;
    bool        inf_sup         = false; ///< test the pressure's stability
    bool        iterations      = false; ///< write iterations.csv
    bool        error_estimates = false; ///< estimate the errors of probes
    /// Seconds that lie at least between two saved states; none: nothing is saved.
    std::optional<double> checkpoint_interval = 0.;

    static void          declare(dealii::ParameterHandler &prm);
    static OutputOptions parse(dealii::ParameterHandler &prm);
  };
} // namespace isochor
