#pragma once

// Distortional energies psi_d(F): value, first Piola-Kirchhoff stress, tangent, for eight
// points at a time. Kinematics are always three-dimensional; plane strain has F_33 = 1.

#include <isochor/core/batch.h>
#include <isochor/material/moduli.h>

#include <memory>

namespace isochor
{
  /// Kinematics at eight points; tensors row by row, F[3 i + J] = dx_i / dX_J.
  struct Deformation
  {
    Batch F[9];
    Batch cofactor[9]; ///< dJ/dF = J F^-T
    Batch J;           ///< det F

    /// Fill cofactor and J from F.
    void complete();
  };

  /// psi_d in J/m^3, P = dpsi_d/dF in Pa, and A[9 (3 i + J) + 3 k + L] = dP_iJ / dF_kL in Pa.
  struct Response
  {
    Batch energy;
    Batch P[9];
    Batch A[81]; ///< only filled when the tangent is asked for
  };

  class DistortionalEnergy
  {
  public:
    virtual ~DistortionalEnergy() = default;

    /// J <= 0 in a lane gives NaN in that lane where the energy is not defined there; the
    /// caller decides what to do about it.
    virtual void
    evaluate(const Deformation &deformation, bool with_tangent, Response &response) const = 0;

    /// Is A symmetric, that is, is P the gradient of an energy?
    virtual bool is_symmetric() const
    {
      return true;
    }
  };

  std::unique_ptr<const DistortionalEnergy> make_distortional_energy(Energy energy, double mu);

  /// Volumetric strain Phi(J) and its derivatives Phi'(J), Phi''(J), for eight points.
  struct VolumetricResponse
  {
    Batch phi, d_phi, d2_phi;
  };
  VolumetricResponse evaluate(VolumetricStrain strain, const Batch &J);

  /// Add q Phi'(J) dJ/dF to P and, if @p with_tangent, [q Phi'' + stiffness Phi'^2] dJ/dF x dJ/dF
  /// + q Phi' d2J/dF2 to A. Mixed form: q = p, stiffness = 0. Displacement form: q = kappa Phi,
  /// stiffness = kappa (equation 4).
  void add_volumetric(const Deformation        &deformation,
                      const VolumetricResponse &volumetric,
                      const Batch              &q,
                      double                    stiffness,
                      bool                      with_tangent,
                      Response                 &response);
} // namespace isochor
