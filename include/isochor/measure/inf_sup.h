#pragma once

// The numerical inf-sup test of Chapelle and Bathe (1993) on the mesh and supports of a scene:
// smallest eigenvalues beta^2 of (B A^-1 B^T + S) q = beta^2 M q, with A = int grad u : grad v,
// B = int q dPhi/dF : grad u at a given state, M = int p q, and S = s int (p - P0 p)(q - P0 q)
// for P1-P1s. Eigenvalues of zero belong to spurious pressure modes: pressures that no displacement
// feels.

#include <isochor/form/elasticity.h>
#include <isochor/space/prescribed_displacements.h>

namespace isochor
{
  struct InfSup
  {
    /// beta, the smallest that is not zero; no unit.
    double constant = 0;
    /// Pressures that no displacement feels, the constant one under full Dirichlet conditions aside.
    std::size_t spurious_modes = 0;
    /// Is the body held on its whole boundary, so that a constant pressure does nothing?
    bool has_hydrostatic_mode = false;
  };

  /// beta^2 below this counts as zero.
  inline constexpr double zero_beta_squared = 1e-6;

  /// None for displacement elements and where dPhi/dF does not exist (log J of an inverted cell).
  /// @p state with ghosts. Counts by the inertia of LDL^T factors, beta by ARPACK with shift and
  /// inversion. Throws std::runtime_error if these fail. Collective.
  template <int dim>
  std::optional<InfSup> inf_sup(const Discretisation<dim>          &discretisation,
                                const PrescribedDisplacements<dim> &prescribed,
                                VolumetricStrain                    volumetric_strain,
                                double                              stabilisation,
                                const Vector                       &state);
} // namespace isochor
