#pragma once

// The discrete equilibrium of a scene: all terms of the Lagrangian together, and norms of its
// residual that mean the same in millimetres and in metres.

#include <isochor/form/elasticity.h>
#include <isochor/scene/scene.h>
#include <isochor/space/matrix_pattern.h>
#include <isochor/space/prescribed_displacements.h>

namespace isochor
{
  /// Sizes of the residual, free of units; NaN where it cannot be evaluated.
  struct ResidualSize
  {
    /// |unbalanced forces| / |forces that act|, the latter being the larger of external loads and
    /// reactions at the supports.
    double force = 0;
    /// |int N_p (Phi - p / kappa)| / |int N_p|: a volumetric strain; 0 without pressures.
    double constraint = 0;
    /// The part of `force` that rounding alone can produce: no iteration gets below.
    double rounding = 0;
    /// Smallest J over all quadrature points: not positive means an inverted cell.
    double min_jacobian = 0;
    /// Lagrangian, J.
    double value = 0;
  };

  template <int dim>
  class Equilibrium
  {
  public:
    using BoundaryId = typename PrescribedDisplacements<dim>::BoundaryId;

    /// Collective. @p discretisation must outlive this.
    Equilibrium(const Discretisation<dim> &discretisation,
                const Scene<dim>          &scene,
                const BoundaryId          &boundary_id,
                const ComplianceOptions   &compliance = {});

    /// residual = dL/d(u, p) at @p state (ghosts are updated) and load factor @p load, with
    /// zeros at the prescribed unknowns; their share, the reactions, goes to @p reactions if
    /// given. Collective.
    ResidualSize
    residual(const Vector &state, double load, Vector &residual, Vector *reactions = nullptr) const;

    /// Tangent before supports are applied. Not collective.
    void tangent(const Vector          &state,
                 double                 load,
                 SparseMatrix          &matrix,
                 const PredictedStress *stress = nullptr,
                 CurvatureFilter        filter = CurvatureFilter::none) const;

    /// product = tangent * direction without a matrix, cell by cell (force differentials); ghosts of
    /// both arguments are updated. Collective.
    void tangent_product(const Vector &state,
                         double        load,
                         const Vector &direction,
                         Vector       &product) const;

    /// For tangent() at @p state + @p change; see predicted_stress.h. Ghosts are updated. Collective.
    std::unique_ptr<PredictedStress> predict_stress(const Vector &state,
                                                    const Vector &change) const;

    const PrescribedDisplacements<dim> &prescribed() const
    {
      return prescribed_;
    }
    /// Is the residual affine in the state? Then the sign of J means nothing.
    bool is_linear() const
    {
      return is_linear_;
    }
    /// Is a stable equilibrium a minimum of ResidualSize::value? Not with pressures as unknowns, which
    /// make it a saddle, nor without a potential.
    bool is_minimum() const
    {
      return is_minimum_;
    }
    const Moduli &moduli() const
    {
      return moduli_;
    }
    /// Is kappa finite, and the compliance matrix not zero?
    bool is_compressible() const
    {
      return moduli_.compliance() > 0.;
    }
    const Discretisation<dim> &discretisation() const
    {
      return discretisation_;
    }
    /// Mean over the components of each displacement node of the tangent's diagonal at rest, and of
    /// each pressure int N_p N_p (1/mu + 1/kappa), which its Schur complement is close to.
    const Vector &diagonal() const
    {
      return diagonal_;
    }
    /// A zero matrix of the tangent's pattern. All come from the same pattern.
    SparseMatrix make_matrix() const
    {
      return pattern;
    }

  private:
    const Discretisation<dim>         &discretisation_;
    PrescribedDisplacements<dim>       prescribed_;
    SparseMatrix                       pattern;
    CellOffsets                        offsets;
    std::unique_ptr<Elasticity<dim>>   internal;
    std::vector<std::unique_ptr<Term>> loads;
    Moduli                             moduli_{};
    bool                               is_linear_      = false;
    bool                               is_minimum_     = false;
    double                             volume_scale    = 0; ///< |int N_p|
    double                             stiffness_scale = 0; ///< |diagonal of the tangent at rest|
    Vector                             diagonal_;
  };
} // namespace isochor
