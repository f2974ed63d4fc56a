#pragma once

// Derivatives of terms by differences, along directions of all unknowns at once.

#include <isochor/form/term.h>
#include <isochor/space/matrix_pattern.h>

#include <deal.II/base/mpi.h>

#include <random>

namespace isochor::testing
{
  /// Entries in [-1, 1], the same field for any number of ranks is not needed.
  inline Vector random_vector(const Vector &layout, const unsigned int seed)
  {
    std::mt19937 random(seed + 1000 * dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
    std::uniform_real_distribution<double> entry(-1., 1.);
    Vector                                 vector(layout.get_partitioner());
    for (LocalIndex i = 0; i < vector.locally_owned_size(); ++i)
      vector.local_element(i) = entry(random);
    vector.update_ghost_values();
    return vector;
  }

  inline double value(const Term &term, const Vector &state, const double load)
  {
    return dealii::Utilities::MPI::sum(term.add(state, load, {}).value, MPI_COMM_WORLD);
  }

  inline Vector residual(const Term &term, const Vector &state, const double load)
  {
    Vector residual(state.get_partitioner());
    term.add(state, load, {&residual, nullptr, nullptr});
    residual.zero_out_ghost_values();
    return residual;
  }

  /// State moved by @p length along @p direction, with ghosts.
  inline Vector moved(const Vector &state, const double length, const Vector &direction)
  {
    Vector vector(state);
    vector.add(length, direction);
    vector.update_ghost_values();
    return vector;
  }

  struct DerivativeErrors
  {
    double residual  = 0; ///< against differences of the value, relative
    double tangent   = 0; ///< against differences of the residual, relative
    double asymmetry = 0; ///< of the tangent, relative
  };

  /// Central differences of fourth order with step @p h, in three random directions of size 1.
  inline DerivativeErrors derivative_errors(const Term        &term,
                                            const Vector      &state,
                                            const double       load,
                                            const double       h,
                                            SparseMatrix       matrix,
                                            const CellOffsets &offsets)
  {
    std::fill(matrix.values().begin(), matrix.values().end(), 0.);
    term.add(state, load, {nullptr, &matrix, &offsets});
    const Vector     at = residual(term, state, load);
    DerivativeErrors errors;
    Vector           products[3];
    for (unsigned int sample = 0; sample < 3; ++sample)
      {
        const Vector direction = random_vector(state, 100 + sample);
        const auto   f
            = [&](const double k) { return value(term, moved(state, k * h, direction), load); };
        const double slope = (8. * (f(1) - f(-1)) - (f(2) - f(-2))) / (12. * h);
        errors.residual    = std::max(errors.residual,
                                   std::abs(slope - at * direction)
                                       / (at.l2_norm() * direction.l2_norm() + 1e-300));

        const auto r
            = [&](const double k) { return residual(term, moved(state, k * h, direction), load); };
        Vector difference = r(1);
        difference -= r(-1);
        difference *= 8.;
        difference -= r(2);
        difference += r(-2);
        difference *= 1. / (12. * h);
        products[sample].reinit(state);
        matrix.vmult(products[sample], direction);
        difference -= products[sample];
        errors.tangent
            = std::max(errors.tangent, difference.l2_norm() / products[sample].l2_norm());
      }
    for (unsigned int sample = 0; sample < 2; ++sample)
      {
        const Vector x = random_vector(state, 100 + sample), y = random_vector(state, 101 + sample);
        errors.asymmetry = std::max(errors.asymmetry,
                                    std::abs(products[sample] * y - products[sample + 1] * x)
                                        / (products[sample].l2_norm() * y.l2_norm()));
      }
    return errors;
  }
} // namespace isochor::testing
