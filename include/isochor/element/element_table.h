#pragma once

// The element table: an element is one row of data. Nothing else in the code asks which
// element is in use.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochor
{
  struct Element
  {
    std::string_view            name;
    unsigned int                displacement_degree;
    std::optional<unsigned int> pressure_degree; ///< none: displacement element
    /// Polynomial degree that the cell quadrature integrates exactly. On affine cells J is a
    /// polynomial of degree 3 (k - 1): 0 for linear, 3 for quadratic, 6 for cubic displacements.
    unsigned int quadrature_degree;

    bool is_mixed() const
    {
      return pressure_degree.has_value();
    }
  };

  const std::vector<Element> &element_table();

  /// Throws UserError naming @p what and the known elements.
  const Element &find_element(const std::string &name, const std::string &what);

  /// "P1|P2|...", for dealii::Patterns::Selection.
  std::string element_selection();

  /// Names of the mixed elements, for advice.
  std::vector<std::string> mixed_element_names();
} // namespace isochor
