// The console table: alignment, significant digits, long texts cut, characters of two bytes.

#include <isochor/output/table.h>

#include <iostream>
#include <stdexcept>

using namespace isochor;

int main()
{
  std::cout << format_table({"method", "cells", "tip y [m]", "seconds", "status"},
                            {{"P1", "6000", "-0.0142371234", "0.12", "converged"},
                             {"P2-P1", "12345678", "-0.2473", "1234567.89", "converged"},
                             {"P3", "6000", "nan", "1e-07", "not converged: the step\nis small"},
                             {"P1-P1", "6000", "", "99999.4", "failed"}},
                            24)
            << '\n'
            << format_table(
                   {"Poisson ratio", "reason"},
                   {{"0.49990", "größer als überall erlaubt"}, {"0.5", "größer als überall"}},
                   18)
            << '\n'
            << format_table({"only", "header"}, {});
  try
    {
      format_table({"one", "two"}, {{"1"}});
    }
  catch (const std::logic_error &error)
    {
      std::cout << error.what() << '\n';
    }
}
