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
} // namespace isochor
