#include <isochor/core/stopwatch.h>

namespace isochor
{
  std::string name_of(const Phase phase)
  {
    switch (phase)
      {
        case Phase::mesh:
          return "mesh";
        case Phase::setup:
          return "set-up";
        case Phase::assembly:
          return "assembly";
        case Phase::factorisation:
          return "factorisation";
        case Phase::solve:
          return "solve";
        case Phase::output:
          return "output";
        default:
          return "?";
      }
  }
} // namespace isochor
