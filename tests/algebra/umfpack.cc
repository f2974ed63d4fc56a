// UMFPACK's LU on one rank: the unsymmetric matrix needs no FGMRES. On two ranks a refusal with
// advice.

#include "solver_cases.h"

#include <isochor/core/error.h>

using namespace isochor;
using namespace isochor::testing;

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    out() << message_of<UserError>([]() {
      make_direct_solver(DirectKind::umfpack, MPI_COMM_WORLD);
    }) << "\n";
  else
    all_cases(*make_direct_solver(DirectKind::umfpack, MPI_COMM_WORLD));
}
