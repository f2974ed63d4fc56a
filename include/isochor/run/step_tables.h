#pragma once

// The tables that grow while a run is under way: steps.csv and iterations.csv.

#include <isochor/output/results_csv.h>
#include <isochor/run/run.h>

namespace isochor
{
  /// Load-displacement history: steps.csv, a row per converged load step.
  class StepTable
  {
  public:
    /// Of an interrupted run, the rows of its first @p n_kept steps stay. Collective.
    StepTable(const RunSettings              &settings,
              const std::vector<ProbeColumn> &columns,
              unsigned int                    n_kept);

    /// @p values: of the probes. Collective.
    void add(const LoadStep                  &step,
             const std::optional<DualReport> &dual,
             const std::vector<double>       &values);

  private:
    const std::vector<ProbeColumn> &columns;
    ResultsCsv                      csv;
  };

  /// Convergence history: iterations.csv, a row per iterate of every load step that was tried. Those
  /// of a step that failed have the number of the step that it should have become.
  class IterationTable
  {
  public:
    /// As of StepTable. Collective.
    IterationTable(const RunSettings &settings, unsigned int n_kept);

    /// What was tried at @p load; @p dual: of dual ascent, whose iterates those of @p newton are.
    /// Collective.
    void add(double load, const NewtonReport &newton, const DualReport *dual);
    void step_converged()
    {
      ++n_steps;
    }

  private:
    IterationTable(const RunSettings            &settings,
                   unsigned int                  n_kept,
                   const std::vector<ResultRow> &kept);

    unsigned int n_steps;          ///< converged
    unsigned int n_iterations = 0; ///< before the next load step
    ResultsCsv   csv;
  };
} // namespace isochor
