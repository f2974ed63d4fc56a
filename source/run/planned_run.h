#pragma once

// One run of a study, from its parameters.

#include <isochor/run/study.h>
#include <isochor/run/study_plan.h>

namespace isochor
{
  /// Set @p prm to the values of one planned run. Throws UserError.
  void read_run(dealii::ParameterHandler &prm,
                const Invocation         &invocation,
                const Assignments        &assignments);

  /// Throws UserError. Collective.
  RunResult run_planned(const Invocation  &invocation,
                        const Assignments &assignments,
                        const RunSettings &settings);
} // namespace isochor
