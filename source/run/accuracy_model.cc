#include <isochor/run/accuracy_model.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace isochor
{
  namespace
  {
    /// Of edge lengths: nearer meshes differ by chance, not by refinement.
    constexpr double least_ratio = 1.05;

    /// Exponent of the unknowns in the seconds of a run, between what kept factors and what multigrid
    /// take (convergence/block_preconditioner).
    constexpr double cost_exponent = 1.4;

    /// Of an estimate by recovery: corners of supports, where the stress is singular, hide half of the
    /// error from it.
    constexpr double recovery_safety = 2.;

    double length(const std::vector<double> &x)
    {
      return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.));
    }

    /// Do the values go back where they came from? Then no order is seen in them, and a difference may be
    /// small by chance.
    bool turns(const Trial &coarsest, const Trial &coarse, const Trial &fine)
    {
      double product = 0;
      for (std::size_t k = 0; k < fine.values.size(); ++k)
        product += (fine.values[k] - coarse.values[k]) * (coarse.values[k] - coarsest.values[k]);
      return product < 0;
    }
  } // namespace

  double relative_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    double difference = 0, size = 0;
    for (std::size_t k = 0; k < b.size(); ++k)
      {
        difference += (a[k] - b[k]) * (a[k] - b[k]);
        size += b[k] * b[k];
      }
    if (!(difference > 0))
      return 0;
    return size > 0 ? std::sqrt(difference / size) : std::numeric_limits<double>::infinity();
  }

  double trusted_order(const unsigned int degree)
  {
    return degree == 1 ? 1. : 1.5;
  }

  double hoped_order(const unsigned int degree)
  {
    return degree == 1 ? 1.5 : 2.;
  }

  double edge_ratio(const Trial &coarse, const Trial &fine, const unsigned int dim)
  {
    return std::pow(fine.unknowns / coarse.unknowns, 1. / dim);
  }

  double least_unknowns_of_finer(const double unknowns, const unsigned int dim)
  {
    return unknowns * std::pow(least_ratio, dim);
  }

  std::optional<double> error_by_refinement(const Trial       *coarsest,
                                            const Trial       &coarse,
                                            const Trial       &fine,
                                            const unsigned int dim)
  {
    const double ratio = edge_ratio(coarse, fine, dim);
    if (!(ratio > least_ratio))
      return {};
    double       order  = trusted_order(fine.degree);
    const double change = relative_difference(coarse.values, fine.values);
    const double best   = fine.degree + 1.;
    double       least  = 0; // no smaller than the best order lets the error become
    if (coarsest != nullptr)
      {
        const double before       = relative_difference(coarsest->values, coarse.values);
        const double ratio_before = edge_ratio(*coarsest, coarse, dim);
        if (turns(*coarsest, coarse, fine))
          {
            order             = 1.;
            const double hope = hoped_order(fine.degree);
            least             = before / (std::pow(std::max(ratio_before, least_ratio), hope) - 1.)
                    / std::pow(ratio, hope);
          }
        else if (ratio_before > least_ratio && before > 0)
          {
            // Differences fall as the order says: e(h) = C h^q gives before / change.
            const double seen = std::log(before / std::max(change, 1e-300))
                                / std::log(std::sqrt(ratio_before * ratio));
            order = std::clamp(seen, 1., best);
            least = before / (std::pow(ratio_before, best) - 1.) / std::pow(ratio, best);
          }
      }
    return std::max(change / (std::pow(ratio, order) - 1.), least);
  }

  std::optional<double> error_by_recovery(const std::vector<double> &errors,
                                          const std::vector<double> &values)
  {
    const double error = recovery_safety * length(errors) / length(values);
    return std::isfinite(error) ? std::optional(error) : std::nullopt;
  }

  double growth_of_unknowns(const Trial &coarse, const Trial &fine, const unsigned int dim)
  {
    const double growth
        = std::log(fine.unknowns / coarse.unknowns) / std::log(fine.refinement / coarse.refinement);
    return std::clamp(growth, 1., static_cast<double>(dim));
  }

  double finest_step(const Trial &trial, const double seconds, const double growth)
  {
    return std::pow(seconds / trial.seconds, 1. / (growth * cost_exponent));
  }

  Prediction
  predict(const Trial &trial, const double error, const double accuracy, const double growth)
  {
    const double finer = std::max(1., std::pow(error / accuracy, 1. / hoped_order(trial.degree)));
    Prediction   prediction;
    prediction.refinement = trial.refinement * finer;
    prediction.unknowns   = trial.unknowns * std::pow(finer, growth);
    prediction.error      = std::min(error, accuracy);
    prediction.seconds    = trial.seconds * std::pow(finer, growth * cost_exponent);
    return prediction;
  }
} // namespace isochor
