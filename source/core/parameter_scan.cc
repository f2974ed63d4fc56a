#include "parameter_scan.h"

#include <isochor/core/patterns.h>

// boost's JSON reader still uses the old boost/bind.hpp, which complains while it is compiled.
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#include <boost/property_tree/json_parser.hpp>
#undef BOOST_BIND_GLOBAL_PLACEHOLDERS

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

namespace isochor::parameter_scan
{
  using Tree = boost::property_tree::ptree;

  std::string joined(const Path &sections, const std::string &key)
  {
    std::string text;
    for (const std::string &section : sections)
      text += (text.empty() ? "" : "/") + section;
    if (!key.empty())
      text += (text.empty() ? "" : "/") + key;
    return text;
  }

  std::string quoted(std::string text)
  {
    if (text.size() > 60)
      text = text.substr(0, 57) + "...";
    for (char &c : text)
      if (static_cast<unsigned char>(c) < ' ')
        c = '?';
    return "'" + text + "'";
  }

  namespace
  {
    bool is_key(const Tree &tree)
    {
      return tree.count("value") > 0 || tree.count("alias") > 0;
    }

    const Tree *find(const Tree &root, const Path &path)
    {
      const Tree *tree = &root;
      for (const std::string &name : path)
        {
          // Not by get_child: a dot in a name would count as a separator.
          const auto child = tree->find(name);
          if (child == tree->not_found() || is_key(child->second))
            return nullptr;
          tree = &child->second;
        }
      return tree;
    }

    void collect(const Tree               &tree,
                 const Path               &path,
                 const std::string        &key,
                 std::vector<std::string> &places)
    {
      for (const auto &[name, child] : tree)
        if (is_key(child))
          {
            if (name == key)
              places.push_back(joined(path, name));
          }
        else
          {
            Path inner = path;
            inner.push_back(name);
            collect(child, inner, key, places);
          }
    }
  } // namespace

  struct Declared::Tree : boost::property_tree::ptree
  {
  };

  Declared::Declared(const dealii::ParameterHandler &prm)
  {
    std::stringstream json;
    prm.print_parameters(
        json, dealii::ParameterHandler::JSON | dealii::ParameterHandler::KeepDeclarationOrder);
    auto tree = std::make_shared<Tree>();
    read_json(json, static_cast<boost::property_tree::ptree &>(*tree));
    root = tree;
  }

  bool Declared::has_section(const Path &path) const
  {
    return find(*root, path) != nullptr;
  }

  bool Declared::has_key(const Path &path, const std::string &key) const
  {
    return std::ranges::count(names(path, true), key) > 0;
  }

  std::vector<std::string> Declared::names(const Path &path, const bool keys) const
  {
    std::vector<std::string> result;
    if (const auto *section = find(*root, path))
      for (const auto &[name, child] : *section)
        if (is_key(child) == keys)
          result.push_back(name);
    return result;
  }

  std::vector<std::string> Declared::places_of(const std::string &key) const
  {
    std::vector<std::string> places;
    collect(*root, {}, key, places);
    return places;
  }

  std::string Declared::allowed(const Path &path, const std::string &key) const
  {
    if (const auto *section = find(*root, path))
      for (const auto &[name, child] : *section)
        if (name == key)
          return plain_words(child.get<std::string>("pattern_description", "[Anything]"));
    return "";
  }

  namespace
  {
    [[noreturn]] void no_such_section(const Declared    &declared,
                                      const Path        &outer,
                                      const std::string &name,
                                      const std::string &origin)
    {
      const auto  known = declared.names(outer, false);
      std::string text  = origin + ": there is no section " + quoted(name)
                         + (outer.empty() ? "" : " within section " + joined(outer));
      if (const std::string near = closest(name, known); !near.empty())
        text += "; did you mean '" + near + "'?";
      else if (!outer.empty() && declared.has_section({ name }))
        text += "; an 'end' is missing before it";
      else
        text += "; known: " + listed(known);
      throw UserError(text);
    }

    [[noreturn]] void no_such_key(const Declared    &declared,
                                  const Path        &path,
                                  const std::string &key,
                                  const std::string &origin)
    {
      const auto  known = declared.names(path, true);
      std::string text  = origin + ": "
                         + (path.empty() ? "outside of all sections there is no key "
                                         : "section " + joined(path) + " has no key ")
                         + quoted(key);
      if (const auto places = declared.places_of(key); !places.empty())
        text += "; it belongs elsewhere: " + listed(places);
      else if (const std::string near = closest(key, known); !near.empty())
        text += "; did you mean '" + near + "'?";
      else if (!known.empty())
        text += "; known: " + listed(known);
      throw UserError(text);
    }

    std::string whole_text(const std::filesystem::path &file)
    {
      std::error_code ignored;
      if (!std::filesystem::exists(file, ignored))
        throw UserError("parameter file '" + file.string() + "' does not exist");
      if (std::filesystem::is_directory(file, ignored))
        throw UserError("'" + file.string() + "' is a folder; a parameter file is needed");
      errno = 0;
      std::ifstream      input(file);
      std::ostringstream text;
      if (input && input.peek() != std::ifstream::traits_type::eof())
        text << input.rdbuf();
      if (!input.is_open() || input.bad())
        throw UserError("parameter file '" + file.string()
                        + "' cannot be read: " + std::strerror(errno));
      return text.str();
    }

    /// A line without comment and continued over trailing backslashes, and its first number.
    struct Line
    {
      std::string  text;
      unsigned int number;
    };

    std::vector<Line> lines_of(const std::filesystem::path &file)
    {
      std::string text = whole_text(file);
      if (text.starts_with("\xEF\xBB\xBF")) // byte order mark of some editors
        text.erase(0, 3);
      std::istringstream input(text);

      std::vector<Line> lines;
      bool              goes_on = false;
      unsigned int      number  = 0;
      for (std::string raw; std::getline(input, raw);)
        {
          ++number;
          raw                  = trim(raw);
          const bool continues = raw.ends_with('\\');
          if (continues)
            raw.pop_back();
          if (goes_on)
            lines.back().text += raw;
          else
            lines.push_back({ raw, number });
          goes_on = continues;
        }
      for (Line &line : lines)
        {
          line.text = trim(line.text.substr(0, line.text.find('#')));
          std::ranges::replace(line.text, '\t', ' ');
        }
      return lines;
    }

    /// Append the assignments of @p file, whose sections lie within @p base.
    void scan(const Declared              &declared,
              const std::filesystem::path &file,
              const Path                  &base,
              const unsigned int           depth,
              std::vector<Assignment>     &assignments)
    {
      Path                               sections = base;
      std::vector<unsigned int>          opened; // in which line
      std::map<std::string, std::string> seen;

      for (const auto &[text, number] : lines_of(file))
        {
          const std::string origin = file.string() + ", line " + std::to_string(number);
          const auto        blank  = text.find(' ');
          const std::string word   = text.substr(0, blank);
          const std::string rest   = blank == std::string::npos ? "" : trim(text.substr(blank));
          const auto        equals = rest.find('=');

          if (text.empty())
            continue;
          if ((word == "subsection" || word == "SUBSECTION") && !rest.empty())
            {
              sections.push_back(rest);
              if (!declared.has_section(sections))
                no_such_section(declared, Path(sections.begin(), sections.end() - 1), rest, origin);
              opened.push_back(number);
            }
          else if ((word == "end" || word == "END") && rest.empty())
            {
              if (opened.empty())
                throw UserError(origin + ": 'end' without a 'subsection' that it could close");
              sections.pop_back();
              opened.pop_back();
            }
          else if ((word == "set" || word == "SET") && equals != std::string::npos)
            {
              const std::string key = trim(rest.substr(0, equals));
              if (!declared.has_key(sections, key))
                no_such_key(declared, sections, key, origin);
              const auto [first, is_new] = seen.emplace(joined(sections, key), origin);
              if (!is_new)
                throw UserError(origin + ": " + first->first
                                + " is set a second time; it was set in " + first->second);
              assignments.push_back({ sections, key, trim(rest.substr(equals + 1)), origin });
            }
          else if ((word == "include" || word == "INCLUDE") && !rest.empty())
            {
              if (depth > 10)
                throw UserError(origin + ": files include each other without end");
              try
                {
                  scan(declared, file.parent_path() / rest, sections, depth + 1, assignments);
                }
              catch (const UserError &error)
                {
                  const std::string text = error.what();
                  throw UserError(text.ends_with(')') ? text
                                                      : text + " (included in " + origin + ")");
                }
            }
          else
            throw UserError(origin + ": cannot understand " + quoted(text)
                            + "; a line is 'subsection NAME', 'set KEY = VALUE', 'end', "
                              "'include FILE' or a comment after '#'");
        }
      if (!opened.empty())
        throw UserError(file.string() + ": section " + joined(sections) + ", opened in line "
                        + std::to_string(opened.back()) + ", is not closed by an 'end'");
    }
  } // namespace

  std::vector<Assignment> assignments_in(const Declared              &declared,
                                         const std::filesystem::path &file)
  {
    std::vector<Assignment> assignments;
    scan(declared, file, {}, 0, assignments);
    return assignments;
  }

  Assignment override_of(const Declared &declared, const std::string &text)
  {
    const std::string origin = "--set " + quoted(text);
    const std::string form   = "the form is --set \"Section/Key=value\"";
    const auto        equals = text.find('=');
    if (equals == std::string::npos)
      throw UserError(origin + ": no '=' in it; " + form);
    if (text.find_first_of("#\n\r", equals) != std::string::npos || text.ends_with('\\'))
      throw UserError(origin + ": a value cannot hold '#', line ends or a '\\' at its end");

    Path sections = split_list(text.substr(0, equals), '/');
    if (sections.empty())
      throw UserError(origin + ": no key before the '='; " + form);
    const std::string key = sections.back();
    sections.pop_back();
    for (unsigned int n = 1; n <= sections.size(); ++n)
      if (!declared.has_section(Path(sections.begin(), sections.begin() + n)))
        no_such_section(
            declared, Path(sections.begin(), sections.begin() + n - 1), sections[n - 1], origin);
    if (!declared.has_key(sections, key))
      no_such_key(declared, sections, key, origin);
    return { sections, key, trim(text.substr(equals + 1)), origin };
  }
} // namespace isochor::parameter_scan
