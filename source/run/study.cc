#include "planned_run.h"

#include <isochor/run/interrupt.h>
#include <isochor/run/progress.h>
#include <isochor/run/result_rows.h>
#include <isochor/run/results_folder.h>
#include <isochor/run/study.h>

#include <algorithm>
#include <iostream>

namespace isochor
{
  namespace
  {
    namespace fs = std::filesystem;

    std::string run_folder_name(const std::size_t index)
    {
      char name[32];
      std::snprintf(name, sizeof name, "run_%03zu", index + 1);
      return name;
    }

    std::string describe(const Assignments &assignments)
    {
      std::string text;
      for (const auto &[path, value] : assignments)
        text += (text.empty() ? "" : ", ") + path.substr(path.rfind('/') + 1) + " " + value;
      return text;
    }

    /// All runs of a plan, in order, with results written as they come.
    class StudyRunner
    {
    public:
      StudyRunner(const Invocation &invocation,
                  const StudyPlan  &plan,
                  const fs::path   &folder,
                  MPI_Comm          communicator)
        : invocation(invocation)
        , plan(plan)
        , folder(folder)
        , communicator(communicator)
        , on_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        , talks(on_root && is_terminal())
        , kept_rows(plan.runs.size())
        , results(plan.runs.size())
        , errors(plan.runs.size())
      {
      }

      ExitCode execute()
      {
        if (invocation.restart)
          keep_finished();
        if (!plan.is_study() && results.front().converged())
          {
            if (on_root)
              std::cout << "the run in '" << folder.string()
                        << "' is finished: converged; --overwrite runs it again" << std::endl;
            return ExitCode::converged;
          }
        if (plan.is_study())
          prepare();
        ExitCode code = ExitCode::converged;
        for (std::size_t done = 0; done < plan.order.size(); ++done)
          {
            const std::size_t index   = plan.order[done];
            const PlannedRun &planned = plan.runs[index];
            if (talks && plan.is_study())
              print_bar(done, plan.order.size(), describe(planned.assignments));

            if (kept_rows[index].empty())
              results[index] = run_one(index);
            if (results[index].status == run_status_names.name(RunStatus::interrupted))
              interrupted_at = done;
            if (!results[index].converged() && results[index].status != left_out)
              code = ExitCode::not_converged;
            // A refused run knows no probes; the columns come from one that does.
            if (probe_columns.empty())
              probe_columns = results[index].probe_columns;
            write_ready_rows(done);
            if (interrupted_at)
              break;
            if (results[index].converged())
              Checkpoints(communicator, folder_of(index), {}).remove();
          }
        if (std::all_of(results.begin(), results.end(), [](const RunResult &result) {
              return result.status == refused;
            }))
          code = ExitCode::bad_input;
        // In the order of the file, now that no reference has to come first.
        if (plan.is_study() && !interrupted_at)
          {
            const fs::path file = folder / "results.csv", ordered = folder / "results.csv.part";
            {
              ResultsCsv csv_in_order(communicator, ordered);
              for (std::size_t index = 0; index < plan.runs.size(); ++index)
                if (results[index].status != left_out)
                  csv_in_order.add(row(index));
            }
            on_root_collectively(communicator, [&]() { fs::rename(ordered, file); });
          }
        if (on_root)
          report();
        return code;
      }

    private:
      /// Rows and results of the runs that have ended, from results.csv. A single run that did not
      /// converge goes on: its method may have changed. Throws UserError if there is nothing to go
      /// on with.
      void keep_finished()
      {
        std::vector<ResultRow> rows;
        on_root_collectively(communicator, [&]() {
          if (plan.is_study())
            check_same_study(folder, invocation);
          rows = read_results(folder / "results.csv");
        });
        rows = dealii::Utilities::MPI::broadcast(communicator, rows);
        for (const ResultRow &row : rows)
          for (std::size_t index = 0; index < plan.runs.size(); ++index)
            if (row.back().second == folder_name(index))
              {
                RunResult result = result_of_row(row);
                if (result.converged()
                    || (plan.is_study()
                        && result.status == run_status_names.name(RunStatus::not_converged)))
                  {
                    kept_rows[index] = row;
                    results[index]   = std::move(result);
                  }
              }
        if (!plan.is_study() && kept_rows.front().empty()
            && Checkpoints(communicator, folder, {}).numbers().empty())
          throw UserError("--restart: no state is saved in '" + folder.string()
                          + "'; run it from the start with --overwrite");
      }

      void prepare()
      {
        on_root_collectively(communicator, [&]() { prepare_folder(folder, invocation); });
        std::vector<ResultRow> kept;
        for (const std::size_t index : plan.order)
          if (!kept_rows[index].empty())
            kept.push_back(kept_rows[index]);
        csv.emplace(communicator, folder / "results.csv", kept);
      }

      RunResult run_one(const std::size_t index)
      {
        RunSettings settings{communicator, folder_of(index)};
        settings.show_steps = talks && !plan.is_study();
        settings.inf_sup    = invocation.inf_sup;
        settings.restart    = invocation.restart;
        if (plan.is_study())
          {
            if (!is_reference(index))
              settings.most_unknowns = plan.most_unknowns;
            if (is_finer_than_left_out(index))
              {
                RunResult result;
                result.status = left_out;
                return result;
              }
            on_root_collectively(communicator, [&]() { fs::create_directories(settings.folder); });
          }
        else // a mistake found before leaves no folder behind and removes no older results
          settings.before_output = [&]() { prepare(); };
        try
          {
            return run_planned(invocation, plan.runs[index].assignments, settings);
          }
        catch (const UserError &error)
          {
            // Alone, bad input ends the program; in a study it is one failed run.
            if (!plan.is_study())
              throw;
            RunResult result;
            result.status = refused;
            result.reason = error.what();
            return result;
          }
      }

      bool is_reference(const std::size_t index) const
      {
        return std::ranges::any_of(plan.runs, [&](const PlannedRun &run) {
          return run.reference == index || run.check == index;
        });
      }

      /// Saves making a mesh whose size is known beforehand.
      bool is_finer_than_left_out(const std::size_t index) const
      {
        const Assignments own  = plan.runs[index].assignments;
        const auto        size = own.find("Scene/Mesh size");
        if (size == own.end() || is_reference(index))
          return false;
        const double edge = dealii::Utilities::string_to_double(size->second);
        for (std::size_t k = 0; k < results.size(); ++k)
          if (results[k].status == left_out)
            {
              Assignments  other = plan.runs[k].assignments;
              std::string &value = other.at("Scene/Mesh size");
              if (dealii::Utilities::string_to_double(value) > edge)
                {
                  value = size->second;
                  if (other == own)
                    return true;
                }
            }
        return false;
      }

      const RunResult *finished(const std::optional<std::size_t> &index) const
      {
        return index && !results[*index].status.empty() ? &results[*index] : nullptr;
      }

      /// Rows are written once the columns are known, refused runs before that included.
      void write_ready_rows(const std::size_t done)
      {
        if (probe_columns.empty() && done + 1 < plan.order.size() && !interrupted_at)
          return;
        for (; n_written <= done; ++n_written)
          {
            const std::size_t index = plan.order[n_written];
            errors[index]           = compare(results[index],
                                    finished(plan.runs[index].reference),
                                    finished(plan.runs[index].check),
                                    plan.reference_values);
            if (kept_rows[index].empty() && results[index].status != left_out)
              csv->add(row(index));
          }
      }

      std::string folder_name(const std::size_t index) const
      {
        return plan.is_study() ? run_folder_name(index) : ".";
      }
      fs::path folder_of(const std::size_t index) const
      {
        return plan.is_study() ? folder / run_folder_name(index) : folder;
      }

      ResultRow row(const std::size_t index) const
      {
        if (!kept_rows[index].empty())
          return kept_rows[index];
        ResultRow row
            = result_row(plan, plan.runs[index], results[index], errors[index], probe_columns);
        row.emplace_back("folder", folder_name(index)); // VTU files
        return row;
      }

      void report() const
      {
        if (talks && plan.is_study())
          {
            print_bar(plan.order.size(), plan.order.size(), "");
            std::cout << "\n";
          }
        if (plan.is_study())
          {
            if (std::ranges::none_of(kept_rows, &ResultRow::empty))
              std::cout << "all runs were finished already\n";
            std::cout << plan.title << "\n" << study_table(plan, results, errors, probe_columns);
            for (std::size_t k = 0; k < results.size(); ++k)
              {
                for (const std::string &warning : results[k].warnings)
                  std::cout << "warning: " << describe(plan.runs[k].assignments) << ": " << warning
                            << "\n";
                if (!results[k].status.empty() && !results[k].converged()
                    && results[k].status != left_out)
                  std::cout << "failed: " << describe(plan.runs[k].assignments) << ": "
                            << results[k].reason << "\n";
              }
          }
        else
          std::cout << run_summary(results.front());
        std::cout << "results in " << folder.string() << std::endl;
      }

      const Invocation &invocation;
      const StudyPlan  &plan;
      const fs::path   &folder;
      MPI_Comm          communicator;
      const bool        on_root, talks;

      std::optional<ResultsCsv>  csv;
      std::vector<ResultRow>     kept_rows; ///< by index of the plan; empty: none
      std::vector<RunResult>     results;   ///< by index of the plan; status empty: not run
      std::vector<ProbeErrors>   errors;
      std::vector<ProbeColumn>   probe_columns;
      std::size_t                n_written = 0; ///< rows, in order of execution
      std::optional<std::size_t> interrupted_at;
    };

    /// Everything up to the first load step, for every run. Throws at the first mistake.
    void check_all(const Invocation &invocation, const StudyPlan &plan, MPI_Comm communicator)
    {
      const bool on_root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      for (const PlannedRun &planned : plan.runs)
        {
          const RunResult result = run_planned(
              invocation, planned.assignments, {communicator, {}, VtuOutput::none, true});
          if (on_root)
            std::cout << "checked" << (planned.assignments.empty() ? "" : ": ")
                      << describe(planned.assignments) << "; " << result.cells << " cells, "
                      << result.unknowns << " unknowns" << std::endl;
        }
    }
  } // namespace

  ExitCode execute(const Invocation &invocation, MPI_Comm communicator)
  {
    StudyPlan   plan;
    std::string output = invocation.output;
    collectively(communicator, [&]() {
      plan = plan_study(invocation.file, invocation.overrides);
      if (output.empty())
        {
          dealii::ParameterHandler prm;
          read_run(prm, invocation, plan.runs.front().assignments);
          output = OutputOptions::parse(prm).folder;
        }
      if (output.empty())
        output = "results/" + invocation.file.stem().string();
    });

    if (invocation.check_only)
      {
        check_all(invocation, plan, communicator);
        return ExitCode::converged;
      }
    const fs::path folder = output;
    on_root_collectively(communicator, [&]() { check_folder(folder, invocation); });
    return StudyRunner(invocation, plan, folder, communicator).execute();
  }
} // namespace isochor
