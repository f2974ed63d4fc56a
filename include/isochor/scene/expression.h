#pragma once

// A formula of the parameter file in x, y, z (reference position, metres) and load (the load
// factor, 0 to 1), evaluated by deal.II's FunctionParser.

#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace isochor
{
  template <int dim>
  class Expression
  {
  public:
    /// @p what names the parameter for messages. Throws UserError if @p text does not parse or
    /// gives no finite number at the origin with load = 1 nor elsewhere.
    Expression(const std::string &text, const std::string &what);

    double value(const dealii::Point<dim> &position, double load) const;

    const std::string &text() const;

  private:
    struct Implementation; // keeps FunctionParser out of this header
    std::shared_ptr<Implementation> implementation;
  };
} // namespace isochor
