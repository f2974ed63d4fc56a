#include "parts.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <regex>

namespace isochor::scene_parts
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    constexpr const char *fixed_key     = "Fixed";
    constexpr const char *component_key = "Fixed components";
    constexpr const char *moved_key     = "Prescribed displacement";
    constexpr const char *rotated_key   = "Prescribed rotation";

    template <int dim>
    dealii::Tensor<1, dim> no_displacement(const dealii::Point<dim> &, double)
    {
      return {};
    }

    /// (R - I) r for the rotation R by @p angle about the unit vector @p axis (Rodrigues), right-
    /// handed; written with the half angle, because 1 - cos loses the digits of small angles.
    dealii::Tensor<1, 3> rotated_minus_original(const dealii::Tensor<1, 3> &r,
                                                const dealii::Tensor<1, 3> &axis,
                                                double                      angle)
    {
      const auto   across = cross_product_3d(axis, r);
      const double s      = std::sin(angle / 2.);
      return std::sin(angle) * across + 2. * s * s * cross_product_3d(axis, across);
    }

    template <int dim>
    void parse_fixed(dealii::ParameterHandler &prm, std::vector<Support<dim>> &supports)
    {
      std::string text = prm.get(fixed_key);
      std::ranges::replace(text, ';', ',');
      std::vector<std::string> names;
      for (const std::string &name : split_list(text, ','))
        {
          const std::string origin = std::string("Scene/") + fixed_key + ": entry '" + name + "'";
          if (name.find(':') != std::string::npos)
            throw UserError(origin
                            + ": a ':' has no meaning here; allowed: boundary names "
                              "separated by commas (single components: Scene/"
                            + component_key + ")");
          check_boundary_name(name, origin);
          if (std::ranges::count(names, name) > 0)
            throw UserError(origin + ": named twice; allowed: each boundary once");
          names.push_back(name);

          Support<dim> support;
          support.boundary = name;
          support.origin   = origin;
          support.components.fill(true);
          support.displacement = no_displacement<dim>;
          supports.push_back(support);
        }
    }

    template <int dim>
    void parse_fixed_components(dealii::ParameterHandler &prm, std::vector<Support<dim>> &supports)
    {
      for (const Entry &entry :
           entries_of(prm, component_key, "BOUNDARY: COMPONENTS, such as left: x, z"))
        {
          check_boundary_name(entry.name, entry.origin);
          Support<dim> support;
          support.boundary = entry.name;
          support.origin   = entry.origin;
          for (const std::string &word : split_list(entry.value, ','))
            support.components[parse_component(word, dim, entry.origin)] = true;
          support.displacement = no_displacement<dim>;
          supports.push_back(support);
        }
    }

    template <int dim>
    void parse_moved(dealii::ParameterHandler &prm, std::vector<Support<dim>> &supports)
    {
      const std::string form = dim == 2 ? "BOUNDARY: UX, UY with formulas or '-' (free)"
                                        : "BOUNDARY: UX, UY, UZ with formulas or '-' (free)";
      for (const Entry &entry : entries_of(prm, moved_key, form))
        {
          check_boundary_name(entry.name, entry.origin);
          const auto words = split_list(entry.value, ',');
          if (words.size() != dim)
            throw UserError(entry.origin + ": " + std::to_string(words.size())
                            + (words.size() == 1 ? " component" : " components") + " in a body of "
                            + std::to_string(dim) + " dimensions; allowed: " + form);
          if (std::ranges::count(words, "-") == dim)
            throw UserError(entry.origin
                            + ": all components are left free, so it prescribes "
                              "nothing; allowed: "
                            + form);

          Support<dim> support;
          support.boundary = entry.name;
          support.origin   = entry.origin;
          std::array<std::optional<Expression<dim>>, dim> formulas;
          for (unsigned int d = 0; d < dim; ++d)
            if (words[d] != "-")
              {
                formulas[d].emplace(words[d], entry.origin);
                support.components[d] = true;
                support.moves         = support.moves || formulas[d]->depends_on_load();
              }
          support.displacement = [formulas](const dealii::Point<dim> &position, const double load) {
            dealii::Tensor<1, dim> displacement;
            for (unsigned int d = 0; d < dim; ++d)
              if (formulas[d])
                displacement[d] = formulas[d]->value(position, load);
            return displacement;
          };
          supports.push_back(support);
        }
    }

    template <int dim>
    void parse_rotated(dealii::ParameterHandler &prm, std::vector<Support<dim>> &supports)
    {
      const std::string       form = dim == 2 ? "BOUNDARY: DEGREES about X, Y"
                                              : "BOUNDARY: DEGREES about X, Y, Z axis AX, AY, AZ";
      static const std::regex syntax(dim == 2 ? R"((\S+)\s+about\s+(.+))"
                                              : R"((\S+)\s+about\s+(.+?)\s+axis\s+(.+))");
      for (const Entry &entry : entries_of(prm, rotated_key, form))
        {
          check_boundary_name(entry.name, entry.origin);
          std::smatch match;
          if (!std::regex_match(entry.value, match, syntax))
            throw UserError(entry.origin + ": '" + entry.value + "' is not a rotation; allowed in "
                            + std::to_string(dim) + "D: " + form);
          const double angle
              = parse_number(match[1].str(), entry.origin) * dealii::numbers::PI / 180.;
          const dealii::Point<dim> centre(parse_vector<dim>(match[2].str(), entry.origin));
          dealii::Tensor<1, 3>     axis;
          axis[2] = 1.;
          if constexpr (dim == 3)
            {
              axis = parse_vector<3>(match[3].str(), entry.origin);
              if (!(axis.norm() > 0.))
                throw UserError(entry.origin
                                + ": the axis has no direction; allowed: a vector "
                                  "other than 0, 0, 0");
              axis /= axis.norm();
            }

          Support<dim> support;
          support.boundary = entry.name;
          support.origin   = entry.origin;
          support.components.fill(true);
          support.moves = angle != 0.;
          support.displacement
              = [angle, centre, axis](const dealii::Point<dim> &position, const double load) {
                  dealii::Tensor<1, 3> r;
                  for (unsigned int d = 0; d < dim; ++d)
                    r[d] = position[d] - centre[d];
                  const auto             u = rotated_minus_original(r, axis, load * angle);
                  dealii::Tensor<1, dim> displacement;
                  for (unsigned int d = 0; d < dim; ++d)
                    displacement[d] = u[d];
                  return displacement;
                };
          supports.push_back(support);
        }
    }
  } // namespace

  void declare_supports(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(fixed_key,
                      "",
                      Patterns::Anything(),
                      "Boundaries that cannot move at all, separated by commas. Default: none. "
                      "Example: left, right");
    prm.declare_entry(component_key,
                      "",
                      Patterns::Anything(),
                      "Boundaries that cannot move in some directions (rollers, symmetry planes): "
                      "BOUNDARY: COMPONENTS, entries separated by semicolons, components x, y, z. "
                      "Default: none. Example: bottom: y; left: x, z");
    prm.declare_entry(moved_key,
                      "",
                      Patterns::Anything(),
                      "Boundaries whose displacement in m is given: BOUNDARY: UX, UY, UZ (2D: UX, "
                      "UY), entries separated by semicolons. Each component is a formula in x, y, "
                      "z (reference position, m) and load (the load factor, 0 to 1), or '-', "
                      "which leaves it free. Nothing is multiplied by the load factor unless the "
                      "formula does it. Default: none. Example: right: 0.1*load, 0, -");
    prm.declare_entry(rotated_key,
                      "",
                      Patterns::Anything(),
                      "Boundaries turned as rigid plates, by an angle in degrees times the load "
                      "factor, right-handed about an axis through a point in m: BOUNDARY: DEGREES "
                      "about X, Y, Z axis AX, AY, AZ (2D: DEGREES about X, Y, counterclockwise), "
                      "entries separated by semicolons. Default: none. Example: right: 90 about 0, "
                      "0.05, 0.05 axis 1, 0, 0");
  }

  template <int dim>
  void parse_supports(dealii::ParameterHandler &prm, Scene<dim> &scene)
  {
    parse_fixed(prm, scene.supports);
    parse_fixed_components(prm, scene.supports);
    parse_moved(prm, scene.supports);
    parse_rotated(prm, scene.supports);
  }

  template void parse_supports(dealii::ParameterHandler &, Scene<2> &);
  template void parse_supports(dealii::ParameterHandler &, Scene<3> &);
} // namespace isochor::scene_parts
