#include <isochor/core/error.h>
#include <isochor/core/text.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <sstream>

namespace isochor
{
  namespace
  {
    /// Lower case, without blanks, '-' and '_': what a hurried writer gets right.
    std::string plain(const std::string_view text)
    {
      std::string result;
      for (const char c : text)
        if (!std::isspace(static_cast<unsigned char>(c)) && c != '-' && c != '_')
          result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      return result;
    }

    /// Levenshtein distance.
    std::size_t edit_distance(const std::string_view a, const std::string_view b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const std::size_t above = row[j];
              row[j]                  = std::min(
                  { above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1) });
              diagonal = above;
            }
        }
      return row[b.size()];
    }
  } // namespace

  std::string trim(const std::string_view text)
  {
    const char *blanks = " \t\r\n";
    const auto  first  = text.find_first_not_of(blanks);
    if (first == std::string_view::npos)
      return "";
    return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
  }

  std::string to_text(const double value)
  {
    std::ostringstream out;
    out.precision(12);
    out << value;
    return out.str();
  }

  std::vector<std::string> split_list(const std::string_view text, const char separator)
  {
    std::vector<std::string> pieces;
    std::string              piece;
    int                      depth = 0;
    for (const char c : text)
      {
        if (c == separator && depth <= 0)
          {
            pieces.push_back(trim(piece));
            piece.clear();
            continue;
          }
        depth += (c == '(') - (c == ')');
        piece += c;
      }
    if (!trim(piece).empty())
      pieces.push_back(trim(piece));
    return pieces;
  }

  double parse_number(const std::string_view text, const std::string &what)
  {
    const std::string word   = trim(text);
    const char       *begin  = word.data() + (word.starts_with('+') ? 1 : 0);
    const char       *end    = word.data() + word.size();
    double            value  = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc::result_out_of_range)
      throw UserError(what + ": the number '" + word + "' is too large or too small to be stored");
    if (error != std::errc() || stop != end || !std::isfinite(value))
      throw UserError(what + ": '" + word + "' is not a number");
    return value;
  }

  unsigned int
  parse_whole_number(const std::string_view text, const unsigned int least, const std::string &what)
  {
    const std::string word   = trim(text);
    const char       *end    = word.data() + word.size();
    unsigned int      value  = 0;
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (error != std::errc() || stop != end || value < least)
      throw UserError(what + ": '" + word + "' is not a whole number of at least "
                      + std::to_string(least));
    return value;
  }

  template <int dim>
  dealii::Tensor<1, dim> parse_vector(const std::string_view text, const std::string &what)
  {
    const std::vector<std::string> pieces = split_list(text, ',');
    if (pieces.size() != dim)
      throw UserError(what + ": '" + trim(text) + "' has " + std::to_string(pieces.size())
                      + (pieces.size() == 1 ? " component" : " components") + "; in "
                      + std::to_string(dim) + "D " + std::to_string(dim)
                      + " numbers separated by commas are needed");
    dealii::Tensor<1, dim> vector;
    for (unsigned int d = 0; d < dim; ++d)
      vector[d] = parse_number(pieces[d], what);
    return vector;
  }

  std::string closest(const std::string_view word, const std::vector<std::string> &known)
  {
    const std::string mine = plain(word);
    std::string       best;
    // A third of the letters may be wrong.
    std::size_t least = std::max<std::size_t>(2, mine.size() / 3) + 1;
    for (const std::string &candidate : known)
      {
        const std::string theirs   = plain(candidate);
        std::size_t       distance = edit_distance(mine, theirs);
        // "Poisson" for "Poisson ratio"
        if (mine.size() >= 4 && (theirs.starts_with(mine) || mine.starts_with(theirs)))
          distance = std::min<std::size_t>(distance, 2);
        if (distance < least)
          {
            least = distance;
            best  = candidate;
          }
      }
    return best;
  }

  template dealii::Tensor<1, 2> parse_vector(std::string_view, const std::string &);
  template dealii::Tensor<1, 3> parse_vector(std::string_view, const std::string &);
} // namespace isochor
