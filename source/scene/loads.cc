#include "parts.h"

namespace isochor::scene_parts
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    constexpr const char *gravity_key  = "Gravity";
    constexpr const char *traction_key = "Traction";
    constexpr const char *pressure_key = "Pressure";
  } // namespace

  void declare_loads(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(gravity_key,
                      "",
                      Patterns::Anything(),
                      "Acceleration of gravity in m/s^2, one number per direction, multiplied by "
                      "the load factor. Default: zero. Example: 0, -9.8, 0");
    prm.declare_entry(traction_key,
                      "",
                      Patterns::Anything(),
                      "Dead forces in Pa of reference area that keep their direction: BOUNDARY: "
                      "TX, TY, TZ (2D: TX, TY), entries separated by semicolons. Each component is "
                      "a formula in x, y, z (reference position, m) and load (the load factor, 0 "
                      "to 1), and is additionally multiplied by the load factor. Default: none. "
                      "Example: right: 0, 6.25e6, 0");
    prm.declare_entry(pressure_key,
                      "",
                      Patterns::Anything(),
                      "Pressure in Pa of deformed area that stays normal to the deformed boundary "
                      "and, if positive, pushes against the body: BOUNDARY: FORMULA, entries "
                      "separated by semicolons; the formula in x, y, z (reference position, m) and "
                      "load is additionally multiplied by the load factor. Default: none. Example: "
                      "inner: 10e3");
  }

  template <int dim>
  void parse_loads(dealii::ParameterHandler &prm, Scene<dim> &scene)
  {
    if (const std::string gravity = trim(prm.get(gravity_key)); !gravity.empty())
      scene.gravity = parse_vector<dim>(gravity, std::string("Scene/") + gravity_key);

    const std::string form
        = dim == 2 ? "BOUNDARY: TX, TY with formulas" : "BOUNDARY: TX, TY, TZ with formulas";
    for (const Entry &entry : entries_of(prm, traction_key, form))
      {
        check_boundary_name(entry.name, entry.origin);
        const auto words = split_list(entry.value, ',');
        if (words.size() != dim)
          throw UserError(entry.origin + ": " + std::to_string(words.size())
                          + (words.size() == 1 ? " component" : " components") + " in a body of "
                          + std::to_string(dim) + " dimensions; allowed: " + form);
        Traction<dim> traction;
        traction.boundary = entry.name;
        traction.origin   = entry.origin;
        for (const std::string &word : words)
          traction.components.emplace_back(word, entry.origin);
        scene.tractions.push_back(traction);
      }

    for (const Entry &entry :
         entries_of(prm, pressure_key, "BOUNDARY: FORMULA, such as inner: 10e3"))
      {
        check_boundary_name(entry.name, entry.origin);
        if (split_list(entry.value, ',').size() != 1)
          throw UserError(entry.origin
                          + ": a pressure is a single formula; allowed: BOUNDARY: "
                            "FORMULA, such as inner: 10e3 (forces with a direction: Scene/"
                          + traction_key + ")");
        scene.pressures.push_back(
            { entry.name, Expression<dim>(entry.value, entry.origin), entry.origin });
      }
  }

  template void parse_loads(dealii::ParameterHandler &, Scene<2> &);
  template void parse_loads(dealii::ParameterHandler &, Scene<3> &);
} // namespace isochor::scene_parts
