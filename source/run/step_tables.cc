#include <isochor/run/result_rows.h>
#include <isochor/run/step_tables.h>

namespace isochor
{
  namespace
  {
    const std::string step_column = "step", so_far_column = "iterations so far";

    const std::string &value(const ResultRow &row, const std::string &column)
    {
      for (const auto &[name, text] : row)
        if (name == column)
          return text;
      throw std::runtime_error("no column '" + column + "' in a table to go on with");
    }

    /// The rows of @p file that belong to the first @p n_steps.
    std::vector<ResultRow> kept_rows(const std::filesystem::path &file, const unsigned int n_steps)
    {
      if (n_steps == 0)
        return {};
      auto rows = read_results(file);
      std::erase_if(rows, [&](const ResultRow &row) {
        return std::stoul(value(row, step_column)) > n_steps;
      });
      return rows;
    }

    std::filesystem::path steps_file(const RunSettings &settings)
    {
      return settings.folder / "steps.csv";
    }
    std::filesystem::path iterations_file(const RunSettings &settings)
    {
      return settings.folder / "iterations.csv";
    }
  } // namespace

  StepTable::StepTable(const RunSettings              &settings,
                       const std::vector<ProbeColumn> &columns,
                       const unsigned int              n_kept)
    : columns(columns)
    , csv(settings.communicator, steps_file(settings), kept_rows(steps_file(settings), n_kept))
  {
  }

  void StepTable::add(const LoadStep                  &step,
                      const std::optional<DualReport> &dual,
                      const std::vector<double>       &values)
  {
    ResultRow row
        = {{step_column, std::to_string(step.number)},
           {"load factor", csv_number(step.load)},
           {"newton iterations", std::to_string(step.newton.iterations)},
           {"residual", csv_number(step.newton.merit)},
           {"min J", csv_number(step.size.min_jacobian)},
           {"negative pivots excess", step.pivot_excess ? std::to_string(*step.pivot_excess) : ""},
           {"seconds", csv_number(step.seconds)}};
    for (const auto &[name, count] : dual_columns(dual))
      row.emplace_back(name, count);
    for (std::size_t k = 0; k < columns.size(); ++k)
      row.emplace_back(columns[k].title(), csv_number(values[k]));
    csv.add(row);
  }

  IterationTable::IterationTable(const RunSettings &settings, const unsigned int n_kept)
    : IterationTable(settings, n_kept, kept_rows(iterations_file(settings), n_kept))
  {
  }

  IterationTable::IterationTable(const RunSettings            &settings,
                                 const unsigned int            n_kept,
                                 const std::vector<ResultRow> &kept)
    : n_steps(n_kept)
    , n_iterations(kept.empty() ? 0 : std::stoul(value(kept.back(), so_far_column)))
    , csv(settings.communicator, iterations_file(settings), kept)
  {
  }

  void IterationTable::add(const double load, const NewtonReport &newton, const DualReport *dual)
  {
    const bool converged = newton.outcome == NewtonOutcome::converged;
    for (std::size_t k = 0; k < newton.iterates.size(); ++k)
      {
        const NewtonIterate &at = newton.iterates[k];
        csv.add({{step_column, std::to_string(n_steps + 1)},
                 {"load factor", csv_number(load)},
                 {"iteration", std::to_string(at.iteration)},
                 {so_far_column, std::to_string(n_iterations + at.iteration)},
                 {"residual", csv_number(at.size.merit)},
                 {"target", csv_number(at.size.target)},
                 {"step length", csv_number(at.step_length)},
                 {"gap [m]", csv_number(at.size.gap)},
                 {"volume error", dual ? csv_number(dual->volume_errors[k]) : ""},
                 {"outcome", converged ? "converged" : "failed"}});
      }
    n_iterations += dual ? dual->iterations : newton.iterations;
  }
} // namespace isochor
