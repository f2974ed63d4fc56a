#pragma once

// What a material's parameters mean: conversion of Young's modulus and Poisson ratio to the two
// moduli that the equations use, so that a bar stretched a little shows the E and nu that the
// user wrote.

#include <isochor/core/names.h>

namespace isochor
{
  /// Distortional energy psi_d(F); numbers are equations of Francu et al. 2021.
  enum class Energy
  {
    neo_hookean,           ///< (32) mu/2 (I1 - 3) - mu log J
    bonet_wood,            ///< (30) mu/2 (J^(-2/3) I1 - 3)
    mooney,                ///< (29) mu/2 (I1 - 3)
    simplified_bonet_wood, ///< (31) P = mu J^(-2/3) F, the gradient of no energy
    stable_neo_hookean,    ///< Macklin and Mueller 2021 (1, 14): mu/2 (I1 - 3) - mu (J - 1)
    mooney_rivlin,         ///< c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3), mu = 2 (c1 + c2)
    st_venant_kirchhoff,   ///< mu E : E, E = (F^T F - 1) / 2
    corotational,          ///< mu |F - R|^2, R the rotation nearest to F
    linear,                ///< (28) mu (eps : eps - tr(eps)^2 / 3), eps = sym(F) - 1
    linear_as_printed      ///< (28) as printed: mu/2 eps : eps - 2/3 mu tr(eps)^2
  };
  inline constexpr auto energy_names
      = name_table<Energy>({{Energy::neo_hookean, "neo-Hookean"},
                            {Energy::bonet_wood, "Bonet-Wood"},
                            {Energy::mooney, "Mooney"},
                            {Energy::simplified_bonet_wood, "simplified Bonet-Wood"},
                            {Energy::stable_neo_hookean, "stable neo-Hookean"},
                            {Energy::mooney_rivlin, "Mooney-Rivlin"},
                            {Energy::st_venant_kirchhoff, "St. Venant-Kirchhoff"},
                            {Energy::corotational, "corotational"},
                            {Energy::linear, "linear"},
                            {Energy::linear_as_printed, "linear as printed"}});

  /// Volumetric strain Phi, zero where volume is kept (equation 5, sections 4.2 and 6).
  enum class VolumetricStrain
  {
    linear,      ///< J - 1
    logarithmic, ///< log J
    trace        ///< tr(F - 1) = div u, of small strain only
  };
  inline constexpr auto volumetric_strain_names
      = name_table<VolumetricStrain>({{VolumetricStrain::linear, "J - 1"},
                                      {VolumetricStrain::logarithmic, "log J"},
                                      {VolumetricStrain::trace, "trace"}});

  /// The volumetric strain that goes with an energy unless another is asked for: trace for small
  /// strain, J - 1 for the rest.
  VolumetricStrain usual_volumetric_strain(Energy energy);

  /// Which modulus multiplies Phi^2 / 2.
  enum class KappaConvention
  {
    consistent, ///< the one with which a small strain shows E and nu
    lambda,     ///< kappa = E nu / ((1 + nu) (1 - 2 nu)), the second paper's choice with (1, 14)
    bulk        ///< kappa = K = E / (3 (1 - 2 nu)), the first paper's choice with (32)
  };
  inline constexpr auto kappa_convention_names
      = name_table<KappaConvention>({{KappaConvention::consistent, "consistent"},
                                     {KappaConvention::lambda, "lambda"},
                                     {KappaConvention::bulk, "K"}});

  struct MaterialParameters
  {
    double           youngs_modulus      = 1e6;  ///< Pa, > 0
    double           poisson_ratio       = 0.45; ///< in (-1, 0.5]
    Energy           energy              = Energy::neo_hookean;
    VolumetricStrain volumetric_strain   = VolumetricStrain::linear;
    KappaConvention  kappa               = KappaConvention::consistent;
    double           mooney_rivlin_ratio = 0.; ///< c2 / (c1 + c2) in [0, 1], for mooney_rivlin
  };

  struct Moduli
  {
    double mu;                       ///< shear modulus, Pa
    double kappa;                    ///< volumetric stiffness, Pa; infinity at nu = 0.5
    double mooney_rivlin_ratio = 0.; ///< c2 / (c1 + c2) in [0, 1], for mooney_rivlin
    /// 1 / kappa, 1/Pa; exactly 0 at nu = 0.5
    double compliance() const
    {
      return 1. / kappa;
    }
  };

  /// The numbers are in range, which the caller has checked. Throws UserError if "consistent" is
  /// asked of an energy with which no kappa is: (29) and (31) below nu = 0.5, (28) as printed.
  Moduli moduli(const MaterialParameters &material);

  /// What a bar stretched a little shows.
  struct SmallStrain
  {
    double youngs_modulus; ///< Pa
    double poisson_ratio;
  };
  /// NaN where the bar is not at rest before it is stretched: (29) and (31) with finite kappa.
  SmallStrain small_strain(Energy energy, const Moduli &moduli);
} // namespace isochor
