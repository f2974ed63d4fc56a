#pragma once

// A generator's line, "name(numbers)", read and checked.

#include <isochor/mesh/generator.h>

namespace isochor
{
  struct GeneratorCall
  {
    GeneratorForm       form;
    std::vector<double> arguments;
    std::string         origin; ///< start of messages
  };

  /// With as many numbers as the generator takes. Throws UserError.
  GeneratorCall parse_generator(const std::string &source);

  /// Throws UserError unless all arguments are positive.
  void expect_lengths(const GeneratorCall &call);

  /// Throws UserError unless the first two arguments are an inner and a larger outer radius.
  void expect_radii(const GeneratorCall &call);

  /// How many blocks: MeshRequest::cells, or each of @p lengths divided by the size, at least 1.
  /// The body has @p repeats times the product of the numbers. Throws UserError.
  std::vector<unsigned int> block_counts(const GeneratorCall       &call,
                                         const MeshRequest         &request,
                                         const std::vector<double> &lengths,
                                         double                     repeats);
} // namespace isochor
