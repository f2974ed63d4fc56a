#pragma once

// How results are written down: the columns of results.csv, and the console tables.

#include <isochor/output/results_csv.h>
#include <isochor/run/run.h>
#include <isochor/run/study_plan.h>

namespace isochor
{
  /// Errors of one run's probes against its reference; empty where there is none.
  struct ProbeErrors
  {
    std::vector<std::optional<double>> error;       ///< |value - reference| / |reference|
    std::vector<std::optional<double>> uncertainty; ///< of the reference, in the same measure
  };

  /// @p reference and @p check may be null. Components of one vector probe are measured against
  /// the length of the reference vector, since a component alone may be nearly zero.
  ProbeErrors compare(const RunResult                     &result,
                      const RunResult                     *reference,
                      const RunResult                     *check,
                      const std::map<std::string, double> &known_values);

  /// Columns of the dual ascent's iterations, empty without one.
  ResultRow dual_columns(const std::optional<DualReport> &dual);

  /// One row of results.csv; the columns are the same for all runs of a study.
  ResultRow result_row(const StudyPlan                &plan,
                       const PlannedRun               &planned,
                       const RunResult                &result,
                       const ProbeErrors              &errors,
                       const std::vector<ProbeColumn> &probe_columns);

  /// What tables and comparisons need of the result that @p row of results.csv tells of.
  RunResult result_of_row(const ResultRow &row);

  /// The final console table.
  std::string study_table(const StudyPlan                &plan,
                          const std::vector<RunResult>   &results,
                          const std::vector<ProbeErrors> &errors,
                          const std::vector<ProbeColumn> &probe_columns);

  /// The summary of a single run.
  std::string run_summary(const RunResult &result);
} // namespace isochor
