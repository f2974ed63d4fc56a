#pragma once

// The distortional energies by class, for kernels that want to know which one they call.

#include <isochor/material/distortional_energy.h>

namespace isochor
{
  /// (32): psi_d = mu/2 (I1 - 3) - mu log J; no stress at rest.
  class NeoHookean final : public DistortionalEnergy
  {
  public:
    explicit NeoHookean(const double mu)
      : mu(mu)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;

  private:
    double mu;
  };

  /// (30): psi_d = mu/2 (J^(-2/3) I1 - 3); blind to a change of volume.
  class BonetWood final : public DistortionalEnergy
  {
  public:
    explicit BonetWood(const double mu)
      : mu(mu)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;

  private:
    double mu;
  };

  /// (29): psi_d = mu/2 (I1 - 3), for every F; the stress at rest is mu, which the pressure -mu of
  /// an incompressible body balances.
  class Mooney final : public DistortionalEnergy
  {
  public:
    explicit Mooney(const double mu)
      : mu(mu)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;

  private:
    double mu;
  };

  /// (31): P = mu J^(-2/3) F, which is (30) differentiated as if J did not vary. No energy has this
  /// gradient; the value returned is (30). Stress mu at rest, like (29).
  class SimplifiedBonetWood final : public DistortionalEnergy
  {
  public:
    explicit SimplifiedBonetWood(const double mu)
      : mu(mu)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;
    bool is_symmetric() const override
    {
      return false;
    }

  private:
    double mu;
  };

  /// Second paper, (1) and (14): psi_d = mu/2 (I1 - 3) - mu (J - 1), for every F. Up to a constant,
  /// adding kappa/2 (J - 1)^2 gives mu/2 (I1 - 3) + kappa/2 (J - gamma)^2, gamma = 1 + mu / kappa.
  class StableNeoHookean final : public DistortionalEnergy
  {
  public:
    explicit StableNeoHookean(const double mu)
      : mu(mu)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;

  private:
    double mu;
  };

  /// Uncoupled, as in FEBio: psi_d = c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3), mu = 2 (c1 + c2).
  class MooneyRivlin final : public DistortionalEnergy
  {
  public:
    /// @p ratio = c2 / (c1 + c2)
    MooneyRivlin(const double mu, const double ratio)
      : mu_1(mu * (1. - ratio))
      , mu_2(mu * ratio)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;

  private:
    double mu_1, mu_2; ///< 2 c1, 2 c2
  };

  /// psi_d = mu E : E, E = (F^T F - 1) / 2, for every F: at J <= 0, too, and with no resistance to
  /// a reflection.
  class StVenantKirchhoff final : public DistortionalEnergy
  {
  public:
    explicit StVenantKirchhoff(const double mu)
      : mu(mu)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;

    /// Principal stretches may let it soften below 1 / sqrt(2): where two of them have l_i^2 +
    /// l_j^2 < 1, less shear stress goes with more shear, whatever kappa is; where one is below
    /// 1 / sqrt(3), less stress psi_d' goes with more compression (dP/dl = mu (3 l^2 - 1)).
    std::string weakness(const DeformationRange &) const override;

  private:
    double mu;
  };

  /// psi_d = mu |F - R|^2 with R the rotation nearest to F, det R = 1 also where J <= 0: a flipped
  /// cell is driven back. NaN where that rotation is not unique: at J <= 0 alone, where the two
  /// smaller singular values are equal.
  class Corotational final : public DistortionalEnergy
  {
  public:
    explicit Corotational(const double mu)
      : mu(mu)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;

  private:
    double mu;
  };

  /// Small strain: psi_d = shear eps : eps + lambda/2 tr(eps)^2, eps = sym(F) - 1; for every F, and
  /// not objective. (28) has shear = mu, lambda = -2/3 mu; as printed, mu/2 and -4/3 mu.
  class LinearDeviatoric final : public DistortionalEnergy
  {
  public:
    LinearDeviatoric(const double shear, const double lambda)
      : shear(shear)
      , lambda(lambda)
    {
    }
    void evaluate(const Deformation &, bool with_tangent, Response &) const override;
    bool is_linear() const override
    {
      return true;
    }
    /// A rotation by an angle is taken for the strain cos(angle) - 1 in its plane.
    std::string weakness(const DeformationRange &) const override;

  private:
    double shear, lambda;
  };
} // namespace isochor
