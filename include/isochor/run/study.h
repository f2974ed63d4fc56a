#pragma once

// Study: one parameter file, many runs. Variations {{a|b|c}} make the grid of runs; a reference
// run or value gives each probe an error.

#include <isochor/core/parameters.h>
#include <isochor/run/run.h>

namespace isochor
{
  /// What the command line says.
  struct Invocation
  {
    std::filesystem::path    file;
    std::vector<std::string> overrides; ///< "Section/Key=value"
    std::string              output;    ///< folder; empty: as the file says
    bool                     overwrite  = false;
    bool                     restart    = false; ///< go on where an interruption ended it
    bool                     check_only = false;
    bool                     inf_sup    = false;
  };

  /// Declares all subsections: Scene, Method, Output, Study.
  void declare_parameters(dealii::ParameterHandler &prm);

  /// Runs everything the file asks for and writes results. Throws UserError. Collective.
  ExitCode execute(const Invocation &invocation, MPI_Comm communicator);
} // namespace isochor
