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

  /// The rows of @p file, whole lines only: what a killed program left of its last row is dropped.
  /// None if there is no file. Reads on this rank only.
  std::vector<ResultRow> read_results(const std::filesystem::path &file);

  /// At most 10 significant digits, as "%.10g" prints it with a decimal point in any locale.
  std::string csv_number(double value);

  class ResultsCsv
  {
  public:
    /// Creates the file on rank 0 with the rows @p kept (only those of rank 0 count); with such rows,
    /// an older file is there until then. Throws UserError naming it. Collective.
    ResultsCsv(MPI_Comm                      communicator,
               std::filesystem::path         file,
               const std::vector<ResultRow> &kept = {});

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

    /// Lines of @p row, with the header if it is the first one.
    std::string lines(const ResultRow &row);

    MPI_Comm                          communicator;
    std::filesystem::path             file;
    std::unique_ptr<std::FILE, Close> stream; ///< rank 0 only
    std::vector<std::string>          columns;
  };
} // namespace isochor
