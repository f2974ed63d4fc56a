#pragma once

// What a march says: of every load step, and of how it ended.

#include <isochor/form/equilibrium.h>
#include <isochor/solver/newton.h>

#include <optional>

namespace isochor
{
  /// One converged load step.
  struct LoadStep
  {
    unsigned int number = 0; ///< from 1
    double       load   = 0; ///< factor reached
    NewtonReport newton;
    ResidualSize size;
    double       seconds = 0;
    /// Negative pivots minus pressures, of the step's last factorisation, which under load control
    /// may be of an iterate just before; none if the step made do with earlier factors.
    std::optional<long long> pivot_excess;
  };

  enum class RunStatus
  {
    stable,        ///< converged, no negative pivot too many
    unstable,      ///< converged to an equilibrium that the body would leave
    converged,     ///< and nothing is known of its stability (LU)
    not_converged, ///< ended at the last converged state
    interrupted
  };
  inline constexpr auto run_status_names
      = name_table<RunStatus>({{RunStatus::stable, "stable"},
                               {RunStatus::unstable, "unstable"},
                               {RunStatus::converged, "converged"},
                               {RunStatus::not_converged, "not converged"},
                               {RunStatus::interrupted, "interrupted"}});

  struct MarchReport
  {
    RunStatus    status = RunStatus::not_converged;
    std::string  reason;                ///< empty if converged
    double       load              = 0; ///< last converged load factor
    unsigned int load_steps        = 0; ///< converged
    unsigned int failed_steps      = 0;
    unsigned int newton_iterations = 0; ///< of converged and failed steps
    ResidualSize size;                  ///< at the last converged state
    /// Negative pivots minus pressures at the last converged state; none: not known.
    std::optional<long long> pivot_excess;

    bool converged() const
    {
      return status == RunStatus::stable || status == RunStatus::unstable
             || status == RunStatus::converged;
    }
    /// The status, "unstable (2 modes)" with their number.
    std::string status_text() const;
  };

  /// Between two load steps: what the march needs to go on from there. Run saves it.
  struct MarchState
  {
    /// What stepping under load control also needs.
    struct LoadHistory
    {
      Vector before; ///< the converged state before the last
      double load_before = 0;
      bool   is_unstable = false; ///< the last equilibrium
    };
    /// What following a path also needs: its last tangent, and the unit of displacements.
    struct PathHistory
    {
      Vector tangent;
      double tangent_load       = 0; ///< its part in the load factor
      double displacement_scale = 1; ///< U of march_along_path()
    };

    MarchReport                report;        ///< so far
    Vector                     state;         ///< last converged; empty: as the march is given it
    double                     next_step = 0; ///< of the load factor or of arc length
    std::optional<LoadHistory> load_history;  ///< none: it was not stepped so
    std::optional<PathHistory> path_history;  ///< likewise
  };

  struct MarchCallbacks
  {
    /// Solves one load step in the place of Newton's method, from @p state; null: Newton's method.
    /// Not for arc length.
    std::function<NewtonReport(double load, ResidualSize &size, Vector &state)> solve;
    /// After each converged step, with the state.
    std::function<void(const LoadStep &, const Vector &state)> converged;
    /// After each failed step: why, and the next step tried.
    std::function<void(double load, const NewtonReport &, double next_step)> failed;
    /// Asks to stop.
    std::function<bool()> interrupted;
    /// After each solution that was tried, converged or not, before the step itself is told of. May
    /// be empty.
    std::function<void(double load, const NewtonReport &)> solved;
    /// After each converged step but the last: from there the march can go on another time. May
    /// be empty.
    std::function<void(const MarchState &)> resumable;
  };
} // namespace isochor
