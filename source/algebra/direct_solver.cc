#include <isochor/algebra/mumps.h>
#include <isochor/algebra/umfpack.h>

namespace isochor
{
  std::unique_ptr<DirectSolver> make_direct_solver(const DirectKind kind, MPI_Comm communicator)
  {
    switch (kind)
      {
        case DirectKind::mumps:
          return std::make_unique<Mumps<double>>(communicator);
        case DirectKind::single_mumps:
          return std::make_unique<Mumps<float>>(communicator);
        case DirectKind::umfpack:
          return std::make_unique<Umfpack>(communicator);
      }
    throw std::logic_error("a direct solver that cannot be made");
  }
} // namespace isochor
