#include <isochor/material/deformation_range.h>
#include <isochor/material/lanes.h>
#include <isochor/material/polar.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace isochor
{
  void DeformationRange::include(const Deformation &deformation, const unsigned int n_points)
  {
    Batch C[9];
    right_square(deformation.F, C);
    const auto  polar = polar_decomposition(deformation);
    const auto &R     = polar.R;
    for (unsigned int lane = 0; lane < n_points; ++lane)
      {
        dealii::SymmetricTensor<2, 3> right;
        for (int i = 0; i < 3; ++i)
          for (int j = i; j < 3; ++j)
            right[i][j] = C[3 * i + j][lane];
        if (!std::isfinite(right.norm()))
          {
            smallest_stretch = -std::numeric_limits<double>::infinity();
            continue;
          }
        const double stretch = std::sqrt(std::max(0., dealii::eigenvalues(right)[2]));
        smallest_stretch = std::min(smallest_stretch, std::copysign(stretch, deformation.J[lane]));

        // 2 sin and 2 cos; where there is no nearest rotation, half a turn is as near as any.
        const double sine
            = std::hypot(R[7][lane] - R[5][lane], R[2][lane] - R[6][lane], R[3][lane] - R[1][lane]);
        const double angle = std::atan2(sine, R[0][lane] + R[4][lane] + R[8][lane] - 1.);
        largest_rotation
            = std::max(largest_rotation, std::isnan(angle) ? dealii::numbers::PI : angle);
      }
  }
} // namespace isochor
