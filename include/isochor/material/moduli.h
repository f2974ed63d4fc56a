#pragma once

// What Young's modulus and Poisson ratio mean: conversion to the two moduli that the
// equations use, so that a bar stretched a little shows the E and nu that the user wrote.

#include <isochor/core/names.h>

namespace isochor
{
  /// Distortional energy psi_d(F); numbers are equations of Francu et al. 2021.
  enum class Energy
  {
    neo_hookean, ///< (32) mu/2 (I1 - 3) - mu log J
    bonet_wood   ///< (30) mu/2 (J^(-2/3) I1 - 3)
  };
  inline constexpr auto energy_names = name_table<Energy>(
      { { Energy::neo_hookean, "neo-Hookean" }, { Energy::bonet_wood, "Bonet-Wood" } });

  /// Volumetric strain Phi(J), zero where volume is kept (equation 5 and section 6).
  enum class VolumetricStrain
  {
    linear,     ///< J - 1
    logarithmic ///< log J
  };
  inline constexpr auto volumetric_strain_names = name_table<VolumetricStrain>(
      { { VolumetricStrain::linear, "J - 1" }, { VolumetricStrain::logarithmic, "log J" } });

  /// Which modulus multiplies Phi^2 / 2.
  enum class KappaConvention
  {
    consistent, ///< the one with which a small strain shows E and nu: lambda for (32), K for (30)
    lambda,     ///< kappa = E nu / ((1 + nu) (1 - 2 nu))
    bulk        ///< kappa = K = E / (3 (1 - 2 nu)), the first paper's choice with (32)
  };
  inline constexpr auto kappa_convention_names
      = name_table<KappaConvention>({ { KappaConvention::consistent, "consistent" },
                                      { KappaConvention::lambda, "lambda" },
                                      { KappaConvention::bulk, "K" } });

  struct Moduli
  {
    double mu;    ///< shear modulus, Pa
    double kappa; ///< volumetric stiffness, Pa; infinity at nu = 0.5
    /// 1 / kappa, 1/Pa; exactly 0 at nu = 0.5
    double compliance() const
    {
      return 1. / kappa;
    }
  };

  /// @p youngs_modulus in Pa, > 0; @p poisson_ratio in (-1, 0.5], both checked by the caller.
  Moduli
  moduli(double youngs_modulus, double poisson_ratio, Energy energy, KappaConvention convention);
} // namespace isochor
