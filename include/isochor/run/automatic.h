#pragma once

// Element = auto: model no more than the scene needs. Cheap runs on coarse meshes show how large the
// discretisation error of one probe is and what each element costs; the cheapest candidate that is
// expected to meet the accuracy asked for is run, and its estimate checked. An error is seen by the run
// itself (run/error_estimate.h) and by the difference to a coarser one.
//
// The runs are a chain: each begins with the equilibrium of the one before, interpolated, so that
// the load is stepped up on the coarsest mesh only.

#include <isochor/run/method.h>
#include <isochor/run/run.h>

namespace isochor
{
  struct AutomaticOptions
  {
    double      accuracy = 0.01; ///< relative error of the probe
    std::string probe;           ///< name; empty: the scene's first

    static void             declare(dealii::ParameterHandler &prm);
    static AutomaticOptions parse(dealii::ParameterHandler &prm);
  };

  /// Run @p scene with an element and a mesh that meet @p options; everything else is @p method's.
  /// The result is the chosen run's, its seconds those of all runs; automatic.csv in the folder of @p
  /// settings tells of each. Throws UserError as run() does, or for a mesh whose edge length cannot be
  /// chosen. Collective.
  template <int dim>
  RunResult run_automatic(const Scene<dim>       &scene,
                          const Method           &method,
                          const RunSettings      &settings,
                          const AutomaticOptions &options);
} // namespace isochor
