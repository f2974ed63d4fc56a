#include <isochor/run/progress.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace isochor
{
  bool is_terminal()
  {
    if (isatty(STDOUT_FILENO) == 0)
      return false;
    // Open MPI gives each rank a terminal of its own; what counts is where mpirun writes.
    if (std::getenv("OMPI_COMM_WORLD_SIZE") == nullptr)
      return true;
    std::error_code   error;
    const std::string target
        = std::filesystem::read_symlink("/proc/" + std::to_string(getppid()) + "/fd/1", error)
              .string();
    return target.rfind("/dev/pts/", 0) == 0 || target.rfind("/dev/tty", 0) == 0;
  }

  void print_summary(const RunResult &result, const std::string &element)
  {
    std::printf("%s, %llu cells, %llu unknowns; mesh: smallest dihedral angle %.1f degrees, "
                "largest aspect ratio %.1f\n",
                element.c_str(),
                static_cast<unsigned long long>(result.cells),
                static_cast<unsigned long long>(result.unknowns),
                result.quality.min_angle,
                result.quality.max_aspect);
  }

  void print_step_header()
  {
    std::printf(
        "%5s %9s %7s %10s %8s %8s\n", "step", "load", "Newton", "residual", "min J", "seconds");
  }

  void print_step(const LoadStep &step)
  {
    std::printf("%5u %9.4f %7u %10.1e %8.4f %8.2f\n",
                step.number,
                step.load,
                step.newton.iterations,
                step.newton.merit,
                step.size.min_jacobian,
                step.seconds);
    std::fflush(stdout);
  }

  void print_failed_step(const double load, const NewtonReport &report, const double next_step)
  {
    std::printf("      %9.4f %7u failed: %s; trying a step of %.4g\n",
                load,
                report.iterations,
                report.reason.c_str(),
                next_step);
    std::fflush(stdout);
  }

  void print_bar(const unsigned int done, const unsigned int of, const std::string &now)
  {
    constexpr unsigned int width  = 30;
    const unsigned int     filled = of > 0 ? width * done / of : width;
    // \033[K clears what a longer line before left behind.
    std::cout << "\r[" << std::string(filled, '=') << std::string(width - filled, ' ') << "] "
              << done << "/" << of << "  " << now << "\033[K" << std::flush;
  }
} // namespace isochor
