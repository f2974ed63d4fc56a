#pragma once

// Directions of a gradient ascent on pressures, from the gradients so far: each steepest, conjugate
// to those before (Polak and Ribiere), or from the combination of the last iterates with the smallest
// gradient (Anderson 1965).

#include <isochor/core/names.h>
#include <isochor/core/types.h>

#include <deque>

namespace isochor
{
  enum class DualAcceleration
  {
    none,
    cg,
    anderson
  };
  inline constexpr auto dual_acceleration_names
      = name_table<DualAcceleration>({{DualAcceleration::none, "none"},
                                      {DualAcceleration::cg, "CG"},
                                      {DualAcceleration::anderson, "Anderson"}});

  /// Pressures of the ascent, and what was made of them.
  struct DualIterate
  {
    Vector state;    ///< displacements and pressures of the primal solution
    Vector pressure; ///< of the ascent, zero in the displacements
  };

  class DualDirections
  {
  public:
    explicit DualDirections(const DualAcceleration kind)
      : kind(kind)
    {
    }

    struct Direction
    {
      Vector direction;
      double slope = 0; ///< gradient . direction, where it starts
    };

    /// From @p at, where the gradient is @p gradient and the steepest direction @p steepest (the
    /// same up to the metric of pressures). The ascent is to start where @p at is moved to, which
    /// only Anderson's does. Collective.
    Direction next(const Vector &gradient, const Vector &steepest, DualIterate &at);

    /// Forget all.
    void restart();

  private:
    struct Point
    {
      DualIterate at;
      Vector      gradient, steepest;
    };

    void mix(Vector &gradient, Vector &steepest, DualIterate &at) const;

    DualAcceleration  kind;
    std::deque<Point> differences; ///< of successive points, the latest in front
    Point             last;        ///< empty: none
    Vector            last_direction;
  };
} // namespace isochor
