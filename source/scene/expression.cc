#include <isochor/core/error.h>
#include <isochor/core/text.h>
#include <isochor/scene/expression.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <cmath>
#include <iostream>
#include <regex>
#include <sstream>

namespace isochor
{
  namespace
  {
    /// deal.II prints muParser's complaint on std::cerr before it throws; we put it into the
    /// UserError instead.
    class QuietErrorStream
    {
    public:
      QuietErrorStream()
        : usual(std::cerr.rdbuf(swallowed.rdbuf()))
      {
      }
      ~QuietErrorStream()
      {
        std::cerr.rdbuf(usual);
      }
      QuietErrorStream(const QuietErrorStream &)            = delete;
      QuietErrorStream &operator=(const QuietErrorStream &) = delete;

    private:
      std::ostringstream swallowed;
      std::streambuf    *usual;
    };

    template <int dim>
    constexpr const char *variables = dim == 2 ? "x,y,load" : "x,y,z,load";

    /// Opens FunctionParser's evaluation with the time as an argument: setting the time of a
    /// shared object would not be thread-safe.
    template <int dim>
    class Parser : public dealii::FunctionParser<dim>
    {
    public:
      explicit Parser(const std::string &text)
        : dealii::FunctionParser<dim>(1)
      {
        this->initialize(variables<dim>, text, { { "pi", dealii::numbers::PI } }, true);
      }

      double value_at(const dealii::Point<dim> &position, const double load) const
      {
        return this->do_value(position, load, 0);
      }
    };

    /// "Unexpected token "foo" found at position 3."
    std::string complaint_of(const dealii::ExceptionBase &error)
    {
      std::ostringstream info;
      error.print_info(info);
      std::string       text   = info.str();
      const std::string before = "The parser said: ";
      if (const auto begin = text.find(before); begin != std::string::npos)
        text = text.substr(begin + before.size());
      text = trim(std::regex_replace(text, std::regex("\\s+"), " "));
      return text.ends_with('.') ? text : text + ".";
    }

    template <int dim>
    std::string place(const dealii::Point<dim> &position, const double load)
    {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += (d == 0 ? "(" : ", ") + to_text(position[d]);
      return text + ") m, load factor " + to_text(load);
    }
  } // namespace

  template <int dim>
  struct Expression<dim>::Implementation
  {
    std::string                  text;
    std::string                  what;
    std::optional<double>        constant;
    std::unique_ptr<Parser<dim>> parser;
    bool                         depends_on_load = false;
  };

  template <int dim>
  Expression<dim>::Expression(const std::string &text, const std::string &what)
  {
    auto made  = std::make_shared<Implementation>();
    made->text = trim(text);
    made->what = what;
    // FunctionParser would take ';' for the end of a component.
    if (made->text.empty() || made->text.find(';') != std::string::npos)
      throw UserError(what + ": '" + text + "' is not a formula");

    try
      {
        made->constant = parse_number(made->text, what);
      }
    catch (const UserError &)
      {
        const QuietErrorStream quiet;
        try
          {
            made->parser = std::make_unique<Parser<dim>>(made->text);

            // muParser reads the formula when it first evaluates it. A formula such as 1/x may
            // be infinite at the origin and still make sense where it is used.
            bool is_finite = false;
            for (const double coordinate : { 0., 0.0123, 1.7 })
              {
                dealii::Point<dim> position;
                for (unsigned int d = 0; d < dim; ++d)
                  position[d] = coordinate * (1. + 0.1 * d);
                is_finite = is_finite || std::isfinite(made->parser->value_at(position, 1.));
              }
            if (!is_finite)
              throw UserError(what + ": '" + made->text
                              + "' has no finite value, neither at the origin nor elsewhere");
          }
        catch (const dealii::ExceptionBase &error)
          {
            throw UserError(what + ": '" + made->text + "' is not a formula: " + complaint_of(error)
                            + " Variables: " + variables<dim> + "; constant: pi");
          }
      }
    made->depends_on_load = std::regex_search(made->text, std::regex("\\bload\\b"));
    implementation        = made;
  }

  template <int dim>
  double Expression<dim>::value(const dealii::Point<dim> &position, const double load) const
  {
    if (implementation->constant)
      return *implementation->constant;
    const double result = implementation->parser->value_at(position, load);
    if (!std::isfinite(result))
      throw UserError(implementation->what + ": '" + implementation->text
                      + "' has no finite value at " + place(position, load));
    return result;
  }

  template <int dim>
  const std::string &Expression<dim>::text() const
  {
    return implementation->text;
  }

  template <int dim>
  bool Expression<dim>::depends_on_load() const
  {
    return implementation->depends_on_load;
  }

  template <int dim>
  std::optional<double> Expression<dim>::constant() const
  {
    return implementation->constant;
  }

  template class Expression<2>;
  template class Expression<3>;
} // namespace isochor
