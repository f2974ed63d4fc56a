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
  /// One line of results.csv.
  struct RunResult
  {
    /// MarchReport::status_text(), or "refused" (bad input of one run of a study)
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
    double                                           volume_ratio = 1; ///< deformed / reference
    std::optional<double>                            oscillation;
    std::optional<InfSup>                            inf_sup_at_rest, inf_sup_at_end;
    MeshQuality                                      quality;
    std::vector<std::string>                         warnings; ///< plain words for the user

    bool converged() const
    {
      return march.converged();
    }
  };

  struct RunSettings
  {
    MPI_Comm              communicator;
    std::filesystem::path folder; ///< for VTU files and steps.csv; exists
    VtuOutput             vtu        = VtuOutput::every_step;
    bool                  check_only = false;       ///< everything up to the first load step
    bool                  inf_sup    = false;       ///< test at rest and in the final state
    bool                  show_steps = false;       ///< a line per load step on std::cout of rank 0
    std::optional<double> checkpoint_interval = 0.; ///< as in OutputOptions
    bool                  restart  = false; ///< go on from the last saved state, if there is one
    Identity              identity = {};    ///< the parameters that a saved state depends on
    /// Called when the input has proved good, before anything is written. Collective.
    std::function<void()> before_output = [] {};
  };

  /// Throws UserError on every rank for what the user must mend. Collective.
  template <int dim>
  RunResult run(const Scene<dim> &scene, const Method &method, const RunSettings &settings);
} // namespace isochor
