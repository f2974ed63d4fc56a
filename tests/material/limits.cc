// How far energies, and what they are made of, serve. Polar decomposition: F = R V diag(s) V^T of
// known R, at ordinary and at extreme stretches, and at J < 0, where R stays a rotation, to the error
// that polar.h states; NaN where no rotation is nearest. Cube root: cubes of what is known. The range
// of a deformation against the stretches and the angle put in. St. Venant-Kirchhoff's limits, 1 /
// sqrt(3) in one direction and 1 / sqrt(2) in two, against its tangent, which is singular there:
// A_1111 = mu (3 l^2 - 1), A_1212 = mu (l_1^2 + l_2^2 - 1) at F = diag(l_1, l_2, l_3).

#include <isochor/material/deformation_range.h>
#include <isochor/material/energies.h>
#include <isochor/material/lanes.h>
#include <isochor/material/polar.h>

#include "deformations.h"

#include <deal.II/base/numbers.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  /// R V diag V^T
  Deformation turned(const double x, const double y, const double z, const double angle)
  {
    const Matrix V = rotation(0.7), R = rotation(angle);
    Deformation  result = diagonal(x, y, z);
    Batch        left[9], right[9];
    from_left(V, result.F, left);
    from_right(V, left, right);
    // About another axis than V: the entries in another order.
    const Matrix shuffled{{R.entry[4],
                           R.entry[5],
                           R.entry[3],
                           R.entry[7],
                           R.entry[8],
                           R.entry[6],
                           R.entry[1],
                           R.entry[2],
                           R.entry[0]}};
    from_left(shuffled, right, result.F);
    result.complete();
    return result;
  }

  void polar(const double x, const double y, const double z)
  {
    const double digits = std::pow(x + y + z, 3) / (2. * (x + y) * (y + z) * (z + x));
    const double unit   = std::numeric_limits<double>::epsilon() * digits * digits;
    double       error  = 0;
    for (const double angle : {0., 0.3, 1.5, 3.})
      {
        const auto        result = polar_decomposition(turned(x, y, z, angle));
        const Deformation exact  = turned(1., 1., 1., angle);
        for (int k = 0; k < 9; ++k)
          raise_by(error, result.R[k] - exact.F[k]);
        raise_by(error, result.trace - (x + y + z), std::abs(x) + y + z);
      }
    out() << "polar decomposition, stretches " << x << " " << y << " " << z << ": "
          << below(error / unit, 10.) << " units\n";
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  polar(1., 1., 1.);
  polar(1.00001, 1., .99999);
  polar(.5, 1., 2.);
  polar(10., 10., 0.01);
  polar(1e3, 1., 1e-3);
  polar(1e3, 0.0316, 0.0316);
  polar(1e-4, 1e-4, 1e-4);
  polar(0., 1., 2.);
  polar(-.5, 1., 2.);
  polar(-.9, 1., 1.);
  const auto none = polar_decomposition(turned(-1., 1., 1., 0.3));
  out() << "polar decomposition, stretches -1 1 1: NaN " << yes(std::isnan(none.R[4][2])) << "\n";

  double error = 0;
  for (int exponent = -90; exponent <= 90; ++exponent)
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const double root = (1. + 0.11 * lane) * std::pow(10., exponent);
        raise(error, std::abs(isochor::cbrt(batch(root * root * root))[lane] / root - 1.));
      }
  out() << "cube roots: " << below(error, 1e-15) << ", NaN of NaN "
        << yes(std::isnan(isochor::cbrt(batch(std::nan("")))[0])) << "\n";

  DeformationRange range;
  out() << "range at rest: stretch " << range.smallest_stretch << ", rotation "
        << range.largest_rotation << "\n";
  range.include(turned(0.8, 1.1, 1.4, 0.3));
  out() << "range: stretch " << range.smallest_stretch << ", rotation " << range.largest_rotation
        << "\n";
  range.include(turned(-0.5, 1., 2., 3.));
  out() << "range: stretch " << range.smallest_stretch << ", rotation " << range.largest_rotation
        << "\n";
  Deformation broken = diagonal(1., 1., 1.);
  broken.F[3][7]     = std::nan("");
  broken.complete();
  range = {};
  range.include(broken, 7);
  out() << "range without the broken point: stretch " << range.smallest_stretch;
  range.include(broken);
  out() << ", with it: " << range.smallest_stretch << "\n";

  const StVenantKirchhoff st_venant(2.3);
  Response                response;
  const double            one = std::sqrt(1. / 3.), two = std::sqrt(.5);
  st_venant.evaluate(diagonal(one, 1.2, 1.3), true, response);
  out() << "A_1111 at 1/sqrt(3): " << below(std::abs(response.A[0][0]), 1e-15);
  st_venant.evaluate(diagonal(two, two, 2.), true, response);
  out() << ", A_1212 at 1/sqrt(2) twice: " << below(std::abs(response.A[10][0]), 1e-15) << "\n";
  for (const double stretch : {0.72, 0.7})
    {
      DeformationRange now;
      now.include(turned(stretch, 1., 1., 2.));
      out() << "St. Venant-Kirchhoff at " << stretch << ": " << st_venant.weakness(now) << "\n";
    }
  const LinearDeviatoric linear(1., -2. / 3.);
  for (const double degrees : {8., 20.})
    {
      DeformationRange now;
      now.include(turned(1., 1., 1., degrees / 180. * dealii::numbers::PI));
      out() << "linear at " << degrees << " degrees: " << linear.weakness(now) << "\n";
      out() << "neo-Hookean at " << degrees << " degrees: " << NeoHookean(1.).weakness(now) << "\n";
    }
}
