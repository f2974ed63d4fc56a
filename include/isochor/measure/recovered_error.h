#pragma once

// The discretisation error of a figure, from one run alone: dual-weighted residuals (Becker and
// Rannacher 2001), in which stress and adjoint are recovered from patches of cells (Zienkiewicz and
// Zhu 1992; both together: Cirak and Ramm 1998).
//
// Of a figure J of the equilibrium (u, p), the adjoint (z, q) solves K (z, q) = dJ / d(u, p), K the
// tangent. With R the residual, P the first Piola-Kirchhoff stress and Phi - p / kappa zero in
// equilibrium,
//   J(u, p) - J(u_h, p_h) = -R(u_h, p_h)(z - z_h, q - q_h) + terms of higher order,
//   R(u_h, p_h)(v, r)     = int (P_h - P) : grad v + int (Phi_h - p_h / kappa) r.
// With P = dpsi_d/dF + p dPhi/dF the pressure's part, int (p_h - p) dPhi/dF : grad (z - z_h), is taken
// by itself: dPhi/dF : grad z = q / kappa is known. For dpsi_d/dF, dPhi/dF, p, grad z and q stand
// polynomials of the element's degree, fitted to their values at the points of a patch of cells where
// these are most accurate.
//
// Of nearly incompressible bodies (convergence/error_estimates) it tells a third to all of the error of
// P2-P1 and P3-P2, less of linear elements, 0.3 to 7 times that of Q2-P1, whose pressure jumps. It knows
// nothing of what straight cells cut off a round body.

#include <isochor/measure/cell_fields.h>

namespace isochor
{
  template <int dim>
  class RecoveredError
  {
  public:
    /// @p discretisation must outlive this.
    RecoveredError(const Discretisation<dim> &discretisation, const Material &material);

    /// J(u) - J(u_h) of each figure, estimated at @p state with its adjoint in @p adjoints; all with
    /// ghosts up to date. None if the body has too few cells. Collective.
    std::optional<std::vector<double>> estimate(const Vector              &state,
                                                const std::vector<Vector> &adjoints) const;

  private:
    const Discretisation<dim> &discretisation;
    CellFields<dim>            fields;
    double                     compliance; ///< 1 / kappa, 1/Pa
  };
} // namespace isochor
