#include <isochor/march/limit_point.h>

#include <cmath>
#include <sstream>

namespace isochor
{
  namespace
  {
    /// |du/dl|^-2 over the displacements; none if the tangent gives no rate, NaN if that is no number.
    template <int dim>
    std::optional<double> inverse_squared_rate(const LoadControl<dim> &control,
                                               const PathPoint        &point)
    {
      Vector rate(point.state.get_partitioner());
      if (!control.find_rate(point.state, point.load, rate).empty())
        return {};
      double squared = 0;
      for (LocalIndex i = 0; i < control.equilibrium.discretisation().n_owned_displacements; ++i)
        squared += std::pow(rate.local_element(i), 2);
      return 1. / dealii::Utilities::MPI::sum(squared, rate.get_mpi_communicator());
    }
  } // namespace

  template <int dim>
  std::optional<double> limit_point_ahead(const LoadControl<dim> &control,
                                          const PathPoint        &before,
                                          const PathPoint        &last,
                                          const double            failed)
  {
    // Of the true tangent, without the filter that a failed step may have left.
    control.tangent_solver.filter_unstable(CurvatureFilter::none, 0);
    const auto there = inverse_squared_rate(control, before);
    const auto here  = inverse_squared_rate(control, last);
    if (!there || !here)
      return {};
    const double distance = *here * (last.load - before.load) / (*there - *here);
    // Written so that NaN is none.
    if (!(distance >= 0. && distance <= 2. * (failed - last.load)))
      return {};
    return last.load + distance;
  }

  std::string describe_limit_point(const double load)
  {
    std::ostringstream why;
    why << "; the displacements grow ever faster towards a limit point near load factor " << load
        << ", beyond which there is no equilibrium close by: Method/Stepping = arc length follows "
           "the path through it";
    return why.str();
  }

  template std::optional<double>
  limit_point_ahead(const LoadControl<2> &, const PathPoint &, const PathPoint &, double);
  template std::optional<double>
  limit_point_ahead(const LoadControl<3> &, const PathPoint &, const PathPoint &, double);
} // namespace isochor
