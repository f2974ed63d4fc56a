#pragma once

// What a few cheap runs of a scene tell of its discretisation error: how large it is, and what an
// element costs at a smaller one. Numbers only; run/automatic.h makes the runs.

#include <optional>
#include <string>
#include <vector>

namespace isochor
{
  /// One run, as the model sees it.
  struct Trial
  {
    std::string         element;
    unsigned int        degree     = 1; ///< of the displacement
    double              refinement = 1; ///< edge length of the scene's mesh / that of this one
    double              unknowns   = 0;
    double              seconds    = 0;
    std::vector<double> values; ///< of the probe that must be accurate
  };

  /// |a - b| / |b| in the Euclidean norm; 0 if both are zero.
  double relative_difference(const std::vector<double> &a, const std::vector<double> &b);

  /// Order in the edge length that is counted on, whatever theory promises: the corners of supports,
  /// where the pressure is singular near nu = 0.5, and faceted curved surfaces bound it.
  double trusted_order(unsigned int degree);

  /// Order that a prediction counts on. More than trusted_order(): a step too short is followed by
  /// another, what a step too long has cost is gone.
  double hoped_order(unsigned int degree);

  /// Factor between the edge lengths of two runs with one element, from their unknowns: what was
  /// asked for is not what a coarse mesh of few blocks, or of walls one cell thick, becomes.
  double edge_ratio(const Trial &coarse, const Trial &fine, unsigned int dim);

  /// How many unknowns a mesh must have to tell more than one with @p unknowns: nearer ones differ by
  /// chance, not by refinement.
  double least_unknowns_of_finer(double unknowns, unsigned int dim);

  /// Relative error of @p fine by Richardson's extrapolation from @p coarse: with trusted_order(), or
  /// with the order that the three runs show, between 1 and the degree + 1, if there is a @p coarsest.
  /// Where the three go to and fro, their orders are those one may not hope to exceed: first order for
  /// the last difference, which may be small by chance, and hoped_order() for the one before. None if
  /// the finer mesh is hardly finer.
  std::optional<double> error_by_refinement(const Trial *coarsest,
                                            const Trial &coarse,
                                            const Trial &fine,
                                            unsigned int dim);

  /// Relative error of a run whose own estimates of its errors are @p errors, times what such estimates
  /// have been short by (convergence/error_estimates). None if one of them is not known (NaN), or all
  /// values are zero.
  std::optional<double> error_by_recovery(const std::vector<double> &errors,
                                          const std::vector<double> &values);

  /// A run that could be made.
  struct Prediction
  {
    double refinement = 1;
    double unknowns   = 0;
    double error      = 0; ///< relative
    double seconds    = 0;
  };

  /// How much finer a mesh may be than that of @p trial if its run may take @p seconds, as predict()
  /// foresees them.
  double finest_step(const Trial &trial, double seconds, double growth);

  /// The coarsest mesh on which the element of @p trial, whose error is @p error, is expected to err
  /// by @p accuracy, with hoped_order(). Seconds grow with unknowns to the power of 1.4. @p growth:
  /// exponent of the unknowns in the refinement.
  Prediction predict(const Trial &trial, double error, double accuracy, double growth);

  /// Exponent of the unknowns in the refinement between two runs, between 1 and @p dim.
  double growth_of_unknowns(const Trial &coarse, const Trial &fine, unsigned int dim);
} // namespace isochor
