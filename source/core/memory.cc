#include <isochor/core/memory.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace isochor
{
  namespace
  {
    constexpr double unlimited = std::numeric_limits<double>::infinity();

    /// A number alone in a file, bytes; `unlimited` if there is none ("max").
    double bytes_in(const std::string &file)
    {
      std::ifstream in(file);
      double        bytes;
      return in >> bytes ? bytes : unlimited;
    }

    double available_here()
    {
      double        bytes = unlimited;
      std::ifstream meminfo("/proc/meminfo");
      std::string   word;
      double        kilobytes;
      while (meminfo >> word)
        if (word == "MemAvailable:" && meminfo >> kilobytes)
          bytes = 1024. * kilobytes;
      const std::string group = "/sys/fs/cgroup/";
      const double      limit = bytes_in(group + "memory.max");
      if (limit < unlimited)
        bytes = std::min(bytes, std::max(0., limit - bytes_in(group + "memory.current")));
      return bytes / 1e6;
    }
  } // namespace

  double available_megabytes(MPI_Comm communicator)
  {
    MPI_Comm machine;
    MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    int rank = 0;
    MPI_Comm_rank(machine, &rank);
    MPI_Comm_free(&machine);

    int    machines = rank == 0;
    double smallest = available_here();
    MPI_Allreduce(MPI_IN_PLACE, &machines, 1, MPI_INT, MPI_SUM, communicator);
    MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_DOUBLE, MPI_MIN, communicator);
    return machines * smallest;
  }
} // namespace isochor
