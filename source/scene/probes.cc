#include "parts.h"

#include <algorithm>
#include <regex>

namespace isochor::scene_parts
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    constexpr const char *probes_key = "Probes";

    constexpr auto form
        = "'mean|min|max displacement [x|y|z|magnitude] [on BOUNDARY]', 'displacement [x|y|z|"
          "magnitude] at X, Y, Z', 'volume', 'cavity volume in BOUNDARY', 'reaction "
          "[x|y|z|magnitude] on BOUNDARY', 'displacement L2|H1 error against UX, UY, UZ' or "
          "'pressure L2 error [without mean] against P' with formulas";

    template <int dim>
    std::optional<unsigned int> component_of(const std::string &word, const std::string &origin)
    {
      if (word.empty())
        return {};
      if (word == "magnitude")
        return dim;
      try
        {
          return parse_component(word, dim, origin);
        }
      catch (const UserError &error)
        {
          throw UserError(error.what() + std::string("; also magnitude"));
        }
    }

    /// The @p n formulas of an exact field.
    template <int dim>
    std::vector<Expression<dim>>
    parse_exact(const std::string &text, const std::size_t n, const std::string &origin)
    {
      const auto words = split_list(text, ',');
      if (words.size() != n)
        throw UserError(origin + ": " + std::to_string(words.size())
                        + (words.size() == 1 ? " formula" : " formulas")
                        + " for the exact field; allowed in " + std::to_string(dim)
                        + "D: " + std::to_string(n) + ", separated by commas");
      std::vector<Expression<dim>> exact;
      for (const std::string &word : words)
        exact.emplace_back(word, origin);
      return exact;
    }

    /// Fills in all but name and origin; false if @p text has none of the forms.
    template <int dim>
    bool fill(ProbeRequest<dim> &probe, const std::string &text)
    {
      static const std::regex extreme(
          R"((mean|min|max) displacement(?: (?!on )(\S+))?(?: on (.+))?)");
      static const std::regex point(R"(displacement(?: (?!at )(\S+))? at (.+))");
      static const std::regex cavity(R"(cavity volume in (.+))");
      static const std::regex reaction(R"(reaction(?: (?!on )(\S+))? on (.+))");

      static const std::regex displacement_error(R"(displacement (L2|H1) error against (.+))");
      static const std::regex pressure_error(R"(pressure L2 error( without mean)? against (.+))");

      std::smatch match;
      if (std::regex_match(text, match, displacement_error))
        {
          probe.kind  = match[1] == "L2" ? ProbeKind::displacement_l2_error
                                         : ProbeKind::displacement_h1_error;
          probe.exact = parse_exact<dim>(match[2], dim, probe.origin);
        }
      else if (std::regex_match(text, match, pressure_error))
        {
          probe.kind         = ProbeKind::pressure_l2_error;
          probe.without_mean = match[1].matched;
          probe.exact        = parse_exact<dim>(match[2], 1, probe.origin);
        }
      else if (std::regex_match(text, match, extreme))
        {
          probe.kind      = match[1] == "mean"  ? ProbeKind::mean_displacement
                            : match[1] == "min" ? ProbeKind::min_displacement
                                                : ProbeKind::max_displacement;
          probe.component = component_of<dim>(match[2], probe.origin);
          probe.boundary  = match[3];
        }
      else if (std::regex_match(text, match, point))
        {
          probe.kind      = ProbeKind::point_displacement;
          probe.component = component_of<dim>(match[1], probe.origin);
          probe.point     = dealii::Point<dim>(parse_vector<dim>(match[2].str(), probe.origin));
        }
      else if (text == "volume")
        probe.kind = ProbeKind::volume;
      else if (std::regex_match(text, match, cavity))
        {
          probe.kind     = ProbeKind::cavity_volume;
          probe.boundary = match[1];
        }
      else if (std::regex_match(text, match, reaction))
        {
          probe.kind      = ProbeKind::reaction;
          probe.component = component_of<dim>(match[1], probe.origin);
          probe.boundary  = match[2];
        }
      else
        return false;
      return true;
    }
  } // namespace

  void declare_probes(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(probes_key,
                      "",
                      Patterns::Anything(),
                      "Figures to measure in every run, entries NAME: WHAT separated by "
                      "semicolons. WHAT is mean, min or max displacement (m) [x|y|z|magnitude] "
                      "[on BOUNDARY], without boundary of the whole body; displacement (m) "
                      "[x|y|z|magnitude] at X, Y, Z (a reference position in m); volume (m^3, 2D: "
                      "m^2) of the deformed body; cavity volume in BOUNDARY (m^3) that the "
                      "deformed boundary encloses; reaction [x|y|z|magnitude] on BOUNDARY (N, 2D: "
                      "N/m), the force that the supports exert there; displacement L2 error "
                      "against UX, UY, UZ, the norm (m^2.5, 2D: m^2) of the difference from an "
                      "exact displacement in m; displacement H1 error against UX, UY, UZ, that of "
                      "the difference of the gradients (m^1.5, 2D: m); pressure L2 error [without "
                      "mean] against P (Pa m^1.5, 2D: Pa m), without mean if the pressure is known "
                      "up to a constant. Exact fields are formulas in x, y, z (reference position, "
                      "m) and load (the load factor). Without a component: all of them. Default: "
                      "none. Example: tip: mean displacement y on right; v: volume");
  }

  template <int dim>
  void parse_probes(dealii::ParameterHandler &prm, Scene<dim> &scene)
  {
    for (const Entry &entry :
         entries_of(prm, probes_key, std::string("NAME: WHAT; WHAT is ") + form))
      {
        // Names become columns of results.csv.
        if (!std::regex_match(entry.name, std::regex("[A-Za-z0-9_.-][A-Za-z0-9 _.-]*")))
          throw UserError(entry.origin + ": '" + entry.name
                          + "' cannot be the name of a probe; "
                            "allowed: letters, digits, blanks, '_', '.' and '-'");
        for (const ProbeRequest<dim> &other : scene.probes)
          if (other.name == entry.name)
            throw UserError(entry.origin + ": another probe has the name '" + entry.name
                            + "'; allowed: a name of its own for each probe");

        ProbeRequest<dim> &probe = scene.probes.emplace_back();
        probe.name               = entry.name;
        probe.origin             = entry.origin;
        if (!fill(probe, std::regex_replace(entry.value, std::regex("\\s+"), " ")))
          throw UserError(entry.origin + ": '" + entry.value
                          + "' is nothing that can be measured; "
                            "allowed: "
                          + form);
        if (!probe.boundary.empty())
          check_boundary_name(probe.boundary, entry.origin);
      }
  }

  template void parse_probes(dealii::ParameterHandler &, Scene<2> &);
  template void parse_probes(dealii::ParameterHandler &, Scene<3> &);
} // namespace isochor::scene_parts
