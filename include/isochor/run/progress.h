#pragma once

// What a person at a terminal sees while a run goes on.

#include <isochor/march/quasi_static.h>
#include <isochor/run/run.h>

#include <string>

namespace isochor
{
  bool is_terminal();

  /// Mesh, unknowns, quality: before the first step.
  void print_summary(const RunResult &result, const std::string &element);
  void print_step_header();
  void print_step(const LoadStep &step);
  void print_failed_step(double load, const NewtonReport &report, double next_step);

  /// "[=====>    ] 12/24  Method/Element=P3": rewritten in place.
  void print_bar(unsigned int done, unsigned int of, const std::string &now);
} // namespace isochor
