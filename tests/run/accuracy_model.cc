// Runs whose values are 1 + C h^q: extrapolation finds the error C h^q that they have.

#include "../common/report.h"

#include <isochor/run/accuracy_model.h>

using namespace isochor;

namespace
{
  constexpr unsigned int dim = 3;

  /// A run of an element of @p degree with error @p C h^@p q at edge length h = 1 / refinement.
  Trial trial(const unsigned int degree, const double refinement, const double C, const double q)
  {
    Trial trial;
    trial.degree     = degree;
    trial.refinement = refinement;
    trial.unknowns   = 1000. * std::pow(refinement, dim);
    trial.seconds    = 0.1 * std::pow(refinement, 1.4 * dim);
    trial.values     = {1. + C * std::pow(1. / refinement, q)};
    return trial;
  }

  double error(const Trial &trial)
  {
    return std::abs(trial.values[0] - 1.);
  }
} // namespace

int main()
{
  for (const unsigned int degree : {1u, 2u, 3u})
    for (const double q : {1., 1.5, 2., 3.})
      {
        const Trial a = trial(degree, 1, 1e-4, q), b = trial(degree, 1.5, 1e-4, q),
                    c         = trial(degree, 2.25, 1e-4, q);
        const double by_two   = *error_by_refinement(nullptr, b, c, dim) / error(c);
        const double by_three = *error_by_refinement(&a, b, c, dim) / error(c);
        std::cout << "degree " << degree << ", order " << q
                  << ": estimated by true error, from two " << by_two << ", from three " << by_three
                  << '\n';
      }

  // Equal values of two runs are luck if a coarser one was far away.
  Trial lucky       = trial(2, 2.25, 0, 1);
  lucky.values      = trial(2, 1.5, 1e-2, 2).values;
  const Trial first = trial(2, 1, 1e-2, 2), second = trial(2, 1.5, 1e-2, 2);
  std::cout << "lucky: from two " << *error_by_refinement(nullptr, second, lucky, dim)
            << ", from three more than a hundredth of a per cent: "
            << testing::yes(*error_by_refinement(&first, second, lucky, dim) > 1e-4) << '\n';
  // To and fro: the last difference by first order, 1.01, 0.99, 0.995, ...
  Trial there = trial(2, 1, 0, 1), back = trial(2, 1.5, 0, 1), again = trial(2, 2.25, 0, 1);
  there.values = {1.01}, back.values = {0.99}, again.values = {0.995};
  std::cout << "to and fro: " << *error_by_refinement(&there, back, again, dim)
            << ", 0.5 % / 0.995 / (1.5 - 1) = " << 0.005 / 0.995 / 0.5 << '\n';
  // ... or the one before by second, from the middle mesh to the finest, if that is more.
  again.values = {0.991};
  std::cout << "to and hardly fro: " << *error_by_refinement(&there, back, again, dim)
            << ", 2 % / 0.99 / (1.5^2 - 1) / 1.5^2 = " << 0.02 / 0.99 / 1.25 / 2.25 << '\n';
  std::cout << "a mesh no finer tells nothing: "
            << testing::yes(
                   !error_by_refinement(nullptr, trial(2, 1, 1, 1), trial(2, 1.01, 1, 1), dim))
            << '\n';

  std::cout << "1000 unknowns, 5 % finer: " << least_unknowns_of_finer(1000, dim) << '\n';

  // An error of 4 %, 1 % wanted: half the edge length by second order, a quarter for more.
  const Trial      now  = trial(2, 1, 0.04, 2);
  const Prediction half = predict(now, error(now), 0.01, dim);
  std::cout << "4 % to 1 %: refinement " << half.refinement << ", unknowns " << half.unknowns
            << ", seconds " << half.seconds / now.seconds
            << " times as many (8^1.4 = " << std::pow(8., 1.4) << ")\n";
  const Prediction none = predict(now, error(now), 0.05, dim);
  std::cout << "4 % to 5 %: refinement " << none.refinement << ", error " << none.error << '\n';
  std::cout << "within as many seconds: " << finest_step(now, half.seconds, dim)
            << " times finer\n";
  std::cout << "growth of unknowns: " << growth_of_unknowns(now, trial(2, 3, 0.04, 2), dim) << '\n';
  std::cout << "difference of (3, 4) and (0, 0): " << relative_difference({3, 4}, {0, 0})
            << ", of (3, 4) and (3, 3.5): " << relative_difference({3, 3.5}, {3, 4}) << '\n';
  std::cout << "own estimates (3, -4) of (100, 0), twice: " << *error_by_recovery({3, -4}, {100, 0})
            << ", not known: "
            << testing::yes(!error_by_recovery({3, std::nan("")}, {100, 0})
                            && !error_by_recovery({1}, {0}))
            << '\n';
}
