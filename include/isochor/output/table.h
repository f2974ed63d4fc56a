#pragma once

// The table that a run or a study ends with on the console.

#include <string>
#include <vector>

namespace isochor
{
  /// Columns aligned, one line per row, header underlined. Texts that are numbers come with 5
  /// significant digits (whole numbers with all), their columns right-aligned; longer
  /// texts than @p max_width characters are cut and end in "...". Each row has as many entries as
  /// @p header.
  std::string format_table(const std::vector<std::string>              &header,
                           const std::vector<std::vector<std::string>> &rows,
                           unsigned int                                 max_width = 32);
} // namespace isochor
