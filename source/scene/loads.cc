#include "parts.h"

namespace isochor::scene_parts
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    constexpr const char *gravity_key    = "Gravity";
    constexpr const char *body_force_key = "Body force";
    constexpr const char *traction_key   = "Traction";
    constexpr const char *pressure_key   = "Pressure";
    constexpr const char *initial_key    = "Initial displacement";

    /// One formula per direction. @p form is what is allowed.
    template <int dim>
    std::vector<Expression<dim>>
    parse_formulas(const std::string &text, const std::string &origin, const std::string &form)
    {
      const auto words = split_list(text, ',');
      if (words.size() != dim)
        throw UserError(origin + ": " + std::to_string(words.size())
                        + (words.size() == 1 ? " component" : " components") + " in a body of "
                        + std::to_string(dim) + " dimensions; allowed: " + form);
      std::vector<Expression<dim>> formulas;
      for (const std::string &word : words)
        formulas.emplace_back(word, origin);
      return formulas;
    }
  } // namespace

  void declare_loads(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(gravity_key,
                      "",
                      Patterns::Anything(),
                      "Acceleration of gravity in m/s^2, one number per direction, multiplied by "
                      "the load factor. Default: zero. Example: 0, -9.8, 0");
    prm.declare_entry(body_force_key,
                      "",
                      Patterns::Anything(),
                      "Dead force in N/m^3 of reference volume: FX, FY, FZ (2D: FX, FY). Each "
                      "component is a formula in x, y, z (reference position, m) and load (the "
                      "load factor, 0 to 1), and is additionally multiplied by the load factor. It "
                      "comes on top of Gravity. Default: none. Example: 0, 1e3*sin(pi*x), 0");
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
    prm.declare_entry(initial_key,
                      "",
                      Patterns::Anything(),
                      "Displacement in m that the first load step begins with: UX, UY, UZ (2D: UX, "
                      "UY), formulas in x, y, z (reference position, m); where the body is held, "
                      "the supports count. It chooses between several equilibria (which way a "
                      "column buckles) and changes nothing where there is one. Default: none, the "
                      "body at rest. Example: 0, 1e-3*x^2, 0");
  }

  template <int dim>
  void parse_loads(dealii::ParameterHandler &prm, Scene<dim> &scene)
  {
    if (const std::string gravity = trim(prm.get(gravity_key)); !gravity.empty())
      scene.gravity = parse_vector<dim>(gravity, std::string("Scene/") + gravity_key);

    if (const std::string force = trim(prm.get(body_force_key)); !force.empty())
      scene.body_force
          = parse_formulas<dim>(force,
                                std::string("Scene/") + body_force_key,
                                dim == 2 ? "FX, FY with formulas" : "FX, FY, FZ with formulas");

    if (const std::string initial = trim(prm.get(initial_key)); !initial.empty())
      scene.initial_displacement
          = parse_formulas<dim>(initial,
                                std::string("Scene/") + initial_key,
                                dim == 2 ? "UX, UY with formulas" : "UX, UY, UZ with formulas");

    const std::string form
        = dim == 2 ? "BOUNDARY: TX, TY with formulas" : "BOUNDARY: TX, TY, TZ with formulas";
    for (const Entry &entry : entries_of(prm, traction_key, form))
      {
        check_boundary_name(entry.name, entry.origin);
        scene.tractions.push_back(
            {entry.name, parse_formulas<dim>(entry.value, entry.origin, form), entry.origin});
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
            {entry.name, Expression<dim>(entry.value, entry.origin), entry.origin});
      }
  }

  template void parse_loads(dealii::ParameterHandler &, Scene<2> &);
  template void parse_loads(dealii::ParameterHandler &, Scene<3> &);
} // namespace isochor::scene_parts
