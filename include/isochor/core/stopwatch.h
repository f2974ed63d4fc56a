#pragma once

// Wall-clock seconds by phase of a run. Every run reports all of them.

#include <array>
#include <chrono>
#include <string>

namespace isochor
{
  enum class Phase
  {
    mesh,
    setup,
    assembly,
    factorisation,
    solve,
    output,
    n_phases
  };

  std::string name_of(Phase phase);

  /// Adds up the seconds spent in each phase on this rank.
  class Stopwatch
  {
  public:
    using Clock = std::chrono::steady_clock;

    /// Measures from construction to destruction.
    class Scope
    {
    public:
      Scope(Stopwatch &stopwatch, const Phase phase)
        : stopwatch(stopwatch)
        , phase(phase)
      {
      }
      ~Scope()
      {
        stopwatch.add(phase, std::chrono::duration<double>(Clock::now() - begin).count());
      }
      Scope(const Scope &)            = delete;
      Scope &operator=(const Scope &) = delete;

    private:
      Stopwatch        &stopwatch;
      Phase             phase;
      Clock::time_point begin = Clock::now();
    };

    Scope measure(const Phase phase)
    {
      return Scope(*this, phase);
    }
    void add(const Phase phase, const double seconds)
    {
      spent[static_cast<std::size_t>(phase)] += seconds;
    }
    double seconds(const Phase phase) const
    {
      return spent[static_cast<std::size_t>(phase)];
    }
    /// Seconds since construction.
    double total() const
    {
      return std::chrono::duration<double>(Clock::now() - begin).count();
    }

  private:
    std::array<double, static_cast<std::size_t>(Phase::n_phases)> spent{};
    Clock::time_point                                             begin = Clock::now();
  };
} // namespace isochor
