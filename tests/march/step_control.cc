// Sizes of steps by hand: fixed ones are halved on failure and double again up to 1 / Load steps;
// adaptive ones follow sqrt(target / iterations), at most by a factor of two either way.

#include "../common/report.h"

#include <isochor/march/step_control.h>

using namespace isochor;

int main()
{
  SteppingOptions options;
  options.load_steps   = 4;
  options.minimum_step = 0.03;

  StepControl fixed(options);
  std::cout << "fixed: " << fixed.step();
  fixed.succeeded(50);
  std::cout << ", after a success " << fixed.step();
  bool goes_on = fixed.failed(0.25);
  std::cout << ", after a failure " << fixed.step() << ' ' << testing::yes(goes_on);
  goes_on = fixed.failed(0.125);
  std::cout << ", another " << fixed.step() << ' ' << testing::yes(goes_on);
  fixed.succeeded(1);
  std::cout << ", after successes " << fixed.step();
  fixed.succeeded(1);
  fixed.succeeded(1);
  std::cout << ", " << fixed.step() << '\n';
  std::cout << "half of 0.06 is allowed: " << testing::yes(fixed.failed(0.06))
            << ", half of 0.05 is not: " << testing::yes(!fixed.failed(0.05)) << '\n';

  options.kind              = Stepping::adaptive;
  options.target_iterations = 8;
  StepControl adaptive(options);
  std::cout << "adaptive: " << adaptive.step();
  for (const unsigned int iterations :
       {2u, 1u, 0u, 8u, 18u, 32u, 1000u, 1000u, 1000u, 1000u, 1000u})
    {
      adaptive.succeeded(iterations);
      std::cout << ", after " << iterations << " iterations " << adaptive.step();
    }
  std::cout << '\n';
  adaptive.failed(0.1); // the last step to load factor 1 may be shorter than step()
  std::cout << "adaptive, after a failure: " << adaptive.step() << '\n';
}
