#include <isochor/algebra/mumps.h>
#include <isochor/algebra/umfpack.h>

namespace isochor
{
  std::unique_ptr<DirectSolver> make_direct_solver(const LinearSolver kind, MPI_Comm communicator)
  {
    switch (kind)
      {
        case LinearSolver::mumps:
          return std::make_unique<Mumps>(communicator);
        case LinearSolver::umfpack:
          return std::make_unique<Umfpack>(communicator);
      }
    throw std::logic_error("a linear solver that cannot be made");
  }
} // namespace isochor
