#include "parameter_scan.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace isochor
{
  using namespace parameter_scan;

  namespace
  {
    bool is_variation(const std::string &value)
    {
      return value.find_first_of("{}") != std::string::npos;
    }

    /// "0.{{3|49}}" as its values 0.3 and 0.49; a text without braces as itself.
    std::vector<std::string> values_of(const Assignment &assignment)
    {
      const std::string &text = assignment.value;
      if (!is_variation(text))
        return { text };

      const auto  open  = text.find('{');
      const bool  twice = open != std::string::npos && text.substr(open, 2) == "{{";
      const auto  begin = open + (twice ? 2 : 1);
      const auto  close = text.find(twice ? "}}" : "}", open == std::string::npos ? 0 : begin);
      const auto  after = close + (twice ? 2 : 1);
      std::string inner, rest;
      if (open != std::string::npos && close != std::string::npos)
        {
          inner = text.substr(begin, close - begin);
          rest  = text.substr(after);
        }
      if (trim(inner).empty() || is_variation(inner) || is_variation(rest))
        throw UserError(assignment.origin + ": " + joined(assignment.sections, assignment.key)
                        + ": " + quoted(text)
                        + " is not a variation; one pair of braces holds the values "
                          "to run: {{a|b|c}}");

      std::vector<std::string> values;
      std::istringstream       choices(inner + "|");
      for (std::string choice; std::getline(choices, choice, '|');)
        values.push_back(trim(text.substr(0, open) + trim(choice) + rest));
      for (auto value = values.begin(); value != values.end(); ++value)
        if (std::find(values.begin(), value, *value) != value)
          throw UserError(assignment.origin + ": " + joined(assignment.sections, assignment.key)
                          + ": the variation " + quoted(text) + " holds '" + *value + "' twice");
      return values;
    }

    /// The text as deal.II's loop wants it: {a|b}, nothing before or after.
    std::string in_single_braces(const std::vector<std::string> &values)
    {
      std::string text;
      for (const std::string &value : values)
        text += (text.empty() ? "{" : "|") + value;
      return text + "}";
    }

    /// Let @p prm try each value of @p assignment.
    void check_values(dealii::ParameterHandler       &prm,
                      const Declared                 &declared,
                      const Assignment               &assignment,
                      const std::vector<std::string> &values)
    {
      for (const std::string &section : assignment.sections)
        prm.enter_subsection(section);
      std::string refused;
      bool        is_fine = true;
      for (const std::string &value : values)
        try
          {
            if (is_fine)
              prm.set(assignment.key, value);
          }
        catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &)
          {
            is_fine = false;
            refused = value;
          }
      for (std::size_t level = 0; level < assignment.sections.size(); ++level)
        prm.leave_subsection();

      if (!is_fine)
        throw UserError(
            assignment.origin + ": " + joined(assignment.sections, assignment.key) + ": "
            + quoted(refused) + (values.size() > 1 ? " in " + quoted(assignment.value) : "")
            + " is not allowed; choose " + declared.allowed(assignment.sections, assignment.key));
    }
  } // namespace

  std::string Variation::path() const
  {
    return joined(sections, key);
  }

  std::vector<Variation> read_parameter_file(dealii::ParameterHandler       &prm,
                                             const std::filesystem::path    &file,
                                             const std::vector<std::string> &overrides)
  {
    const Declared          declared(prm);
    std::vector<Assignment> assignments = assignments_in(declared, file);
    if (assignments.empty())
      throw UserError("parameter file '" + file.string()
                      + "' sets nothing; `isochor --parameters` prints a template");
    for (const std::string &text : overrides)
      assignments.push_back(override_of(declared, text));

    // A later assignment replaces an earlier one, and takes its place.
    std::vector<Assignment>            last;
    std::map<std::string, std::size_t> position;
    for (const Assignment &assignment : assignments)
      {
        const auto [entry, is_new]
            = position.emplace(joined(assignment.sections, assignment.key), last.size());
        if (is_new)
          last.push_back(assignment);
        else
          last[entry->second] = assignment;
      }

    std::vector<Variation> variations;
    std::ostringstream     text;
    for (const Assignment &assignment : last)
      {
        const std::vector<std::string> values = values_of(assignment);
        check_values(prm, declared, assignment, values);
        if (is_variation(assignment.value))
          variations.push_back({ assignment.sections, assignment.key, values });

        for (const std::string &section : assignment.sections)
          text << "subsection " << section << '\n';
        text << "set " << assignment.key << " = "
             << (is_variation(assignment.value) ? in_single_braces(values) : assignment.value)
             << '\n';
        for (std::size_t level = 0; level < assignment.sections.size(); ++level)
          text << "end\n";
      }

    // Everything has been checked: what deal.II still refuses is our mistake.
    std::istringstream input(text.str());
    prm.parse_input(input, file.string());
    return variations;
  }
} // namespace isochor
