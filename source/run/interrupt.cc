#include <isochor/run/interrupt.h>

#include <deal.II/base/mpi.h>

#include <csignal>

namespace isochor
{
  namespace
  {
    volatile std::sig_atomic_t signal_seen = 0;

    extern "C" void on_interrupt(int signal)
    {
      signal_seen = 1;
      std::signal(signal, SIG_DFL);
    }
  } // namespace

  void catch_interrupts()
  {
    std::signal(SIGINT, &on_interrupt);
    std::signal(SIGTERM, &on_interrupt);
  }

  bool interrupted(MPI_Comm communicator)
  {
    return dealii::Utilities::MPI::max(static_cast<int>(signal_seen), communicator) != 0;
  }
} // namespace isochor
