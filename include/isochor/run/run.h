#pragma once

// Run: Scene x Method -> Result.

#include <isochor/measure/inf_sup.h>
#include <isochor/measure/probes.h>
#include <isochor/mesh/raw_mesh.h>
#include <isochor/output/checkpoints.h>
#include <isochor/run/method.h>

#include <filesystem>
#include <functional>

namespace isochor
{
  /// What Element = auto has made of a scene; run/automatic.h.
  struct AutomaticReport
  {
    std::string           choice;       ///< element, edge length, strain: in words
    double                accuracy = 0; ///< relative error that was asked for
    std::optional<double> estimate;     ///< of the relative error of the result
    unsigned int          trials = 0;   ///< runs altogether
    double      seconds_chosen   = 0;   ///< of the run that was chosen, of RunResult::seconds_total
    std::string table;                  ///< all that was tried and predicted, for the console
  };

  /// One line of results.csv.
  struct RunResult
  {
    /// MarchReport::status_text(); of runs of a study also "refused" (bad input), "left out" (has
    /// more than RunSettings::most_unknowns)
    std::string status;
    std::string reason; ///< empty if converged

    GlobalIndex                                      cells = 0, unknowns = 0;
    MarchReport                                      march;
    unsigned int                                     coarse_newton_iterations = 0;
    LinearStatistics                                 linear;
    std::optional<DualReport>                        dual; ///< the most of any load step
    std::array<double, std::size_t(Phase::n_phases)> seconds{};
    double                                           seconds_total  = 0;
    double                                           peak_megabytes = 0; ///< largest rank
    std::vector<ProbeColumn>                         probe_columns;
    std::vector<double>                              probe_values;
    /// J(u) - J(u_h) of each probe column, NaN where it is not known; empty: not asked for. See
    /// run/error_estimate.h
    std::vector<double>            estimated_errors;
    double                         volume_ratio = 1; ///< deformed / reference
    std::optional<double>          oscillation;
    std::optional<InfSup>          inf_sup_at_rest, inf_sup_at_end;
    MeshQuality                    quality;
    std::vector<std::string>       warnings;  ///< plain words for the user
    std::optional<AutomaticReport> automatic; ///< of Element = auto: how it was chosen

    bool converged() const
    {
      return march.converged();
    }
  };

  /// Status of a run of a study whose input is bad.
  inline constexpr const char *refused = "refused";

  /// What the reason of a run begins with that Method/Time limit has ended.
  inline constexpr const char *time_limit_words = "time limit";

  /// Status of a run that is larger than RunSettings::most_unknowns, or smaller than least_unknowns.
  inline constexpr const char *left_out = "left out";

  struct RunSettings
  {
    MPI_Comm              communicator;
    std::filesystem::path folder; ///< for VTU files and tables; exists
    VtuOutput             vtu        = VtuOutput::every_step;
    bool                  check_only = false;       ///< everything up to the first load step
    bool                  inf_sup    = false;       ///< test at rest and in the final state
    bool                  iterations = false;       ///< write iterations.csv
    bool                  show_steps = false;       ///< a line per load step on std::cout of rank 0
    std::optional<double> checkpoint_interval = 0.; ///< as in OutputOptions
    /// A larger problem is left out. 0: none is too large.
    GlobalIndex most_unknowns = 0;
    /// A smaller problem is left out: its mesh is hardly finer than one that has been solved on.
    GlobalIndex                                   least_unknowns     = 0;
    std::function<bool(const std::string &probe)> estimates_error_of = {}; ///< empty: of none
    bool     restart  = false; ///< go on from the last saved state, if there is one
    Identity identity = {};    ///< the parameters that a saved state depends on
    /// Called when the input has proved good, before anything is written. Collective.
    std::function<void()> before_output = [] {};
  };

  template <int dim>
  struct SolvedBody; // run/nested.h

  /// Throws UserError on every rank for what the user must mend. With @p begin it begins with that
  /// equilibrium, whatever mesh and element it is on; if it converges, @p end (which may be the same)
  /// becomes what was solved. Collective.
  template <int dim>
  RunResult run(const Scene<dim>      &scene,
                const Method          &method,
                const RunSettings     &settings,
                const SolvedBody<dim> *begin = nullptr,
                SolvedBody<dim>       *end   = nullptr);
} // namespace isochor
