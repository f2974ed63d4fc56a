#include <isochor/core/error.h>

#include <deal.II/base/mpi.h>

#include <optional>

namespace isochor
{
  namespace
  {
    enum class Failure : int
    {
      none     = 0,
      user     = 1,
      internal = 2
    };

    struct Outcome
    {
      Failure     failure = Failure::none;
      std::string message;
    };

    Outcome outcome_of(const std::function<void()> &action)
    {
      try
        {
          action();
          return {};
        }
      catch (const UserError &error)
        {
          return { Failure::user, error.what() };
        }
      catch (const std::exception &error)
        {
          return { Failure::internal, error.what() };
        }
    }

    [[noreturn]] void rethrow(const Failure failure, const std::string &message)
    {
      if (failure == Failure::user)
        throw UserError(message);
      throw std::runtime_error(message);
    }
  } // namespace

  std::string listed(const std::vector<std::string> &names)
  {
    if (names.empty())
      return "none";
    std::string text = names.front();
    for (std::size_t i = 1; i < names.size(); ++i)
      text += (i + 1 == names.size() ? " or " : ", ") + names[i];
    return text;
  }

  void on_root_collectively(MPI_Comm communicator, const std::function<void()> &action)
  {
    collectively(communicator, [&]() {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        action();
    });
  }

  void collectively(MPI_Comm communicator, const std::function<void()> &action)
  {
    const Outcome mine = outcome_of(action);

    const int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const int culprit
        = dealii::Utilities::MPI::min(mine.failure == Failure::none ? n_ranks : rank, communicator);
    if (culprit == n_ranks)
      return;

    const int failure
        = dealii::Utilities::MPI::broadcast(communicator, static_cast<int>(mine.failure), culprit);
    const std::string message
        = dealii::Utilities::MPI::broadcast(communicator, mine.message, culprit);
    rethrow(static_cast<Failure>(failure), message);
  }
} // namespace isochor
