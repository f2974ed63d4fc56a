#include <isochor/output/table.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    bool begins_character(const char byte)
    {
      return (byte & 0xC0) != 0x80; // not a continuation byte of UTF-8
    }

    std::size_t width(const std::string &text)
    {
      return std::ranges::count_if(text, begins_character);
    }

    std::string on_one_line(std::string text)
    {
      for (char &c : text)
        if (static_cast<unsigned char>(c) < ' ')
          c = ' ';
      return text;
    }

    std::string cut(const std::string &text, const unsigned int max_width)
    {
      if (width(text) <= max_width)
        return text;
      std::size_t  end  = 0;
      unsigned int kept = 0;
      for (; end < text.size(); ++end)
        if (begins_character(text[end]) && ++kept > max_width - 3)
          break;
      return text.substr(0, end) + "...";
    }

    /// The text of a number as the table shows it; none if @p text is no finite number.
    std::optional<std::string> shown_number(const std::string &text)
    {
      double     value;
      const auto end = text.data() + text.size();
      const auto got = std::from_chars(text.data(), end, value);
      if (got.ec != std::errc() || got.ptr != end || !std::isfinite(value))
        return {};
      if (text.find_first_not_of("+-0123456789") == std::string::npos)
        return text;

      char buffer[32];
      // 123456.7 as 123457, not as 1.2346e+05.
      const bool long_number = std::abs(value) >= 99999.5 && std::abs(value) < 1e9;
      const auto last
          = long_number
                ? std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::fixed, 0)
                : std::to_chars(
                    buffer, buffer + sizeof(buffer), value, std::chars_format::general, 5);
      return std::string(buffer, last.ptr);
    }
  } // namespace

  std::string format_table(const std::vector<std::string>              &header,
                           const std::vector<std::vector<std::string>> &rows,
                           const unsigned int                           max_width)
  {
    if (max_width < 4)
      throw std::logic_error("a table column is at least 4 characters wide");

    std::vector<std::vector<std::string>> lines;
    std::vector<bool>                     has_numbers(header.size(), false);
    lines.emplace_back();
    for (const std::string &title : header)
      lines.back().push_back(cut(on_one_line(title), max_width));
    for (const auto &row : rows)
      {
        if (row.size() != header.size())
          throw std::logic_error("a table row with more or fewer entries than the header");
        lines.emplace_back();
        for (std::size_t c = 0; c < row.size(); ++c)
          {
            const auto number = shown_number(row[c]);
            has_numbers[c]    = has_numbers[c] || number;
            lines.back().push_back(number ? *number : cut(on_one_line(row[c]), max_width));
          }
      }

    std::vector<std::size_t> widths(header.size(), 0);
    for (const auto &line : lines)
      for (std::size_t c = 0; c < line.size(); ++c)
        widths[c] = std::max(widths[c], width(line[c]));

    std::vector<std::string> rule;
    for (const std::size_t w : widths)
      rule.emplace_back(w, '-');
    lines.insert(lines.begin() + 1, rule);

    std::string table;
    for (const auto &line : lines)
      {
        std::string text;
        for (std::size_t c = 0; c < line.size(); ++c)
          {
            const std::string padding(widths[c] - width(line[c]), ' ');
            text += (c == 0 ? "" : "  ") + (has_numbers[c] ? padding + line[c] : line[c] + padding);
          }
        text.erase(text.find_last_not_of(' ') + 1);
        table += text + '\n';
      }
    return table;
  }
} // namespace isochor
