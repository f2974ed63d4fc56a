#include <isochor/core/text.h>
#include <isochor/output/table.h>
#include <isochor/run/result_rows.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    std::string number(const double value, const char *format = "%.5g")
    {
      char text[64];
      std::snprintf(text, sizeof text, format, value);
      return text;
    }

    std::string optional_number(const std::optional<double> &value)
    {
      return value ? csv_number(*value) : "";
    }

    /// Columns of one vector probe share their name up to the last blank: "tip x", "tip y".
    std::string family(const ProbeColumn &column)
    {
      return column.name.substr(0, column.name.rfind(' '));
    }

    /// Length against which column @p k is compared.
    double scale_of(const std::vector<ProbeColumn> &columns,
                    const std::vector<double>      &values,
                    const std::size_t               k)
    {
      double squared = 0;
      for (std::size_t other = 0; other < columns.size(); ++other)
        if (other == k || family(columns[other]) == family(columns[k]))
          squared += values[other] * values[other];
      return std::sqrt(squared);
    }

    /// |J(u) - J(u_h)| / |J(u_h)| of column @p k, if it is known.
    std::optional<double> relative_estimate(const RunResult &result, const std::size_t k)
    {
      if (k >= result.estimated_errors.size() || std::isnan(result.estimated_errors[k]))
        return {};
      const double scale = scale_of(result.probe_columns, result.probe_values, k);
      return scale > 0 ? std::optional(std::abs(result.estimated_errors[k]) / scale) : std::nullopt;
    }

    bool has_values(const RunResult *result)
    {
      return result != nullptr && result->converged();
    }

    double seconds(const RunResult &result, const Phase phase)
    {
      return result.seconds[static_cast<std::size_t>(phase)];
    }
  } // namespace

  ProbeErrors compare(const RunResult                     &result,
                      const RunResult                     *reference,
                      const RunResult                     *check,
                      const std::map<std::string, double> &known_values)
  {
    const std::size_t n = result.probe_columns.size();
    ProbeErrors       errors{std::vector<std::optional<double>>(n),
                       std::vector<std::optional<double>>(n)};
    if (!result.converged())
      return errors;
    for (std::size_t k = 0; k < n; ++k)
      {
        const auto known = known_values.find(result.probe_columns[k].name);
        if (known != known_values.end())
          errors.error[k]
              = std::abs(result.probe_values[k] - known->second) / std::abs(known->second);
        else if (has_values(reference))
          {
            const double scale = scale_of(result.probe_columns, reference->probe_values, k);
            if (!(scale > 0))
              continue;
            errors.error[k] = std::abs(result.probe_values[k] - reference->probe_values[k]) / scale;
            if (has_values(check))
              errors.uncertainty[k]
                  = std::abs(check->probe_values[k] - reference->probe_values[k]) / scale;
          }
      }
    return errors;
  }

  ResultRow dual_columns(const std::optional<DualReport> &dual)
  {
    const auto text = [&](const unsigned int DualReport::*count) {
      return dual && *dual.*count > 0 ? std::to_string(*dual.*count) : "";
    };
    return {{"dual iterations", text(&DualReport::iterations)},
            {"dual iterations to 1 %", text(&DualReport::to_one_percent)},
            {"dual iterations to 0.01 %", text(&DualReport::to_hundredth_percent)}};
  }

  ResultRow result_row(const StudyPlan                &plan,
                       const PlannedRun               &planned,
                       const RunResult                &result,
                       const ProbeErrors              &errors,
                       const std::vector<ProbeColumn> &probe_columns)
  {
    ResultRow  row;
    const auto add
        = [&](const std::string &name, const std::string &value) { row.emplace_back(name, value); };
    for (const std::string &key : plan.keys)
      add(key, planned.assignments.at(key));
    add("cells", std::to_string(result.cells));
    add("unknowns", std::to_string(result.unknowns));
    add("load factor", csv_number(result.march.load));
    add("load steps", std::to_string(result.march.load_steps));
    add("failed steps", std::to_string(result.march.failed_steps));
    add("newton iterations", std::to_string(result.march.newton_iterations));
    add("coarse newton iterations", std::to_string(result.coarse_newton_iterations));
    for (const auto &[name, count] : dual_columns(result.dual))
      add(name, count);
    add("factorisations", std::to_string(result.linear.factorisations));
    add("krylov iterations", std::to_string(result.linear.krylov_iterations));
    for (std::size_t k = 0; k < result.seconds.size(); ++k)
      add("seconds " + name_of(static_cast<Phase>(k)), csv_number(result.seconds[k]));
    add("seconds total", csv_number(result.seconds_total));
    add("predicted factors memory MB", csv_number(result.linear.predicted_megabytes));
    add("factors memory MB", csv_number(result.linear.megabytes));
    add("peak memory MB", csv_number(result.peak_megabytes));
    // A run that did not converge has no probe values to compare; steps.csv has its history.
    for (std::size_t k = 0; k < probe_columns.size(); ++k)
      {
        const bool valid = result.converged();
        add(probe_columns[k].title(), valid ? csv_number(result.probe_values[k]) : "");
        add(probe_columns[k].name + " error", valid ? optional_number(errors.error[k]) : "");
        add(probe_columns[k].name + " reference uncertainty",
            valid ? optional_number(errors.uncertainty[k]) : "");
        if (plan.has_error_estimates)
          add(probe_columns[k].name + " estimated error",
              optional_number(relative_estimate(result, k)));
      }
    const bool has_state = result.cells > 0; // a refused run has none
    add("volume ratio", has_state ? csv_number(result.volume_ratio) : "");
    add("min J", has_state ? csv_number(result.march.size.min_jacobian) : "");
    add("pressure oscillation", optional_number(result.oscillation));
    for (const auto &[name, test] : {std::pair("at rest", &result.inf_sup_at_rest),
                                     std::pair("at the end", &result.inf_sup_at_end)})
      {
        add(std::string("inf-sup constant ") + name, *test ? csv_number((*test)->constant) : "");
        add(std::string("spurious modes ") + name,
            *test ? std::to_string((*test)->spurious_modes) : "");
      }
    if (plan.has_automatic)
      {
        const AutomaticReport *const automatic = result.automatic ? &*result.automatic : nullptr;
        add("auto choice", automatic ? automatic->choice : "");
        add("auto estimated error", automatic ? optional_number(automatic->estimate) : "");
        add("auto trials", automatic ? std::to_string(automatic->trials) : "");
        add("auto seconds chosen", automatic ? csv_number(automatic->seconds_chosen) : "");
      }
    add("min angle [deg]", csv_number(result.quality.min_angle));
    add("max aspect", csv_number(result.quality.max_aspect));
    add("negative pivots excess",
        result.march.pivot_excess ? std::to_string(*result.march.pivot_excess) : "");
    add("null pivots", std::to_string(result.linear.null_pivots));
    add("status", result.status);
    add("reason", result.reason);
    add("role", planned.in_grid ? "run" : "reference");
    return row;
  }

  RunResult result_of_row(const ResultRow &row)
  {
    RunResult  result;
    const auto text = [&](const std::string &name) {
      const auto entry
          = std::ranges::find_if(row, [&](const auto &column) { return column.first == name; });
      return entry == row.end() ? std::string() : entry->second;
    };
    const auto count = [&](const std::string &name) {
      return parse_whole_number(text(name), 0, "results.csv: " + name);
    };
    result.status = text("status");
    for (const std::string &name : run_status_names.names())
      if (result.status.starts_with(name))
        result.march.status = run_status_names.value(name, "results.csv");
    result.reason                  = text("reason");
    result.unknowns                = count("unknowns");
    result.march.newton_iterations = count("newton iterations");
    result.seconds_total           = parse_number(text("seconds total"), "results.csv");
    // A probe's column, "tip y [m]", stands before "tip y error".
    for (std::size_t k = 1; k < row.size(); ++k)
      {
        const std::string &title = row[k - 1].first, suffix = " error";
        const std::string  name = title.substr(0, title.rfind(" ["));
        if (row[k].first != name + suffix)
          continue;
        result.probe_columns.push_back(
            {name,
             name == title ? "" : title.substr(name.size() + 2, title.size() - name.size() - 3)});
        if (result.converged())
          result.probe_values.push_back(parse_number(row[k - 1].second, "results.csv: " + title));
      }
    return result;
  }

  std::string study_table(const StudyPlan                &plan,
                          const std::vector<RunResult>   &results,
                          const std::vector<ProbeErrors> &errors,
                          const std::vector<ProbeColumn> &probe_columns)
  {
    std::vector<std::string> header;
    for (const std::string &key : plan.keys)
      header.push_back(key.substr(key.rfind('/') + 1));
    header.push_back("unknowns");
    // Columns with an error or an estimate somewhere get a column of it.
    std::vector<std::size_t> shown, estimated;
    for (std::size_t k = 0; k < probe_columns.size(); ++k)
      {
        header.push_back(probe_columns[k].title());
        if (std::ranges::any_of(results, [&](const RunResult &result) {
              return relative_estimate(result, k).has_value();
            }))
          {
            estimated.push_back(k);
            header.push_back("estimated %");
          }
        for (const ProbeErrors &error : errors)
          if (k < error.error.size() && error.error[k])
            {
              shown.push_back(k);
              header.push_back("error %");
              break;
            }
      }
    for (const char *name : {"Newton", "seconds", "status"})
      header.emplace_back(name);

    std::vector<std::vector<std::string>> rows;
    for (std::size_t r = 0; r < plan.runs.size() && r < results.size(); ++r)
      {
        const RunResult &result = results[r];
        if (result.status == left_out)
          continue;
        std::vector<std::string> row;
        for (const std::string &key : plan.keys)
          row.push_back(plan.runs[r].assignments.at(key));
        row.push_back(std::to_string(result.unknowns));
        for (std::size_t k = 0; k < probe_columns.size(); ++k)
          {
            const bool valid = result.converged();
            row.push_back(valid ? number(result.probe_values[k]) : "");
            if (std::ranges::find(estimated, k) != estimated.end())
              {
                const auto estimate = relative_estimate(result, k);
                row.push_back(estimate ? number(100. * *estimate, "%.2g") : "");
              }
            for (const std::size_t s : shown)
              if (s == k)
                row.push_back(
                    valid && errors[r].error[k] ? number(100. * *errors[r].error[k], "%.3g") : "");
          }
        row.push_back(std::to_string(result.march.newton_iterations));
        row.push_back(number(result.seconds_total, "%.3g"));
        row.push_back(result.converged() && !plan.runs[r].in_grid ? "reference" : result.status);
        rows.push_back(std::move(row));
      }
    return format_table(header, rows);
  }

  std::string run_summary(const RunResult &result)
  {
    std::ostringstream out;
    if (result.automatic)
      out << result.automatic->table << "estimated error    "
          << (result.automatic->estimate ? number(100. * *result.automatic->estimate, "%.2g") + " %"
                                         : "unknown")
          << ", asked for " << number(100. * result.automatic->accuracy, "%.2g") << " %; "
          << result.automatic->trials << " runs\n";
    out << "status             " << result.status
        << (result.reason.empty() ? "" : ": " + result.reason) << '\n';
    for (std::size_t k = 0; k < result.probe_columns.size(); ++k)
      {
        const std::string title = result.probe_columns[k].title();
        out << title << std::string(title.size() < 18 ? 19 - title.size() : 1, ' ')
            << number(result.probe_values[k], "%.6g");
        if (const auto estimate = relative_estimate(result, k))
          out << ", estimated error " << number(100. * *estimate, "%.2g") << " %";
        out << '\n';
      }
    out << "volume ratio       " << number(result.volume_ratio, "%.6f") << ", min J "
        << number(result.march.size.min_jacobian) << '\n'
        << "load steps         " << result.march.load_steps << " (" << result.march.failed_steps
        << " failed), Newton iterations " << result.march.newton_iterations
        << (result.coarse_newton_iterations > 0
                ? " and " + std::to_string(result.coarse_newton_iterations) + " on coarser meshes"
                : "")
        << ", factorisations " << result.linear.factorisations << ", Krylov iterations "
        << result.linear.krylov_iterations << '\n';
    if (result.march.pivot_excess)
      out << "negative pivots    " << *result.march.pivot_excess
          << " more than pressure unknowns\n";
    if (result.oscillation)
      out << "pressure CB        " << number(*result.oscillation, "%.3f") << '\n';
    for (const auto &[name, test] : {std::pair("inf-sup at rest   ", &result.inf_sup_at_rest),
                                     std::pair("inf-sup at the end", &result.inf_sup_at_end)})
      if (*test)
        out << name << " beta = " << number((*test)->constant, "%.4f") << ", "
            << (*test)->spurious_modes << " spurious pressure modes"
            << ((*test)->has_hydrostatic_mode ? " and the constant pressure" : "") << '\n';
    out << "seconds            ";
    for (std::size_t k = 0; k < result.seconds.size(); ++k)
      out << name_of(static_cast<Phase>(k)) << ' ' << number(result.seconds[k], "%.3f") << ", ";
    out << "total " << number(result.seconds_total, "%.3f") << '\n'
        << "per Newton step    assembly "
        << number(1e6 * seconds(result, Phase::assembly)
                      / std::max<double>(1., double(result.cells) * result.march.newton_iterations),
                  "%.2f")
        << " microseconds per cell\n"
        << "memory             " << number(result.peak_megabytes, "%.0f") << " MB at most, factors "
        << number(result.linear.megabytes, "%.0f") << " MB, "
        << number(result.linear.flops / 1e9, "%.2f") << " GFlop per factorisation\n";
    for (const std::string &warning : result.warnings)
      out << "warning            " << warning << '\n';
    return out.str();
  }
} // namespace isochor
