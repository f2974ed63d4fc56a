#pragma once

// A formula of the parameter file in x, y, z (reference position, metres) and load (the load
// factor, 0 to 1), with the constant pi, evaluated by deal.II's FunctionParser.

#include <deal.II/base/point.h>

#include <memory>
#include <optional>
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

    /// Throws UserError if the value is not finite. Evaluation may happen on some ranks only:
    /// under MPI call it within `collectively`. Thread-safe.
    double value(const dealii::Point<dim> &position, double load) const;

    const std::string &text() const;

    /// Does the formula mention the load factor?
    bool depends_on_load() const;

    /// The value, if the formula is a plain number.
    std::optional<double> constant() const;

  private:
    struct Implementation; // keeps FunctionParser out of this header
    std::shared_ptr<const Implementation> implementation;
  };
} // namespace isochor
