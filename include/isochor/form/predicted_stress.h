#pragma once

// The stress that Newton's step was made for. A step that turns a piece of the body stretches it by
// half the square of the rotation, a strain that the linearisation did not mean; slender or nearly
// incompressible, the piece answers with a huge stress, and the geometric stiffness of that stress
// spoils the next tangent. So the tangent takes the geometric stiffness of
//   S* = S(x) + dS/dx (x' - x)
// at the new state x' in the place of that of S(x'): the mixed integration points of Magisano,
// Leonetti and Garcea (Int. J. Numer. Meth. Engng 109, 2017) for any energy and with pressures. The
// residual, hence the solution, stays what it is, and where the steps become small so does S* - S.

#include <isochor/form/elasticity.h>

namespace isochor
{
  /// Of eight points, Pa.
  struct Stress
  {
    Batch S[9]; ///< distortional second Piola-Kirchhoff stress, row by row
    Batch q;    ///< what multiplies Phi: p, or kappa Phi in displacement form
  };

  /// A_iJiL += (S* - S)_JL, S the stress of @p response, distortional so far.
  void replace_geometric_stress(const Deformation &deformation,
                                const Stress      &predicted,
                                Response          &response);

  /// A += (q* - q) d2Phi/dF2
  void replace_volumetric_stress(const Deformation        &deformation,
                                 const VolumetricResponse &volumetric,
                                 const Batch              &q,
                                 const Stress             &predicted,
                                 Response                 &response);

  /// S* at the quadrature points of the cells that a rank computes.
  class PredictedStress
  {
  public:
    /// Points per cell.
    explicit PredictedStress(const unsigned int n_points)
      : n_points(n_points)
    {
    }

    /// Eight cells of one point each, the last repeated from @p n_filled on.
    Stress of_cells(std::size_t first, unsigned int n_filled) const;

    /// Batch @p k of the points of a cell, the last point repeated.
    Stress of_points(std::size_t cell, unsigned int k) const;

    /// S + dS/dx @p change at @p state, both with ghosts up to date. @p points: as many as in the
    /// constructor, of the reference cell, those of the kernel.
    template <int dim>
    void predict(const ElasticityData<dim>             &data,
                 const std::vector<dealii::Point<dim>> &points,
                 const Vector                          &state,
                 const Vector                          &change);

  private:
    unsigned int        n_points;
    std::vector<double> values; ///< [(cell * n_points + point) * 10 + k]: S row by row, q
  };
} // namespace isochor
