#pragma once

// Functions of a Batch that the language extension does not have, and of tensors of them.

#include <isochor/core/batch.h>

#include <bit>
#include <cmath>
#include <limits>

namespace isochor
{
  /// NaN in the lanes where @p x is not above zero, so that what is computed from it is NaN too.
  inline Batch positive_or_nan(const Batch &x)
  {
    return x > batch(0.) ? x : batch(std::numeric_limits<double>::quiet_NaN());
  }

  inline Batch log(const Batch &x)
  {
    Batch result;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      result[lane] = std::log(x[lane]);
    return result;
  }

  /// For finite normal x > 0, to one unit in the last place; NaN stays NaN. Eight at once, unlike std::cbrt.
  inline Batch cbrt(const Batch &x)
  {
    // A third of the bits is about the cube root (a third of the exponent), within 4 %; 1/3 = 1/4 +
    // 1/16 + ... Each of Halley's steps takes the error to 2/3 of its cube.
    using Bits = long long __attribute__((vector_size(n_lanes * sizeof(long long))));
    Bits bits  = std::bit_cast<Bits>(x);
    bits       = (bits >> 2) + (bits >> 4);
    bits += bits >> 4;
    bits += bits >> 8;
    bits += bits >> 16;
    bits += 0x2A9F7893782DA1CELL;
    Batch root = std::bit_cast<Batch>(bits);
    for (int step = 0; step < 3; ++step)
      {
        const Batch cube = root * root * root;
        root += root * ((x - cube) / (2. * cube + x));
      }
    return root;
  }

  inline Batch sqrt(const Batch &x)
  {
    Batch result{};
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      result[lane] = std::sqrt(x[lane]);
    return result;
  }

  /// A : B of two tensors with nine entries.
  inline Batch contract(const Batch (&A)[9], const Batch (&B)[9])
  {
    Batch sum = A[0] * B[0];
    for (int k = 1; k < 9; ++k)
      sum += A[k] * B[k];
    return sum;
  }

  /// A B; tensors row by row.
  inline void multiply(const Batch (&A)[9], const Batch (&B)[9], Batch (&product)[9])
  {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        product[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  }

  /// A^T A, symmetric to the last digit.
  inline void right_square(const Batch (&A)[9], Batch (&square)[9])
  {
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        square[3 * i + j] = square[3 * j + i]
            = A[i] * A[j] + A[3 + i] * A[3 + j] + A[6 + i] * A[6 + j];
  }

  /// A A^T, symmetric to the last digit.
  inline void left_square(const Batch (&A)[9], Batch (&square)[9])
  {
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        square[3 * i + j] = square[3 * j + i]
            = A[3 * i] * A[3 * j] + A[3 * i + 1] * A[3 * j + 1] + A[3 * i + 2] * A[3 * j + 2];
  }

  /// A_iJkL = entry(i, J, k, L) for all 81, unrolled: comparisons of indices cost nothing.
  template <typename Entry>
  inline void fill_tangent(const Entry &entry, Batch (&A)[81])
  {
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
      for (int J = 0; J < 3; ++J)
#pragma GCC unroll 3
        for (int k = 0; k < 3; ++k)
#pragma GCC unroll 3
          for (int L = 0; L < 3; ++L)
            A[9 * (3 * i + J) + 3 * k + L] = entry(i, J, k, L);
  }

  /// A += factor d2J/dF2, with d2J / dF_iJ dF_kL = eps_ikm eps_JLM F_mM, which holds at J = 0, too.
  inline void add_second_derivative_of_J(const Batch &factor, const Batch (&F)[9], Batch (&A)[81])
  {
    // For each (m, M) four entries; (i, k, m) and (J, L, M) are cyclic.
#pragma GCC unroll 3
    for (int m = 0; m < 3; ++m)
#pragma GCC unroll 3
      for (int M = 0; M < 3; ++M)
        {
          const Batch term = factor * F[3 * m + M];
          const int   i = (m + 1) % 3, k = (m + 2) % 3, J = (M + 1) % 3, L = (M + 2) % 3;
          A[9 * (3 * i + J) + 3 * k + L] += term;
          A[9 * (3 * k + L) + 3 * i + J] += term;
          A[9 * (3 * i + L) + 3 * k + J] -= term;
          A[9 * (3 * k + J) + 3 * i + L] -= term;
        }
  }
} // namespace isochor
