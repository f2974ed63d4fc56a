#pragma once

// What a parameter may hold, said in plain words.

#include <deal.II/base/patterns.h>

namespace isochor
{
  /// A finite number between two bounds, each of which may belong to the range or not.
  /// dealii::Patterns::Double has closed ranges only, lets trailing text and overflow pass, and
  /// describes itself in a notation for machines.
  class NumberPattern : public dealii::Patterns::PatternBase
  {
  public:
    static NumberPattern any();
    static NumberPattern at_least(double bound);
    static NumberPattern above(double bound);
    NumberPattern        and_at_most(double bound) const;
    NumberPattern        and_below(double bound) const;

    bool                                           match(const std::string &text) const override;
    std::string                                    description(OutputStyle style) const override;
    std::unique_ptr<dealii::Patterns::PatternBase> clone() const override;

  private:
    NumberPattern() = default;

    double lower, upper;
    bool   lower_belongs = true, upper_belongs = true;
  };

  /// "a number of at least 0" for "[Double 0...MAX_DOUBLE (inclusive)]": turns the description of
  /// any pattern, as ParameterHandler stores it, into words for a message.
  std::string plain_words(const std::string &pattern_description);
} // namespace isochor
