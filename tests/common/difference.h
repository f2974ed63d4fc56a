#pragma once

// Derivatives of terms by differences, along directions of all unknowns at once.

#include "report.h"

#include <isochor/form/term.h>
#include <isochor/space/matrix_pattern.h>

#include <deal.II/base/mpi.h>

#include <random>
#include <vector>

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
    double residual  = 0; ///< against differences of the value
    double tangent   = 0; ///< against differences of the residual
    double asymmetry = 0; ///< of the tangent
  };

  /// Central differences of fourth order with step @p h along random directions, displacements and
  /// pressures apart, and each block of the tangent against its own size: the compliance is
  /// thousands of times smaller than the stiffness and must not hide behind it.
  inline DerivativeErrors derivative_errors(const Term        &term,
                                            const Vector      &state,
                                            const double       load,
                                            const double       h,
                                            SparseMatrix       matrix,
                                            const CellOffsets &offsets,
                                            const LocalIndex   n_owned_displacements,
                                            const bool         has_pressures)
  {
    const unsigned int n_parts = has_pressures ? 2 : 1;
    // Displacement (0) or pressure (1) entries alone.
    const auto part = [&](const Vector &vector, const unsigned int which) {
      Vector only(vector.get_partitioner());
      for (LocalIndex i = 0; i < vector.locally_owned_size(); ++i)
        if ((i < n_owned_displacements) == (which == 0))
          only.local_element(i) = vector.local_element(i);
      only.update_ghost_values();
      return only;
    };
    const auto relative = [](const double error, const double size) {
      return std::abs(error) / (size + 1e-300); // 0 / 0 is no error
    };

    std::fill(matrix.values().begin(), matrix.values().end(), 0.);
    term.add(state, load, {nullptr, &matrix, &offsets});
    const Vector        at = residual(term, state, load);
    DerivativeErrors    errors;
    std::vector<Vector> directions, products;
    for (unsigned int sample = 0; sample < 2 * n_parts; ++sample)
      {
        directions.push_back(part(random_vector(state, 100 + sample), sample % n_parts));
        const Vector &direction = directions.back();

        const auto f
            = [&](const double k) { return value(term, moved(state, k * h, direction), load); };
        const double slope = (8. * (f(1) - f(-1)) - (f(2) - f(-2))) / (12. * h);
        raise(errors.residual,
              relative(slope - at * direction,
                       part(at, sample % n_parts).l2_norm() * direction.l2_norm()));

        const auto r
            = [&](const double k) { return residual(term, moved(state, k * h, direction), load); };
        Vector difference = r(1);
        difference -= r(-1);
        difference *= 8.;
        difference -= r(2);
        difference += r(-2);
        difference *= 1. / (12. * h);
        Vector product(state.get_partitioner());
        matrix.vmult(product, direction);
        difference -= product;
        for (unsigned int rows = 0; rows < n_parts; ++rows)
          raise(errors.tangent,
                relative(part(difference, rows).l2_norm(), part(product, rows).l2_norm()));
        products.push_back(product);
      }
    for (unsigned int i = 0; i < directions.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        raise(errors.asymmetry,
              relative(directions[i] * products[j] - directions[j] * products[i],
                       directions[i].l2_norm() * part(products[j], i % n_parts).l2_norm()));
    return errors;
  }
} // namespace isochor::testing
