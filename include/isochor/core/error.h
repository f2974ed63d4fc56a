#pragma once

// Exit codes, and the exceptions that stand for them. User input is checked with these,
// never with Assert: an Assert is gone in Release.

#include <mpi.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace isochor
{
  /// What the program returns to the shell.
  enum class ExitCode
  {
    converged     = 0,
    bad_input     = 1,
    not_converged = 2,
    internal      = 3
  };

  /// A mistake of the user: the message says what is wrong, where, and what is allowed.
  /// Must be thrown on every rank or on none; see `collectively`.
  class UserError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// "a, b or c" for messages; "none" if the list is empty.
  std::string listed(const std::vector<std::string> &names);

  /// Run @p action on rank 0 of @p communicator only. A UserError or other std::exception thrown
  /// there is rethrown with the same message (as UserError or std::runtime_error) on every rank,
  /// so that no rank waits for one that has given up.
  void on_root_collectively(MPI_Comm communicator, const std::function<void()> &action);

  /// The same for an @p action that runs on every rank: if it throws on any, it throws on all,
  /// with the message of the lowest rank that failed.
  void collectively(MPI_Comm communicator, const std::function<void()> &action);
} // namespace isochor
