#include <isochor/core/text.h>
#include <isochor/run/plane_scene.h>

#include <algorithm>
#include <functional>
#include <regex>

namespace isochor
{
  namespace
  {
    bool is_zero(const std::string &text)
    {
      static const std::regex zero(R"([+-]?0*\.?0*)");
      return !text.empty() && std::regex_match(text, zero);
    }

    /// Does @p formula name z?
    bool depends_on_z(const std::string &formula)
    {
      static const std::regex z(R"((^|[^A-Za-z_])z($|[^A-Za-z_]))");
      return std::regex_search(formula, z);
    }

    std::string joined(const std::vector<std::string> &pieces, const char *separator)
    {
      std::string text;
      for (const std::string &piece : pieces)
        text += (text.empty() ? "" : separator) + piece;
      return text;
    }

    /// "a, b, c" without c, which must be @p allowed; none otherwise.
    template <typename Allowed>
    std::optional<std::string> without_third(const std::string &text, const Allowed &allowed)
    {
      auto pieces = split_list(text, ',');
      if (pieces.empty())
        return "";
      if (pieces.size() != 3 || !allowed(pieces[2])
          || std::any_of(pieces.begin(), pieces.end(), depends_on_z))
        return {};
      pieces.pop_back();
      return joined(pieces, ", ");
    }

    bool is_side(const std::string &boundary)
    {
      return boundary == "back" || boundary == "front";
    }

    /// Each "BOUNDARY: REST" of @p text with @p convert(REST); none if one cannot be converted.
    template <typename Convert>
    std::optional<std::string> entries(const std::string &text, const Convert &convert)
    {
      std::vector<std::string> kept;
      for (const std::string &entry : split_list(text, ';'))
        {
          const auto        colon    = entry.find(':');
          const std::string boundary = trim(entry.substr(0, colon));
          if (colon == std::string::npos || is_side(boundary))
            return {};
          const auto rest = convert(trim(entry.substr(colon + 1)));
          if (!rest)
            return {};
          kept.push_back(boundary + ": " + *rest);
        }
      return joined(kept, "; ");
    }

    /// Rollers: those along z of front and back, which must be there, are what two dimensions have
    /// anyway; others along z do not change anything there.
    std::optional<std::string> rollers(const std::string &text)
    {
      bool                     is_held[2] = {false, false};
      std::vector<std::string> kept;
      for (const std::string &entry : split_list(text, ';'))
        {
          const auto colon = entry.find(':');
          if (colon == std::string::npos)
            return {};
          const std::string boundary   = trim(entry.substr(0, colon));
          auto              components = split_list(entry.substr(colon + 1), ',');
          const auto        n          = std::erase(components, "z");
          if (is_side(boundary))
            {
              if (n != 1 || !components.empty())
                return {};
              is_held[boundary == "front"] = true;
            }
          else if (!components.empty())
            kept.push_back(boundary + ": " + joined(components, ", "));
        }
      if (!is_held[0] || !is_held[1])
        return {};
      return joined(kept, "; ");
    }

    std::optional<std::string> rotation(const std::string &text)
    {
      static const std::regex form(R"((.+ about .+), *[^,]+ axis (.+))");
      std::smatch             match;
      if (!std::regex_match(text, match, form))
        return {};
      const auto axis = split_list(match[2].str(), ',');
      if (axis.size() != 3 || !is_zero(axis[0]) || !is_zero(axis[1]) || axis[2] != "1")
        return {};
      return match[1].str();
    }

    /// Displacements with a component other than z, volumes, reactions: what has one column in two
    /// dimensions, too.
    std::optional<std::string> probe(const std::string &text)
    {
      static const std::regex taken(
          R"((mean|min|max) displacement (x|y|magnitude)( on .+)?|volume|reaction (x|y|magnitude) on .+)");
      static const std::regex point(R"((displacement (?:x|y|magnitude) at [^,]+,[^,]+),[^,]+)");
      static const std::regex side(R"(.* on (back|front))");
      if (std::smatch match; std::regex_match(text, match, point))
        return match[1].str();
      if (std::regex_match(text, taken) && !std::regex_match(text, side))
        return text;
      return {};
    }
  } // namespace

  std::optional<PlaneScene> plane_scene(const dealii::ParameterHandler &prm)
  {
    const auto get = [&](const std::string &key) { return trim(prm.get({"Scene"}, key)); };
    static const std::regex box(R"(box\(([^,]+),([^,]+),([^,]+)\))");
    std::smatch             lengths;
    const std::string       mesh = get("Mesh");
    if (get("Dimension") != "3" || !std::regex_match(mesh, lengths, box))
      return {};
    for (const std::string &boundary : split_list(get("Fixed"), ','))
      if (is_side(boundary))
        return {};

    const auto vector    = [](const std::string &text) { return without_third(text, is_zero); };
    const auto part      = [&](const std::string &text) { return entries(text, vector); };
    const auto displaced = [](const std::string &text) {
      return entries(text, [](const std::string &components) {
        return without_third(
            components, [](const std::string &third) { return third == "-" || is_zero(third); });
      });
    };
    const auto blocks = [](const std::string &text) {
      return without_third(text, [](const std::string &) { return true; });
    };
    const auto scalar = [](const std::string &text) {
      return entries(text, [](const std::string &formula) {
        return depends_on_z(formula) ? std::nullopt : std::optional(formula);
      });
    };

    PlaneScene plane;
    plane.depth  = parse_number(lengths[3].str(), "Scene/Mesh");
    plane.values = {{"Dimension", "2"},
                    {"Mesh", "rectangle(" + lengths[1].str() + "," + lengths[2].str() + ")"}};
    const std::vector<
        std::pair<std::string, std::function<std::optional<std::string>(const std::string &)>>>
        converted
        = {{"Cells", blocks},
           {"Fixed components", rollers},
           {"Prescribed displacement", displaced},
           {"Prescribed rotation", [](const std::string &text) { return entries(text, rotation); }},
           {"Gravity", vector},
           {"Body force", vector},
           {"Traction", part},
           {"Pressure", scalar},
           {"Initial displacement", vector},
           {"Probes", [](const std::string &text) { return entries(text, probe); }}};
    for (const auto &[key, convert] : converted)
      {
        const auto value = convert(get(key));
        if (!value)
          return {};
        plane.values.emplace_back(key, *value);
      }
    return plane;
  }

  void give_depth(RunResult &result, const double depth)
  {
    for (std::size_t k = 0; k < result.probe_columns.size(); ++k)
      {
        std::string &unit = result.probe_columns[k].unit;
        if (unit != "m^2" && unit != "N/m")
          continue;
        unit = unit == "m^2" ? "m^3" : "N";
        if (k < result.probe_values.size())
          result.probe_values[k] *= depth;
      }
    result.quality.total_volume *= depth;
  }
} // namespace isochor
