#pragma once

// Distortional energies psi_d(F): value, first Piola-Kirchhoff stress, tangent, for eight
// points at a time. Kinematics are always three-dimensional; plane strain has F_33 = 1.

#include <isochor/core/batch.h>
#include <isochor/material/moduli.h>

#include <memory>
#include <string>

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

  struct DeformationRange;

  class DistortionalEnergy
  {
  public:
    virtual ~DistortionalEnergy() = default;

    /// Where the energy is not defined in a lane, most at J <= 0, that lane is NaN; the caller
    /// decides what to do about it.
    virtual void
    evaluate(const Deformation &deformation, bool with_tangent, Response &response) const = 0;

    /// Is A_iJkL = A_kLiJ, which it is if P is the gradient of the energy?
    virtual bool is_symmetric() const
    {
      return true;
    }

    /// Small-strain elasticity: P affine in F, A constant. With the volumetric strain "trace" the
    /// whole problem is linear.
    virtual bool is_linear() const
    {
      return false;
    }

    /// In plain words what to think of this energy in a body that was deformed so much; empty:
    /// nothing to say.
    virtual std::string weakness(const DeformationRange &) const
    {
      return {};
    }
  };

  /// @p moduli.kappa has no part in it.
  std::unique_ptr<const DistortionalEnergy> make_distortional_energy(Energy        energy,
                                                                     const Moduli &moduli);

  /// Volumetric strain Phi(F) at eight points, with
  /// d2Phi/dF2 = d_phi d2J/dF2 + curvature dPhi/dF x dPhi/dF.
  struct VolumetricResponse
  {
    Batch phi;
    Batch gradient[9]; ///< dPhi/dF
    Batch d_phi;       ///< dPhi/dJ; zero for the trace, which does not depend on J
    Batch curvature;   ///< Phi'' / Phi'^2
  };
  VolumetricResponse evaluate(VolumetricStrain strain, const Deformation &deformation);

  /// Add q dPhi/dF to P and, if @p with_tangent, q d2Phi/dF2 + stiffness dPhi/dF x dPhi/dF to A.
  /// Mixed form: q = p, stiffness = 0. Displacement form: q = kappa Phi, stiffness = kappa
  /// (equation 4).
  void add_volumetric(const Deformation        &deformation,
                      const VolumetricResponse &volumetric,
                      const Batch              &q,
                      double                    stiffness,
                      bool                      with_tangent,
                      Response                 &response);
} // namespace isochor
