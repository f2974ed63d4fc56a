// The command line: parse, dispatch, and catch once. launcher.cc starts it.

#include <isochor/core/version.h>
#include <isochor/run/interrupt.h>
#include <isochor/run/study.h>

#include <CLI/CLI.hpp>
#include <deal.II/base/mpi.h>

#include <iostream>

namespace
{
  int code(const isochor::ExitCode exit_code)
  {
    return static_cast<int>(exit_code);
  }

  void print_parameters()
  {
    dealii::ParameterHandler prm;
    isochor::declare_parameters(prm);
    prm.print_parameters(
        std::cout, dealii::ParameterHandler::PRM | dealii::ParameterHandler::KeepDeclarationOrder);
  }

  /// The exit code, and what to do if it is none yet.
  std::optional<int>
  parse(int argc, char **argv, const bool on_root, isochor::Invocation &invocation)
  {
    CLI::App app("Isochor: nearly and fully incompressible hyperelastic solids, and what each "
                 "finite element makes of them.");
    bool     parameters = false, version = false;
    app.add_option("FILE", invocation.file, "parameter file (.prm)");
    app.add_option("--set",
                   invocation.overrides,
                   "override one value: \"Section/Key=value\" (may be repeated)")
        ->allow_extra_args(false);
    app.add_option("--output", invocation.output, "folder for results")->type_name("DIR");
    app.add_flag("--overwrite", invocation.overwrite, "replace the results in that folder");
    app.add_flag("--restart",
                 invocation.restart,
                 "go on where an interruption ended it: finished runs stay, the interrupted one "
                 "continues from its last saved state");
    app.add_flag("--inf-sup",
                 invocation.inf_sup,
                 "also test the stability of the pressure: inf-sup constant and spurious modes");
    app.add_flag("--check", invocation.check_only, "read and check everything, then stop");
    app.add_flag("--parameters", parameters, "print the documented parameter template");
    app.add_flag("--version", version, "print versions of Isochor and its libraries");
    app.footer("Exit codes: 0 converged, 1 bad input, 2 did not converge, 3 internal error.");
    try
      {
        app.parse(argc, argv);
      }
    catch (const CLI::ParseError &error)
      {
        if (!on_root)
          return error.get_exit_code() == 0 ? 0 : 1;
        if (error.get_exit_code() == 0) // --help
          return app.exit(error);
        std::cerr << "error: " << error.what() << "; see isochor --help" << std::endl;
        return code(isochor::ExitCode::bad_input);
      }
    if (version || parameters)
      {
        if (on_root && version)
          std::cout << isochor::version_text();
        if (on_root && parameters)
          print_parameters();
        return 0;
      }
    if (invocation.restart && (invocation.overwrite || invocation.check_only))
      {
        if (on_root)
          std::cerr
              << "error: --restart keeps what --overwrite removes and --check does not touch; "
                 "choose one"
              << std::endl;
        return code(isochor::ExitCode::bad_input);
      }
    if (invocation.file.empty())
      {
        if (on_root)
          std::cerr << "error: no parameter file; see isochor --help" << std::endl;
        return code(isochor::ExitCode::bad_input);
      }
    return {};
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool on_root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  isochor::Invocation invocation;
  if (const auto done = parse(argc, argv, on_root, invocation))
    return *done;

  isochor::catch_interrupts();
  try
    {
      return code(isochor::execute(invocation, MPI_COMM_WORLD));
    }
  catch (const isochor::UserError &error)
    {
      if (on_root)
        std::cerr << "error: " << error.what() << std::endl;
      return code(isochor::ExitCode::bad_input);
    }
  catch (const std::exception &error)
    {
      std::cerr << "internal error: " << error.what() << std::endl;
      // Other ranks may wait for this one.
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, code(isochor::ExitCode::internal));
      return code(isochor::ExitCode::internal);
    }
}
