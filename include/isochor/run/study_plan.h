#pragma once

// Which runs a study makes, and which run is whose reference.

#include <isochor/core/parameters.h>

#include <map>
#include <optional>

namespace isochor
{
  struct StudyOptions
  {
    std::string title;
    /// "Section/Key = value; ...": a run's reference is the run with its own values but these.
    std::string reference;
    /// The same for a second reference; their difference is the reference's uncertainty.
    std::string reference_check;
    /// "probe column = value; ...": references known from elsewhere.
    std::string reference_values;
    /// Larger runs of the grid are left out; 0: none.
    unsigned int most_unknowns = 0;

    static void         declare(dealii::ParameterHandler &prm);
    static StudyOptions parse(dealii::ParameterHandler &prm);
  };

  /// Parameter paths and the values a run gives them.
  using Assignments = std::map<std::string, std::string>;

  struct PlannedRun
  {
    Assignments                assignments;
    bool                       in_grid = true; ///< false: made only to serve as a reference
    std::optional<std::size_t> reference;      ///< index into StudyPlan::runs
    std::optional<std::size_t> check;          ///< index of the second reference
  };

  struct StudyPlan
  {
    /// Columns of the result table: varied keys, then keys only references change.
    std::vector<std::string> keys;
    std::vector<PlannedRun>  runs;
    /// Order in which to run: references first.
    std::vector<std::size_t>      order;
    std::map<std::string, double> reference_values; ///< by probe column name
    std::string                   title;
    bool                          has_automatic       = false; ///< a run with Element = auto
    bool                          has_error_estimates = false; ///< a run with Error estimates
    unsigned int                  most_unknowns       = 0; ///< of a run of the grid; 0: no limit

    bool is_study() const
    {
      return runs.size() > 1;
    }
  };

  /// @p prm declares all parameters. Reads @p file.
  StudyPlan plan_study(const std::filesystem::path    &file,
                       const std::vector<std::string> &overrides);
} // namespace isochor
