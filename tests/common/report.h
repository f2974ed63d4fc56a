#pragma once

// Output of test programs: once under MPI, and errors as a bound that holds or the number itself.

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

namespace isochor::testing
{
  /// std::cout on rank 0, nothing elsewhere.
  inline std::ostream &out()
  {
    static std::ostream nowhere(nullptr);
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout : nowhere;
  }

  /// Keep the larger error. A NaN counts as infinite; std::max would forget it, and so may MPI.
  inline void raise(double &largest, const double error)
  {
    if (!(error <= largest))
      largest = std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
  }

  /// "below 1e-12", or what @p error is instead. Rounding is not worth comparing, its size is.
  inline std::string below(const double error, const double bound)
  {
    std::ostringstream text;
    if (error < bound)
      text << "below " << bound;
    else // NaN too
      text << "NOT BELOW " << bound << ", IT IS " << error;
    return text.str();
  }

  inline std::string yes(const bool holds)
  {
    return holds ? "yes" : "NO";
  }

  /// One decimal, without a negative zero.
  inline std::string one_decimal(const double value)
  {
    std::ostringstream text;
    text.precision(1);
    text << std::fixed << std::round(10. * value) / 10. + 0.;
    return text.str();
  }

  /// What @p action throws as @p Error, or that it does not.
  template <typename Error, typename Action>
  std::string message_of(const Action &action)
  {
    try
      {
        action();
      }
    catch (const Error &error)
      {
        return error.what();
      }
    return "NO ERROR";
  }
} // namespace isochor::testing
