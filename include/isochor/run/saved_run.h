#pragma once

// What a run needs to go on after an interruption, and the bytes it is saved as.

#include <isochor/output/checkpoints.h>
#include <isochor/run/nested.h>
#include <isochor/space/discretisation.h>

namespace isochor
{
  struct SavedRun
  {
    MarchState                                       march;
    NestedReport                                     nested;
    std::vector<std::pair<double, std::string>>      pictures;  ///< VtuSeries::written()
    LinearStatistics                                 linear;    ///< on the mesh itself
    std::optional<DualReport>                        dual;      ///< the most of any load step
    std::array<double, std::size_t(Phase::n_phases)> seconds{}; ///< of this rank
    double                                           seconds_total  = 0;
    double                                           peak_megabytes = 0;
  };

  /// Costs and counts of @p earlier and @p later parts of one run; what is known of the last
  /// factorisation is that of the later part, if it had one.
  LinearStatistics joined(const LinearStatistics &earlier, const LinearStatistics &later);

  /// The saved states of a run. All functions are collective.
  class RunCheckpoints
  {
  public:
    template <int dim>
    RunCheckpoints(const RunSettings &settings, const Discretisation<dim> &discretisation);

    /// Is the time between two saves over?
    bool is_due() const;

    /// What differs from rank to rank is the share of this one.
    void save(SavedRun run);

    /// The last saved state that is whole, or an empty one; @p remarks gets what the user should
    /// know of it. @p layout: any vector of the state's layout. Throws UserError as
    /// Checkpoints::load.
    SavedRun load(const Vector &layout, std::vector<std::string> &remarks);

  private:
    MPI_Comm              communicator;
    std::optional<double> interval; ///< s
    Checkpoints           files;
    Stopwatch             since_last;
  };
} // namespace isochor
