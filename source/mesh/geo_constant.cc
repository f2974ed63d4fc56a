#include <isochor/mesh/generator.h>
#include <isochor/mesh/geo_constant.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

namespace isochor
{
  std::optional<std::string> geo_constant(const std::string &path, const std::string &name)
  {
    std::ifstream     file(path);
    std::stringstream text;
    text << file.rdbuf();
    std::string source = text.str();
    // Comments first: the second pattern must not see a DefineConstant that is out of use.
    // (Not by std::regex: it recurses per character and overflows the stack on long files.)
    for (std::size_t begin = 0; (begin = source.find('/', begin)) != std::string::npos;)
      {
        std::size_t end = std::string::npos;
        if (source.compare(begin, 2, "//") == 0)
          end = source.find('\n', begin);
        else if (source.compare(begin, 2, "/*") == 0)
          end = source.find("*/", begin + 2) == std::string::npos
                    ? std::string::npos
                    : source.find("*/", begin + 2) + 2;
        else
          {
            ++begin;
            continue;
          }
        source.replace(begin, end == std::string::npos ? end : end - begin, " ");
      }
    const std::regex constant(R"((^|[\s,\[]))" + name + R"(\s*(=\s*([^,]*)|,|$))");
    for (std::size_t begin = 0; (begin = source.find("DefineConstant", begin)) != std::string::npos;
         ++begin)
      {
        const std::size_t open  = source.find('[', begin);
        const std::size_t close = source.find(']', begin);
        if (!(open < close && close != std::string::npos))
          continue;
        const std::string constants = source.substr(open + 1, close - open - 1);
        if (std::smatch match; std::regex_search(constants, match, constant))
          return match[3].str();
      }
    return {};
  }

  bool offers_hypercubes(const MeshRequest &request)
  {
    return is_generator(request.source)
           || (request.source.ends_with(".geo") && geo_constant(request.source, "hexahedra"));
  }

  std::optional<double> edge_length(const MeshRequest &request)
  {
    if (request.size > 0)
      return request.size;
    if (!request.source.ends_with(".geo"))
      return {};
    const auto   text = geo_constant(request.source, "size");
    const double size = text ? std::strtod(text->c_str(), nullptr) : 0.;
    return size > 0 ? std::optional(size) : std::nullopt;
  }
} // namespace isochor
