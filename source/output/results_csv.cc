#include <isochor/core/error.h>
#include <isochor/output/atomic_file.h>
#include <isochor/output/results_csv.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <sstream>

namespace isochor
{
  namespace
  {
    std::string quoted(const std::string &text)
    {
      if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
      std::string result = "\"";
      for (const char c : text)
        result += c == '"' ? "\"\"" : std::string(1, c);
      return result + '"';
    }

    std::string line(const std::vector<std::string> &fields)
    {
      std::string text;
      for (std::size_t i = 0; i < fields.size(); ++i)
        text += (i == 0 ? "" : ",") + quoted(fields[i]);
      return text + '\n';
    }

    /// The records of a CSV text, each ended by a line feed outside quotes.
    std::vector<std::vector<std::string>> records(const std::string &text)
    {
      std::vector<std::vector<std::string>> records;
      std::vector<std::string>              fields(1);
      bool                                  is_quoted = false;
      for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '"')
          {
            // Two quotes within quotes stand for one.
            if (is_quoted && i + 1 < text.size() && text[i + 1] == '"')
              fields.back() += text[i++];
            else
              is_quoted = !is_quoted;
          }
        else if (!is_quoted && text[i] == ',')
          fields.emplace_back();
        else if (!is_quoted && text[i] == '\n')
          {
            records.push_back(std::move(fields));
            fields.assign(1, "");
          }
        else
          fields.back() += text[i];
      return records;
    }
  } // namespace

  std::vector<ResultRow> read_results(const std::filesystem::path &file)
  {
    std::ifstream      stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    std::vector<ResultRow> rows;
    const auto             all = records(text.str());
    for (std::size_t r = 1; r < all.size(); ++r)
      if (all[r].size() == all[0].size())
        {
          ResultRow row;
          for (std::size_t k = 0; k < all[0].size(); ++k)
            row.emplace_back(all[0][k], all[r][k]);
          rows.push_back(std::move(row));
        }
    return rows;
  }

  std::string csv_number(const double value)
  {
    char       text[32];
    const auto end
        = std::to_chars(text, text + sizeof(text), value, std::chars_format::general, 10).ptr;
    return std::string(text, end);
  }

  ResultsCsv::ResultsCsv(MPI_Comm                      communicator,
                         std::filesystem::path         file,
                         const std::vector<ResultRow> &kept)
    : communicator(communicator)
    , file(std::move(file))
  {
    on_root_collectively(communicator, [&]() {
      std::string text;
      for (const ResultRow &row : kept)
        text += lines(row);
      if (!kept.empty())
        write_whole_file(this->file, text);
      stream.reset(std::fopen(this->file.c_str(), kept.empty() ? "wb" : "ab"));
      if (!stream)
        throw UserError(this->file.string() + ": cannot be written: " + std::strerror(errno));
    });
  }

  void ResultsCsv::add(const ResultRow &row)
  {
    on_root_collectively(communicator, [&]() {
      const std::string text = lines(row);
      if (std::fwrite(text.data(), 1, text.size(), stream.get()) != text.size()
          || std::fflush(stream.get()) != 0)
        throw UserError(file.string() + ": cannot be written: " + std::strerror(errno));
    });
  }

  std::string ResultsCsv::lines(const ResultRow &row)
  {
    std::vector<std::string> names, values;
    for (const auto &[name, value] : row)
      {
        names.push_back(name);
        values.push_back(value);
      }
    if (columns.empty())
      {
        columns = names;
        return line(names) + line(values);
      }
    if (names != columns)
      throw std::logic_error(file.string() + ": a row whose columns are not those of the header");
    return line(values);
  }
} // namespace isochor
