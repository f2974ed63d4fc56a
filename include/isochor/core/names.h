#pragma once

// One table ties an enum to the words of the parameter file: parsing, printing and the
// ParameterHandler pattern all come from it.

#include <isochor/core/error.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace isochor
{
  template <typename Enum, std::size_t n>
  class NameTable
  {
  public:
    constexpr NameTable(const std::array<std::pair<Enum, std::string_view>, n> &rows)
      : rows(rows)
    {
    }

    std::string name(const Enum value) const
    {
      for (const auto &[key, word] : rows)
        if (key == value)
          return std::string(word);
      throw std::logic_error("a value without a name");
    }

    /// Throws UserError naming @p what and the allowed words.
    Enum value(const std::string_view word, const std::string &what) const
    {
      for (const auto &[key, known] : rows)
        if (known == word)
          return key;
      throw UserError(what + ": '" + std::string(word) + "' is not allowed; choose "
                      + listed(names()));
    }

    std::vector<std::string> names() const
    {
      std::vector<std::string> words;
      for (const auto &row : rows)
        words.emplace_back(row.second);
      return words;
    }

    /// "a|b|c", for dealii::Patterns::Selection.
    std::string selection() const
    {
      std::string text;
      for (const auto &row : rows)
        text += (text.empty() ? "" : "|") + std::string(row.second);
      return text;
    }

  private:
    std::array<std::pair<Enum, std::string_view>, n> rows;
  };

  template <typename Enum, std::size_t n>
  constexpr NameTable<Enum, n> name_table(const std::pair<Enum, std::string_view> (&rows)[n])
  {
    return NameTable<Enum, n>(std::to_array(rows));
  }
} // namespace isochor
