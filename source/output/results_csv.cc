#include <isochor/core/error.h>
#include <isochor/output/results_csv.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>

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
  } // namespace

  std::string csv_number(const double value)
  {
    char       text[32];
    const auto end
        = std::to_chars(text, text + sizeof(text), value, std::chars_format::general, 10).ptr;
    return std::string(text, end);
  }

  ResultsCsv::ResultsCsv(MPI_Comm communicator, std::filesystem::path file)
    : communicator(communicator)
    , file(std::move(file))
  {
    on_root_collectively(communicator, [&]() {
      stream.reset(std::fopen(this->file.c_str(), "wb"));
      if (!stream)
        throw UserError(this->file.string() + ": cannot be written: " + std::strerror(errno));
    });
  }

  void ResultsCsv::add(const ResultRow &row)
  {
    on_root_collectively(communicator, [&]() {
      std::vector<std::string> names, values;
      for (const auto &[name, value] : row)
        {
          names.push_back(name);
          values.push_back(value);
        }
      if (columns.empty())
        {
          write(line(names) + line(values));
          columns = names;
        }
      else if (names == columns)
        write(line(values));
      else
        throw std::logic_error(file.string() + ": a row whose columns are not those of the header");
    });
  }

  void ResultsCsv::write(const std::string &text)
  {
    if (std::fwrite(text.data(), 1, text.size(), stream.get()) != text.size()
        || std::fflush(stream.get()) != 0)
      throw UserError(file.string() + ": cannot be written: " + std::strerror(errno));
  }
} // namespace isochor
