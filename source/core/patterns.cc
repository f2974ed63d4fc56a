#include <isochor/core/error.h>
#include <isochor/core/patterns.h>
#include <isochor/core/text.h>

#include <limits>
#include <regex>

namespace isochor
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// "a number between 0 and 1" for "0...1 (inclusive)".
    std::string
    range_in_words(const std::string &noun, const std::string &lower, const std::string &upper)
    {
      const bool has_lower = lower.find("MAX") == std::string::npos && lower != "-2147483648";
      const bool has_upper = upper.find("MAX") == std::string::npos && upper != "2147483647"
                             && upper != "4294967295";
      if (has_lower && has_upper)
        return noun + " between " + lower + " and " + upper;
      if (has_lower)
        return noun + " of at least " + lower;
      if (has_upper)
        return noun + " of at most " + upper;
      return noun;
    }
  } // namespace

  NumberPattern NumberPattern::any()
  {
    NumberPattern pattern;
    pattern.lower = -infinity;
    pattern.upper = infinity;
    return pattern;
  }

  NumberPattern NumberPattern::at_least(const double bound)
  {
    NumberPattern pattern = any();
    pattern.lower         = bound;
    return pattern;
  }

  NumberPattern NumberPattern::above(const double bound)
  {
    NumberPattern pattern = at_least(bound);
    pattern.lower_belongs = false;
    return pattern;
  }

  NumberPattern NumberPattern::and_at_most(const double bound) const
  {
    NumberPattern pattern = *this;
    pattern.upper         = bound;
    return pattern;
  }

  NumberPattern NumberPattern::and_below(const double bound) const
  {
    NumberPattern pattern = and_at_most(bound);
    pattern.upper_belongs = false;
    return pattern;
  }

  bool NumberPattern::match(const std::string &text) const
  {
    try
      {
        const double value = parse_number(text, "");
        return (lower_belongs ? value >= lower : value > lower)
               && (upper_belongs ? value <= upper : value < upper);
      }
    catch (const UserError &)
      {
        return false;
      }
  }

  std::string NumberPattern::description(const OutputStyle) const
  {
    std::string text = "a number";
    if (lower > -infinity)
      text += (lower_belongs ? " of at least " : " greater than ") + to_text(lower);
    if (lower > -infinity && upper < infinity)
      text += " and";
    if (upper < infinity)
      text += (upper_belongs ? " at most " : " less than ") + to_text(upper);
    return text;
  }

  std::unique_ptr<dealii::Patterns::PatternBase> NumberPattern::clone() const
  {
    return std::unique_ptr<PatternBase>(new NumberPattern(*this));
  }

  std::string plain_words(const std::string &description)
  {
    static const std::regex number(
        R"(\[(Integer|Double) (?:range )?(\S+?)\.\.\.(\S+) \(inclusive\)\])");
    static const std::regex selection(R"(\[(?:Multiple)?Selection (.*?) ?\])");
    static const std::regex list(
        R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\)(?: separated by <(.*)>)?\])");

    std::smatch match;
    if (std::regex_match(description, match, number))
      return range_in_words(
          match[1] == "Integer" ? "a whole number" : "a number", match[2], match[3]);
    if (description.starts_with("[Integer"))
      return "a whole number";
    if (description.starts_with("[Double"))
      return "a number";
    if (description.starts_with("[Bool"))
      return "true or false";
    if (std::regex_match(description, match, selection))
      return listed(split_list(match[1].str(), '|'));
    if (std::regex_match(description, match, list))
      return "a list separated by '" + (match[4].matched ? match[4].str() : ",") + "', each entry "
             + plain_words(match[1]);
    if (description.starts_with("[FileName"))
      return "a file name";
    if (description.starts_with("[DirectoryName"))
      return "a folder name";
    if (description.starts_with("[Anything"))
      return "any text";
    return description;
  }
} // namespace isochor
