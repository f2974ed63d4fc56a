#include <isochor/core/error.h>
#include <isochor/element/element_table.h>

namespace isochor
{
  const std::vector<Element> &element_table()
  {
    using enum CellKind;
    constexpr FieldSpace constant{Family::discontinuous, 0}, linear{Family::lagrange, 1},
        quadratic{Family::lagrange, 2}, cubic{Family::lagrange, 3}, bubble{Family::bubble, 1},
        broken_linear{Family::discontinuous, 1};
    // P1 and its pairs have constant J, so one point is exact: the integral of N_p over a cell times
    // J; the pressure mass matrix is integrated in closed form. MINI: the product of two gradients
    // of the bubble is of degree 6.
    static const std::vector<Element> table
        = {{"P1", simplex, linear, {}, 1},
           {"P2", simplex, quadratic, {}, 4},
           {"P3", simplex, cubic, {}, 6},
           {"P1-P1", simplex, linear, linear, 1},
           {"P1-P1s", simplex, linear, linear, 1, true, true},
           {"P1-P0", simplex, linear, constant, 1},
           {"MINI", simplex, bubble, linear, 6, true},
           {"P2-P0", simplex, quadratic, constant, 4},
           {"P2-P1", simplex, quadratic, linear, 4, true},
           {"P3-P2", simplex, cubic, quadratic, 6, true},
           {"Q1", hypercube, linear, {}, 3},
           {"Q2", hypercube, quadratic, {}, 5},
           {"Q1-P0", hypercube, linear, constant, 3},
           {"Q2-P1", hypercube, quadratic, broken_linear, 5, true}};
    return table;
  }

  const Element &find_element(const std::string &name, const std::string &what)
  {
    for (const Element &element : element_table())
      if (element.name == name)
        return element;
    throw UserError(what + ": '" + name + "' is not an element; choose "
                    + listed(element_names([](const Element &) { return true; })));
  }

  std::string element_selection()
  {
    std::string text;
    for (const Element &element : element_table())
      text += (text.empty() ? "" : "|") + std::string(element.name);
    return text;
  }
} // namespace isochor
