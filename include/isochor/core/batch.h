#pragma once

// Eight doubles that are computed with as one number. Kernels run eight cells or eight
// quadrature points at a time; the compiler splits a batch to whatever the machine has.
// (Debian's deal.II is built with VectorizedArray of one lane, hence the language extension.)

namespace isochor
{
  inline constexpr unsigned int n_lanes = 8;

  using Batch = double __attribute__((vector_size(n_lanes * sizeof(double))));

  inline Batch batch(const double value)
  {
    return Batch{} + value;
  }

  inline double sum(const Batch &x)
  {
    return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
  }

  /// Lower @p least to @p value; a NaN, old or new, stays.
  inline void lower(double &least, const double value)
  {
    if (value < least || value != value)
      least = value;
  }

  /// Smallest lane; NaN if any lane is.
  inline double min(const Batch &x)
  {
    double least = x[0];
    for (unsigned int lane = 1; lane < n_lanes; ++lane)
      lower(least, x[lane]);
    return least;
  }
} // namespace isochor
