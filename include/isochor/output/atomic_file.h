#pragma once

// Files that are whole at any moment.

#include <filesystem>
#include <string>

namespace isochor
{
  /// Write @p contents to a temporary name beside @p file, then rename it to @p file: whoever
  /// reads, and whatever interrupts, there is the old file or the new one, never half of it.
  /// Throws UserError naming the file and the reason. Writes on this rank only: under MPI call it
  /// within `collectively`.
  void write_whole_file(const std::filesystem::path &file, const std::string &contents);
} // namespace isochor
