#pragma once

// Reading of parameter files. dealii::ParameterHandler keeps the values; the file is scanned here
// first, because deal.II's own complaints are long dumps that name neither the section nor a
// remedy, because an `include` should be looked for beside the file, and because a
// MultipleParameterLoop must see the file and the overrides at once.

#include <isochor/core/error.h>
#include <isochor/core/text.h>

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <string>
#include <vector>

namespace isochor
{
  /// A key that the file or an override gives several values: {{a|b|c}}.
  struct Variation
  {
    std::vector<std::string> sections; ///< outermost first
    std::string              key;
    std::vector<std::string> values; ///< texts before and after the braces included

    /// "Method/Element"
    std::string path() const;
  };

  /// Read @p file into @p prm, then each of @p overrides, "Section/Key=value". The last one wins.
  ///
  /// A value may hold one variation, {{a|b|c}} or {a|b|c}; both mean that each value is run in
  /// turn. (deal.II's loop takes only the single braces so; its double braces pair the
  /// values of one key with the runs of others. What it gets to see here is the single ones.)
  /// If @p prm is a dealii::MultipleParameterLoop it is ready to loop; in a plain
  /// ParameterHandler such a key holds the text with its braces.
  ///
  /// Returns the variations in the order of their first appearance. All values, those of
  /// variations too, have been checked against the patterns of @p prm. Throws UserError with one
  /// line that names the file and line, or the override, and what is allowed. Reads on
  /// this rank only: under MPI call it within `collectively`.
  std::vector<Variation> read_parameter_file(dealii::ParameterHandler       &prm,
                                             const std::filesystem::path    &file,
                                             const std::vector<std::string> &overrides = {});
} // namespace isochor
