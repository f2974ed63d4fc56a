#pragma once

// What both direct solvers are asked. Expected: solutions to the accuracy printed; singular
// and broken matrices refused, with the reason.

#include <isochor/algebra/direct_solver.h>

#include "../common/report.h"
#include "saddle_matrix.h"

#include <limits>

namespace isochor::testing
{
  inline void factor_and_solve(DirectSolver      &solver,
                               const std::string &name,
                               const unsigned int n,
                               const Options     &options)
  {
    const Saddle saddle = make_saddle(n, options);
    solver.analyse(saddle.matrix, saddle.node_of_row, saddle.n_nodes);
    const Factorisation factors = solver.factor(saddle.matrix);
    out() << name << ": " << (factors.succeeded ? "factored" : factors.failure);
    if (factors.negative_pivots)
      out() << ", negative pivots minus nodes "
            << double(*factors.negative_pivots) - double(saddle.n_nodes);
    out() << "\n";
    if (!factors.succeeded)
      return;

    for (const unsigned int seed : {1, 2}) // one factorisation, two right-hand sides
      {
        const Vector exact = make_vector(saddle, seed);
        Vector       b = saddle.vector(), x = saddle.vector();
        saddle.matrix.vmult(b, exact);
        const LinearSolve outcome = checked_solve(saddle.matrix, solver, x, b, 1e-10, 60);
        out() << "  converged: " << yes(outcome.succeeded)
              << ", FGMRES was needed: " << (outcome.krylov_iterations > 0 ? "yes" : "no")
              << ", residual " << below(outcome.relative_residual, 1e-10) << ", error "
              << below(difference(x, exact), 1e-7) << "\n";
      }
  }

  inline void all_cases(DirectSolver &solver)
  {
    factor_and_solve(solver, "no compliance", 7, {});
    factor_and_solve(solver, "tiny compliance", 7, {.compliance = 1e-9});
    factor_and_solve(solver, "compliance", 7, {.compliance = .5});
    factor_and_solve(solver, "stiff", 7, {.compliance = 1e-9, .stiffness = 1e6});
    factor_and_solve(solver, "one node", 1, {.compliance = .5});
    factor_and_solve(solver, "unsymmetric", 7, {.skew = .1});
    factor_and_solve(solver, "singular", 5, {.compliance = .5, .supported = false});

    Saddle saddle = make_saddle(3, {.compliance = .5});
    solver.analyse(saddle.matrix, saddle.node_of_row, saddle.n_nodes);

    // A second factorisation of the same pattern, scaled: half the solution.
    Vector b = make_vector(saddle, 3), x = saddle.vector(), half = saddle.vector();
    solver.factor(saddle.matrix);
    solver.solve(x, b);
    for (double &value : saddle.matrix.values())
      value *= 2.;
    solver.factor(saddle.matrix);
    solver.solve(half, b);
    half *= 2.;
    out() << "refactored: " << below(difference(half, x), 1e-12) << "\n";

    b                         = 0.;
    x                         = 1.;
    const LinearSolve trivial = checked_solve(saddle.matrix, solver, x, b, 1e-10, 60);
    out() << "b = 0: converged " << yes(trivial.succeeded) << ", x = 0: " << yes(x.l2_norm() == 0.)
          << "\n";
    b = std::numeric_limits<double>::quiet_NaN();
    out() << "b = NaN: refused "
          << yes(!checked_solve(saddle.matrix, solver, x, b, 1e-10, 60).succeeded) << "\n";

    // Factors of one matrix, solution of another: FGMRES gives up after the iterations allowed.
    const Saddle other = make_saddle(3, {.compliance = .5, .skew = 3.});
    b                  = make_vector(other, 4);
    const auto few     = checked_solve(other.matrix, solver, x, b, 1e-12, 3);
    out() << "another matrix' factors: converged in 3 " << (few.succeeded ? "YES" : "no")
          << ", true residual told " << yes(few.relative_residual > 1e-12) << ", in 500 "
          << yes(checked_solve(other.matrix, solver, x, b, 1e-12, 500).succeeded) << "\n";

    const bool has_first_row = saddle.matrix.partitioner()->in_local_range(0);
    if (has_first_row)
      saddle.matrix.values()[0] = std::numeric_limits<double>::quiet_NaN();
    out() << "NaN: " << solver.factor(saddle.matrix).failure << "\n";
    if (has_first_row)
      saddle.matrix.values()[0] = 1.;
    out() << "and after it: " << yes(solver.factor(saddle.matrix).succeeded) << "\n";
  }
} // namespace isochor::testing
