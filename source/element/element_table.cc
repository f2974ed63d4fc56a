#include <isochor/core/error.h>
#include <isochor/element/element_table.h>

namespace isochor
{
  const std::vector<Element> &element_table()
  {
    // P1 and P1-P1 have constant J and one-point quadrature is exact: the integral of N_p over a
    // cell times J, and the pressure mass matrix is integrated in closed form.
    static const std::vector<Element> table
        = { { "P1", 1, {}, 1 },   { "P2", 2, {}, 4 },   { "P3", 3, {}, 6 },
            { "P1-P1", 1, 1, 1 }, { "P2-P1", 2, 1, 4 }, { "P3-P2", 3, 2, 6 } };
    return table;
  }

  const Element &find_element(const std::string &name, const std::string &what)
  {
    std::vector<std::string> known;
    for (const Element &element : element_table())
      {
        if (element.name == name)
          return element;
        known.emplace_back(element.name);
      }
    throw UserError(what + ": '" + name + "' is not an element; choose " + listed(known));
  }

  std::string element_selection()
  {
    std::string text;
    for (const Element &element : element_table())
      text += (text.empty() ? "" : "|") + std::string(element.name);
    return text;
  }

  std::vector<std::string> mixed_element_names()
  {
    std::vector<std::string> names;
    for (const Element &element : element_table())
      if (element.is_mixed())
        names.emplace_back(element.name);
    return names;
  }
} // namespace isochor
