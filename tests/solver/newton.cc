// Newton's method on problems small enough to know every iterate by hand. Expected, with the
// default tolerance of 1e-8 unless told:
//  1 x^2 - 2 from 1: |f| = 1, 0.25, 0.0069, 6.0e-6, 4.5e-12: 4 iterations; the error of an
//    iterate over the square of the one before tends to 1 / (2 sqrt 2) = 0.3536 (at the third
//    and second: 2.124e-6 / 2.453e-3^2 = 0.3530). To a target of 0.01: 2 iterations.
//  2 log x from 3: the full step ends at 3 - 3 log 3 = -0.296, outside; half of it at 1.352
//    (one halving), then 0.944, 0.998, 1 - 1.3e-6, 1 - 8e-13: 5 iterations. Outside may be said
//    by `admissible` or by NaN.
//  3 x^2 from 1 converges linearly, |f| = 4^-k: below 1e-8 at k = 14; 10 allowed: 4^-10.
//  4 A linear solver that gives up, at the first and at the third iteration of (1).
//  5 No step is admissible: 8 halvings allowed, 9 tried lengths.
//  6 x by a step in the wrong direction: x = 2, 4, ... 32 are five iterates without a smaller
//    residual; back at 1 the search is strict and nothing reduces it: 6 iterations, 9 halvings.
//  7 (x, 1000 (y - x^2)) from (1, 1): the step (-1, -2) takes the residual from 1 to 1000, the
//    next is exact: 2 iterations, no halving, because a rise is not held against a step at once.
//  8 y = x with x prescribed as 1, from (0, 0): the residual is 0 but the gap is not: 1 iteration.
//    y = 5 x^2 likewise: the step (1, 0) takes the residual from 0 to 5, which is no reason to
//    refuse it while the gap closes; then (0, 5): 2 iterations.
//  9 `accepted` asks to stop after the second iterate.
// 10 A start outside the domain: no iteration.
// 11 atan x from 2: -3.5, 14, -279, 1.2e5, -2.3e10, ever farther out; then, strict, from 2 again
//    with half a step to -0.768, where Newton's method converges: 0.274, -0.0135, 1.6e-6, 0. That
//    is 5 + 1 + 4 = 10 iterations, 1 halving.
// 12 As 6, but the problem has another step, -x: the seventh linear system, and 0 is the solution.
//    One that is refused changes nothing: as 6.
// 13 sin x = 0 as a minimum of -cos x, from 2.5 by the absolute slope, x - sin x / |cos x|, with a
//    patience of 1. To 1.75 the residual rises: back, and strict, no length reduces it (9 halvings),
//    but the full step lowers -cos x. To -3.68 the residual falls; to -4.27 it rises, and again 9
//    halvings; -6.36, -6.283061, -2 pi + 6e-13: 8 iterations. Without an energy, stalled in the second.

#include "../common/report.h"

#include <isochor/solver/newton.h>

#include <vector>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  using Size       = NewtonProblem::Size;
  using Correction = NewtonProblem::Correction;

  const char *const outcome_names[]
      = {"converged", "inverted", "stalled", "iterations", "linear", "interrupted"};

  /// f(x) = 0 for one unknown; keeps all x that were linearised at, and the last.
  struct Scalar
  {
    std::function<double(double)> f, slope;
    double                        tolerance  = 1e-8;
    std::function<bool(double)>   admissible = [](double) { return true; };
    unsigned int                  fails_at   = 1000; ///< iteration in which the solver gives up
    unsigned int                  stops_at   = 1000; ///< iteration after which to interrupt
    std::function<double(double)> energy     = [](double) { return std::nan(""); };
    std::function<double(double)> other_step = {}; ///< at x, the fallback; NaN: refused
    std::vector<double>           iterates   = {};

    NewtonReport run(const double start, const NewtonOptions &options = {})
    {
      Vector x(1);
      x[0] = start;
      iterates.assign(1, start);
      unsigned int  solves = 0;
      NewtonProblem problem;
      problem.residual = [&](const Vector &x, Vector &residual) {
        residual[0] = f(x[0]);
        return Size{std::abs(residual[0]), tolerance, admissible(x[0]), 0., energy(x[0])};
      };
      problem.correction
          = [&](const Vector &x, const Vector &residual, double, Vector &step) -> Correction {
        if (++solves >= fails_at)
          return {false, "the solver gives up"};
        step[0] = -residual[0] / slope(x[0]);
        return {true, "", slope(x[0]) > 0.};
      };
      if (other_step)
        problem.fallback
            = [&](const Vector &x, const Vector &, double, Vector &step) -> Correction {
          step[0] = other_step(x[0]);
          return {!std::isnan(step[0]), ""};
        };
      problem.accepted = [&](const unsigned int iteration, const Size &, double) {
        return iteration >= stops_at;
      };
      // The iterates as the linearisation sees them, and the last.
      const auto correction = problem.correction;
      problem.correction
          = [&](const Vector &x, const Vector &residual, double tolerance, Vector &step) {
              if (x[0] != iterates.back())
                iterates.push_back(x[0]);
              return correction(x, residual, tolerance, step);
            };
      const NewtonReport report = newton(problem, options, x);
      if (x[0] != iterates.back())
        iterates.push_back(x[0]);
      return report;
    }
  };

  void print(const std::string &title, const NewtonReport &report)
  {
    std::cout << title << ": " << outcome_names[static_cast<int>(report.outcome)] << ", "
              << report.iterations << " iterations, " << report.halvings << " halvings"
              << (report.reason.empty() ? "" : ", " + report.reason) << '\n';
  }

  void scalar_problems()
  {
    const auto parabola = [](const double x) { return x * x - 2.; };
    const auto twice    = [](const double x) { return 2. * x; };

    Scalar root{parabola, twice};
    print("1 square root", root.run(1.));
    const auto error
        = [&](const unsigned int k) { return std::abs(root.iterates.at(k) - std::sqrt(2.)); };
    std::cout << "  third error over second squared " << error(3) / error(2) / error(2)
              << ", last error " << below(error(4), 1e-11) << '\n';
    root.tolerance = 0.01;
    print("  to a larger target", root.run(1.));

    Scalar logarithm{[](const double x) { return std::log(std::abs(x)); },
                     [](const double x) { return 1. / x; }};
    logarithm.admissible = [](const double x) { return x > 0.; };
    print("2 logarithm, domain by admissible", logarithm.run(3.));
    std::cout << "  first iterate " << logarithm.iterates.at(1) << ", second "
              << logarithm.iterates.at(2) << ", last error "
              << below(std::abs(logarithm.iterates.back() - 1.), 1e-10) << '\n';
    Scalar with_nan{[](const double x) { return std::log(x); },
                    [](const double x) { return 1. / x; }};
    print("  domain by NaN", with_nan.run(3.));
    print("10 start outside", logarithm.run(-1.));
    print("  start at NaN", with_nan.run(-1.));

    Scalar        double_root{[](const double x) { return x * x; }, twice};
    NewtonOptions options;
    print("3 double root", double_root.run(1.));
    options.max_iterations  = 10;
    const NewtonReport late = double_root.run(1., options);
    print("  10 allowed", late);
    std::cout << "  merit times 4^10 " << late.merit * std::pow(4., 10) << '\n';

    Scalar failing{parabola, twice};
    failing.fails_at = 1;
    print("4 no first solve", failing.run(1.));
    std::cout << "  stays at " << failing.iterates.back() << '\n';
    failing.fails_at = 3;
    print("  no third solve", failing.run(1.));
    std::cout << "  stays at " << failing.iterates.back() << '\n';

    Scalar walled{parabola, twice};
    walled.admissible = [](const double x) { return x == 1.; };
    print("5 walls all around", walled.run(1.));
    std::cout << "  stays at " << walled.iterates.back() << '\n';

    Scalar uphill{[](const double x) { return x; }, [](double) { return -1.; }};
    print("6 uphill", uphill.run(1.));
    std::cout << "  stays at " << uphill.iterates.back() << '\n';

    uphill.other_step = [](const double x) { return -x; };
    print("12 uphill, another step", uphill.run(1.));
    std::cout << "  ends at " << uphill.iterates.back() << '\n';
    uphill.other_step = [](double) { return std::nan(""); };
    print("  refused", uphill.run(1.));

    Scalar pendulum{[](const double x) { return std::sin(x); },
                    [](const double x) { return std::abs(std::cos(x)); }};
    options          = {};
    options.patience = 1;
    print("13 without an energy", pendulum.run(2.5, options));
    pendulum.energy = [](const double x) { return -std::cos(x); };
    print("  with it", pendulum.run(2.5, options));
    std::cout << "  last error "
              << below(std::abs(pendulum.iterates.back() + 2. * std::acos(-1.)), 1e-11) << '\n';

    Scalar outward{[](const double x) { return std::atan(x); },
                   [](const double x) { return 1. / (1. + x * x); }};
    print("11 away and back", outward.run(2.));
    std::cout << "  second iterate after the return " << outward.iterates.at(7) << ", last error "
              << below(std::abs(outward.iterates.back()), 1e-12) << '\n';

    Scalar stopped{parabola, twice};
    stopped.stops_at = 2;
    print("9 interrupted", stopped.run(1.));
    std::cout << "  at " << stopped.iterates.back() << '\n';
  }

  /// Problems in (x, y): residual and Newton step in closed form.
  struct Plane
  {
    using Pair = std::array<double, 2>;
    std::function<Pair(Pair)>       residual;
    std::function<Pair(Pair, Pair)> step; ///< at a point, for a residual
    /// Prescribed values' distance from where they must be.
    std::function<double(Pair)> gap = [](Pair) { return 0.; };

    NewtonReport run(Vector &x) const
    {
      const auto    pair = [](const Vector &v) { return Pair{{v[0], v[1]}}; };
      NewtonProblem problem;
      problem.residual = [&](const Vector &x, Vector &r) {
        const Pair values = residual(pair(x));
        r[0]              = values[0];
        r[1]              = values[1];
        return Size{r.l2_norm(), 1e-8, true, gap(pair(x))};
      };
      problem.correction = [&](const Vector &x, const Vector &r, double, Vector &s) -> Correction {
        const Pair values = step(pair(x), pair(r));
        s[0]              = values[0];
        s[1]              = values[1];
        return {true, ""};
      };
      problem.accepted = [](unsigned int, const Size &, double) { return false; };
      return newton(problem, {}, x);
    }
  };

  void plane_problems()
  {
    Vector x(2);
    x = 1.;
    const Plane valley{[](const Plane::Pair v) {
                         return Plane::Pair{{v[0], 1000. * (v[1] - v[0] * v[0])}};
                       },
                       [](const Plane::Pair v, const Plane::Pair r) {
                         return Plane::Pair{{-r[0], -r[1] / 1000. - 2. * v[0] * r[0]}};
                       }};
    print("7 curved valley", valley.run(x));
    std::cout << "  ends at " << x[0] << ' ' << x[1] << '\n';

    // Component 0 is prescribed: no residual, and the step takes it to 1.
    const auto not_there = [](const Plane::Pair v) { return std::abs(1. - v[0]); };
    x                    = 0.;
    const Plane line{[](const Plane::Pair v) {
                       return Plane::Pair{{0., v[1] - v[0]}};
                     },
                     [](const Plane::Pair v, const Plane::Pair r) {
                       return Plane::Pair{{1. - v[0], 1. - v[0] - r[1]}};
                     },
                     not_there};
    print("8 prescribed, residual 0", line.run(x));
    std::cout << "  ends at " << x[0] << ' ' << x[1] << '\n';
    x = 0.;
    const Plane bent{[](const Plane::Pair v) {
                       return Plane::Pair{{0., v[1] - 5. * v[0] * v[0]}};
                     },
                     [](const Plane::Pair v, const Plane::Pair r) {
                       return Plane::Pair{{1. - v[0], 10. * v[0] * (1. - v[0]) - r[1]}};
                     },
                     not_there};
    print("  prescribed, residual rises", bent.run(x));
    std::cout << "  ends at " << x[0] << ' ' << x[1] << '\n';
  }
} // namespace

int main()
{
  scalar_problems();
  plane_problems();
}
