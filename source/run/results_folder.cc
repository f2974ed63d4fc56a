#include <isochor/core/text.h>
#include <isochor/run/results_folder.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace isochor
{
  namespace
  {
    namespace fs = std::filesystem;

    /// The marker by which a results folder is known as ours.
    constexpr const char *parameters_file = "parameters.prm";

    bool is_result(const std::string &name)
    {
      return name.starts_with("run_") || name.starts_with("solution") || name == "results.csv"
             || name.starts_with("checkpoint_") || name.starts_with("trial_") || name == "steps.csv"
             || name == "iterations.csv" || name == "automatic.csv" || name == parameters_file;
    }
  } // namespace

  void check_folder(const fs::path &folder, const Invocation &invocation)
  {
    const bool      overwrite = invocation.overwrite;
    std::error_code error;
    if (invocation.restart)
      {
        if (!fs::exists(folder / parameters_file, error))
          throw UserError("--restart: folder '" + folder.string()
                          + "' holds no results of Isochor; run it from the start, without "
                            "--restart");
        return;
      }
    if (!fs::exists(folder, error))
      return;
    if (!fs::is_directory(folder, error))
      throw UserError("--output: '" + folder.string() + "' is not a folder");
    const bool is_empty = fs::is_empty(folder, error);
    if (error)
      throw UserError("--output: folder '" + folder.string()
                      + "' cannot be read: " + error.message());
    if (is_empty)
      return;
    if (!overwrite)
      throw UserError("--output: folder '" + folder.string()
                      + "' exists and is not empty; choose another with --output, replace its "
                        "results with --overwrite, or go on with them with --restart");
    if (!fs::exists(folder / parameters_file, error))
      throw UserError("--overwrite: folder '" + folder.string()
                      + "' holds no results of Isochor; empty it yourself");
  }

  void prepare_folder(const fs::path &folder, const Invocation &invocation)
  {
    check_folder(folder, invocation);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
      throw UserError("--output: folder '" + folder.string()
                      + "' cannot be made: " + error.message());
    std::vector<fs::path> old_results;
    if (!invocation.restart)
      for (const auto &entry : fs::directory_iterator(folder))
        if (is_result(entry.path().filename().string()))
          old_results.push_back(entry.path());
    for (const fs::path &path : old_results)
      if (fs::remove_all(path, error); error)
        throw UserError("--overwrite: '" + path.string()
                        + "' cannot be removed: " + error.message());

    dealii::ParameterHandler prm;
    declare_parameters(prm);
    read_parameter_file(prm, invocation.file, invocation.overrides);
    std::ofstream out(folder / parameters_file);
    prm.print_parameters(out, dealii::ParameterHandler::ShortPRM);
    if (!out.flush())
      throw UserError("--output: folder '" + folder.string() + "' is not writable");
  }

  Identity values_of(dealii::ParameterHandler &prm, const std::vector<std::string> &sections)
  {
    std::stringstream text;
    prm.print_parameters(text, dealii::ParameterHandler::ShortPRM);
    Identity    values;
    std::string line, section;
    while (std::getline(text, line))
      {
        line = trim(line);
        if (line.starts_with("subsection "))
          section = line.substr(11);
        else if (const auto equals = line.find('=');
                 line.starts_with("set ") && std::ranges::count(sections, section) > 0)
          values[section + "/" + trim(line.substr(4, equals - 4))] = trim(line.substr(equals + 1));
      }
    return values;
  }

  void check_same_study(const fs::path &folder, const Invocation &invocation)
  {
    dealii::ParameterHandler now, then;
    for (const auto &[prm, file, overrides] :
         {std::tuple(&now, invocation.file, invocation.overrides),
          std::tuple(&then, folder / parameters_file, std::vector<std::string>())})
      {
        declare_parameters(*prm);
        read_parameter_file(*prm, file, overrides);
      }
    const std::vector<std::string> sections{"Scene", "Method", "Study"};
    Identity                       before = values_of(then, sections);
    for (const auto &[name, value] : values_of(now, sections))
      if (before[name] != value)
        throw UserError("--restart: '" + folder.string() + "' holds another study: " + name
                        + " was '" + before[name] + "', is '" + value
                        + "'; allowed: the same parameters, or a study from the start with "
                          "--overwrite");
  }
} // namespace isochor
