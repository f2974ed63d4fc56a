#pragma once

// The hyperelastic term, displacement and mixed form in one:
//   displacement:  int psi_d(F) + kappa/2 Phi(J)^2                 (equation 4)
//   mixed:         int psi_d(F) + p Phi(J) - p^2 / (2 kappa)       (equations 9, 17 to 19, 24)
// with the blocks of equation (24): K_d + K_g, G, -C. P1-P1s: C also holds the projection of Bochev,
// Dohrmann and Gunzburger 2006, s / mu int (p - P0 p) (q - P0 q), P0 the mean over a cell.

#include <isochor/form/term.h>
#include <isochor/material/distortional_energy.h>
#include <isochor/space/discretisation.h>

namespace isochor
{
  /// What is done about the compliance matrix C.
  struct ComplianceOptions
  {
    /// Diagonal: int N_p / kappa in the place of int N_p N_q / kappa (equation 37 needs it).
    bool lumped = false;
    /// s above; only stabilised elements look at it.
    double stabilisation = 1.;
  };

  /// What a cell kernel reads; the kernels are compiled for each number of nodes.
  template <int dim>
  struct ElasticityData
  {
    /// C = compliance M (lumped: its row sums) + stabilisation (M - m m^T / V) on a cell, M =
    /// int N_p N_q, m = int N_p.
    struct Compliance
    {
      double compliance    = 0; ///< 1 / kappa, 1/Pa
      bool   lumped        = false;
      double stabilisation = 0; ///< s / mu, 1/Pa
    };

    const Discretisation<dim>                &discretisation;
    std::unique_ptr<const DistortionalEnergy> energy;
    VolumetricStrain                          volumetric_strain;
    Moduli                                    moduli;
    Compliance                                compliance;
  };

  template <int dim>
  class Elasticity : public Term
  {
  public:
    /// @p discretisation must outlive this. Throws std::logic_error for a displacement element
    /// with infinite kappa; that pair is refused before.
    Elasticity(const Discretisation<dim> &discretisation,
               Energy                     energy,
               VolumetricStrain           volumetric_strain,
               const Moduli              &moduli,
               const ComplianceOptions   &compliance = {});
    ~Elasticity() override;

    Evaluation add(const Vector &state, double load, const Target &target) const override;

    /// S* at @p state for a step of @p change, both with ghosts up to date. Not collective.
    std::unique_ptr<PredictedStress> predict_stress(const Vector &state,
                                                    const Vector &change) const;

    /// Small-strain elasticity: the residual is affine in the state.
    bool is_linear() const;

    /// A loop over cells, compiled for one number of displacement and pressure nodes.
    class Kernel;

  private:
    ElasticityData<dim>             data;
    std::unique_ptr<const Kernel>   kernel;
    std::vector<dealii::Point<dim>> points; ///< of the kernel's quadrature
  };
} // namespace isochor
