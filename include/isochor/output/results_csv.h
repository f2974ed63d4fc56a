#pragma once

// results.csv: one row per run, which studies, charts and tests read.

#include <mpi.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /// Column name and text of the value, in order.
  using ResultRow = std::vector<std::pair<std::string, std::string>>;

  /// At most 10 significant digits, as "%.10g" prints it with a decimal point in any locale.
  std::string csv_number(double value);

  class ResultsCsv
  {
  public:
    /// Creates the file, empty, on rank 0. Throws UserError naming it. Collective.
    ResultsCsv(MPI_Comm communicator, std::filesystem::path file);

    /// Append a row; the first one makes the header, and later ones must have its columns
    /// (std::runtime_error). On disk when this returns. Texts are quoted by RFC 4180 where they
    /// need it; lines end with a line feed. Only rank 0's @p row counts. Throws UserError naming
    /// the file if it cannot be written. Collective.
    void add(const ResultRow &row);

  private:
    struct Close
    {
      void operator()(std::FILE *stream) const
      {
        std::fclose(stream);
      }
    };

    void write(const std::string &text);

    MPI_Comm                          communicator;
    std::filesystem::path             file;
    std::unique_ptr<std::FILE, Close> stream; ///< rank 0 only
    std::vector<std::string>          columns;
  };
} // namespace isochor
