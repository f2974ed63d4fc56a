#pragma once

// What the block solver needs to know of a body: how it moves without deforming, and the matrix that
// stands for the stiffness which the pressures meet.

#include <isochor/algebra/block_solver.h>
#include <isochor/algebra/symmetric_scaling.h>
#include <isochor/algebra/unknown_subset.h>
#include <isochor/form/equilibrium.h>

namespace isochor
{
  /// BlockData of an equilibrium whose unknowns are partly eliminated before.
  template <int dim>
  class BodyBlockData
  {
  public:
    /// @p retained: owned unknowns that the block solver sees, ascending, nodes whole. S = (1 / mu +
    /// 1 / kappa) int N_p N_q over the reference body. Collective. @p equilibrium must outlive this.
    BodyBlockData(const Equilibrium<dim> &equilibrium, std::vector<LocalIndex> retained);

    /// Stiffness and rigid motions of the body at @p state (ghosts up to date), those zero in prescribed
    /// unknowns, for a matrix scaled by @p scaling. The stiffness is that of small strains on top of
    /// the state, mu eps : eps, without the stress in it: the tangent's own block is indefinite under
    /// pressure and far from equilibrium, where multigrid fails. Collective.
    void update(const Vector &state, const SymmetricScaling &scaling);

    const BlockData &data() const
    {
      return data_;
    }

  private:
    void find_positions();
    void make_stiffness_pattern();
    void make_schur();
    void fill_stiffness(const Vector &state);

    const Equilibrium<dim>         &equilibrium;
    std::vector<LocalIndex>         retained;
    UnknownSubset                   displacements, pressures; ///< of the retained unknowns
    std::vector<dealii::Point<dim>> positions;                ///< at rest, by owned node
    BlockData                       data_;
  };
} // namespace isochor
