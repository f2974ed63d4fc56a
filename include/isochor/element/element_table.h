#pragma once

// The element table: an element is one row of data. Nothing else in the code asks which
// element is in use.

#include <isochor/element/shape_functions.h>

#include <optional>
#include <string>
#include <string_view>

namespace isochor
{
  struct Element
  {
    std::string_view          name;
    CellKind                  kind;
    FieldSpace                displacement;
    std::optional<FieldSpace> pressure; ///< none: displacement element
    /// Degree that the cell quadrature integrates exactly on straight cells (curved simplices take
    /// two more). On affine simplices J is a polynomial of degree 3 (k - 1): 0 for linear, 3 for
    /// quadratic, 6 for cubic displacements. Hypercubes: Gauss with k + 1 points per coordinate.
    unsigned int quadrature_degree;
    /// Does it pass the inf-sup test in three dimensions? (tests/measure/inf_sup)
    bool is_stable = false;
    /// P1-P1s: the polynomial pressure projection of Bochev, Dohrmann and Gunzburger 2006.
    bool is_stabilised = false;

    bool is_mixed() const
    {
      return pressure.has_value();
    }
    bool has_discontinuous_pressure() const
    {
      return pressure && pressure->family == Family::discontinuous;
    }
    bool has_bubble() const
    {
      return displacement.family == Family::bubble;
    }
  };

  const std::vector<Element> &element_table();

  /// Throws UserError naming @p what and the known elements.
  const Element &find_element(const std::string &name, const std::string &what);

  /// "P1|P2|...", for dealii::Patterns::Selection.
  std::string element_selection();

  /// Names of the elements for which @p condition holds, for advice.
  template <typename Condition>
  std::vector<std::string> element_names(const Condition &condition)
  {
    std::vector<std::string> names;
    for (const Element &element : element_table())
      if (condition(element))
        names.emplace_back(element.name);
    return names;
  }
} // namespace isochor
