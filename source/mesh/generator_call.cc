#include "generator_call.h"

#include <algorithm>
#include <cmath>
#include <regex>

namespace isochor
{
  namespace
  {
    // More cells than anyone means: a size in the wrong unit must not fill the memory.
    constexpr double max_blocks = 5e7;

    const std::regex &call_pattern()
    {
      static const std::regex pattern(R"(\s*([A-Za-z]\w*)\s*\((.*)\)\s*)");
      return pattern;
    }
  } // namespace

  const std::vector<GeneratorForm> &generator_forms()
  {
    static const std::vector<GeneratorForm> forms
        = {{"box",
            "box(lx, ly, lz)",
            3,
            3,
            {"along x", "along y", "along z"},
            {"left", "right", "bottom", "top", "back", "front"}},
           {"cylinder",
            "cylinder(radius, length)",
            2,
            3,
            {"around a quarter", "from the square core to the side", "along x"},
            {"left", "right", "side"}},
           {"tube",
            "tube(inner, outer, length)",
            3,
            3,
            {"through the wall", "around a quarter", "along x"},
            {"left", "right", "inner", "outer"}},
           {"sphere_octant",
            "sphere_octant(inner, outer)",
            2,
            3,
            {"through the wall", "along half an edge of the octant"},
            {"left", "bottom", "back", "inner", "outer"}},
           {"rectangle",
            "rectangle(lx, ly)",
            2,
            2,
            {"along x", "along y"},
            {"left", "right", "bottom", "top"}},
           {"quadrilateral",
            "quadrilateral(x0,y0, x1,y1, x2,y2, x3,y3)",
            8,
            2,
            {"along the bottom", "along the left side"},
            {"left", "right", "bottom", "top"}},
           {"annulus_quarter",
            "annulus_quarter(inner, outer)",
            2,
            2,
            {"through the wall", "around"},
            {"inner", "outer", "bottom", "left"}}};
    return forms;
  }

  bool is_generator(const std::string &source)
  {
    return std::regex_match(source, call_pattern());
  }

  const GeneratorForm &generator_form(const std::string &source)
  {
    std::smatch match;
    if (!std::regex_match(source, match, call_pattern()))
      throw UserError("Mesh '" + source + "': neither a generator nor a file");
    std::vector<std::string> calls;
    for (const GeneratorForm &form : generator_forms())
      {
        if (form.name == match[1])
          return form;
        calls.push_back(form.call);
      }
    throw UserError("Mesh '" + source + "': no generator is named '" + match[1].str() + "'; choose "
                    + listed(calls));
  }

  GeneratorCall parse_generator(const std::string &source)
  {
    GeneratorCall call{generator_form(source), {}, "Mesh '" + source + "'"};
    std::smatch   match;
    std::regex_match(source, match, call_pattern());
    const std::string text = match[2];
    for (std::size_t begin = 0; begin <= text.size();)
      {
        const std::size_t end    = std::min(text.find(',', begin), text.size());
        const std::string word   = text.substr(begin, end - begin);
        std::size_t       used   = 0;
        double            number = 0;
        try
          {
            number = std::stod(word, &used);
          }
        catch (const std::exception &)
          {
            used = 0;
          }
        if (used == 0 || word.find_first_not_of(" \t", used) != std::string::npos
            || !std::isfinite(number))
          throw UserError(call.origin + ": '"
                          + word.substr(std::min(word.find_first_not_of(" \t"), word.size()))
                          + "' is not a number");
        call.arguments.push_back(number);
        begin = end + 1;
      }
    if (call.arguments.size() != call.form.n_arguments)
      throw UserError(call.origin + ": " + std::to_string(call.arguments.size()) + " numbers where "
                      + call.form.call + " takes " + std::to_string(call.form.n_arguments));
    return call;
  }

  void expect_lengths(const GeneratorCall &call)
  {
    for (const double length : call.arguments)
      if (!(length > 0))
        throw UserError(call.origin + ": lengths must be positive");
  }

  void expect_radii(const GeneratorCall &call)
  {
    expect_lengths(call);
    if (!(call.arguments[0] < call.arguments[1]))
      throw UserError(call.origin
                      + ": the inner radius comes first and must be smaller than the "
                        "outer");
  }

  std::vector<unsigned int> block_counts(const GeneratorCall       &call,
                                         const MeshRequest         &request,
                                         const std::vector<double> &lengths,
                                         const double               repeats)
  {
    std::vector<double> counts;
    if (!request.cells.empty())
      {
        counts.assign(request.cells.begin(), request.cells.end());
        if (counts.size() != call.form.counts.size())
          {
            std::string meaning;
            for (const std::string &count : call.form.counts)
              meaning += (meaning.empty() ? "" : ", ") + count;
            throw UserError(call.origin + ": " + std::to_string(counts.size())
                            + " numbers of cells were given; it takes "
                            + std::to_string(call.form.counts.size()) + ": " + meaning);
          }
        if (*std::min_element(counts.begin(), counts.end()) < 1)
          throw UserError(call.origin + ": each direction needs at least one cell");
      }
    else if (request.size > 0)
      for (const double length : lengths)
        counts.push_back(std::max(1., std::round(length / request.size)));
    else
      throw UserError(call.origin
                      + ": give the edge length (Mesh size) or the numbers of cells (Cells)");

    double total = repeats;
    for (const double count : counts)
      total *= count;
    if (!(total <= max_blocks))
      throw UserError(call.origin
                      + ": that would be more than 50 million blocks; is the size in metres?");
    return {counts.begin(), counts.end()};
  }
} // namespace isochor
