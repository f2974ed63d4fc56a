#include <isochor/solver/dual_directions.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    constexpr unsigned int depth = 5;
  } // namespace

  void DualDirections::restart()
  {
    differences.clear();
    last           = {};
    last_direction = {};
  }

  DualDirections::Direction
  DualDirections::next(const Vector &gradient, const Vector &steepest, DualIterate &at)
  {
    Direction result{steepest, gradient * steepest};
    if (kind == DualAcceleration::none)
      return result;

    const Point here{at, gradient, steepest};
    const bool  has_last = last.gradient.size() > 0;
    if (kind == DualAcceleration::cg && has_last)
      {
        const double before = last.gradient * last.steepest;
        const double beta
            = std::max(0., (result.slope - gradient * last.steepest) / before); // a NaN gives 0
        result.direction.add(beta, last_direction);
        result.slope = gradient * result.direction;
        if (!(result.slope > 0.))
          result = {steepest, gradient * steepest};
      }
    if (kind == DualAcceleration::anderson && has_last)
      {
        Point difference = here;
        difference.at.state -= last.at.state;
        difference.at.pressure -= last.at.pressure;
        difference.gradient -= last.gradient;
        difference.steepest -= last.steepest;
        differences.push_front(std::move(difference));
        if (differences.size() > depth)
          differences.pop_back();
        Vector mixed_gradient = gradient;
        mix(mixed_gradient, result.direction, at);
        result.slope = mixed_gradient * result.direction;
      }
    last           = here;
    last_direction = result.direction;
    return result;
  }

  void DualDirections::mix(Vector &gradient, Vector &steepest, DualIterate &at) const
  {
    // Normal equations of differences of length 1, with a little on the diagonal for those that
    // have become the same.
    const unsigned int         n = differences.size();
    dealii::FullMatrix<double> gram(n, n);
    std::vector<double>        length(n), rhs(n);
    for (unsigned int i = 0; i < n; ++i)
      length[i] = std::sqrt(differences[i].gradient * differences[i].steepest);
    for (unsigned int i = 0; i < n; ++i)
      {
        if (!(length[i] > 0.))
          return;
        rhs[i] = differences[i].gradient * steepest / length[i];
        for (unsigned int j = 0; j < n; ++j)
          gram(i, j) = differences[i].gradient * differences[j].steepest / (length[i] * length[j]);
        gram(i, i) += 1e-4;
      }
    gram.gauss_jordan();
    for (unsigned int i = 0; i < n; ++i)
      {
        double weight = 0;
        for (unsigned int j = 0; j < n; ++j)
          weight += gram(i, j) * rhs[j];
        weight /= length[i];
        gradient.add(-weight, differences[i].gradient);
        steepest.add(-weight, differences[i].steepest);
        at.state.add(-weight, differences[i].at.state);
        at.pressure.add(-weight, differences[i].at.pressure);
      }
  }
} // namespace isochor
