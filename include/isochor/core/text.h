#pragma once

// Small readers of the texts that parameters hold: lists, numbers, vectors, near misses.

#include <deal.II/base/tensor.h>

#include <string>
#include <string_view>
#include <vector>

namespace isochor
{
  std::string trim(std::string_view text);

  /// 0.1 for 0.1: as few digits as show @p value to about 12 figures.
  std::string to_text(double value);

  /// Pieces of @p text between the @p separator characters, trimmed; separators inside round
  /// parentheses do not count. A blank text has no pieces, and one separator at the end is
  /// forgiven; other blank pieces are returned as such, for the caller to refuse.
  std::vector<std::string> split_list(std::string_view text, char separator);

  /// A finite number and nothing else. Throws UserError beginning with @p what.
  double parse_number(std::string_view text, const std::string &what);

  /// A whole number of at least @p least. Throws UserError beginning with @p what.
  unsigned int
  parse_whole_number(std::string_view text, unsigned int least, const std::string &what);

  /// @p dim numbers separated by commas. Throws UserError beginning with @p what.
  template <int dim>
  dealii::Tensor<1, dim> parse_vector(std::string_view text, const std::string &what);

  /// The one of @p known that @p word is most likely a misspelling of (case and blanks count
  /// little); empty if none is near.
  std::string closest(std::string_view word, const std::vector<std::string> &known);
} // namespace isochor
