#pragma once

// External loads, all multiplied by the load factor: weight and other body forces, dead traction,
// follower pressure. Their residual is minus the force.

#include <isochor/form/term.h>
#include <isochor/scene/expression.h>
#include <isochor/space/face_tables.h>

namespace isochor
{
  /// A force that does not depend on the displacement: value - f . u.
  class DeadLoad : public Term
  {
  public:
    Evaluation add(const Vector &state, double load, const Target &target) const override;

  protected:
    /// Fill @p force, a zero vector, with the force at @p load in N; owned rows only count.
    virtual void fill(double load, Vector &force) const = 0;

    explicit DeadLoad(Vector force, bool varies)
      : force(std::move(force))
      , varies(varies)
    {
    }

  private:
    mutable Vector force;
    mutable double filled_for = std::numeric_limits<double>::quiet_NaN(); ///< load factor of force
    bool           varies; ///< other than in proportion to the load factor
  };

  /// int rho g . u over the reference body; @p density in kg/m^3, @p gravity in m/s^2.
  template <int dim>
  class BodyForce : public DeadLoad
  {
  public:
    BodyForce(const Discretisation<dim>    &discretisation,
              double                        density,
              const dealii::Tensor<1, dim> &gravity);

  protected:
    void fill(double load, Vector &force) const override;

  private:
    const Discretisation<dim> &discretisation;
    dealii::Tensor<1, dim>     weight; ///< N/m^3
  };

  /// int f . u over the reference body, f by formulas in N/m^3. The quadrature is exact for
  /// formulas that are polynomials of degree k + 1, k that of the displacement: for smooth ones
  /// its error falls faster than that of the element. The formulas are evaluated once per load
  /// factor, or once for all if they do not mention it.
  template <int dim>
  class DistributedForce : public DeadLoad
  {
  public:
    DistributedForce(const Discretisation<dim>   &discretisation,
                     std::vector<Expression<dim>> density);

  protected:
    void fill(double load, Vector &force) const override;

  private:
    const Discretisation<dim>   &discretisation;
    std::vector<Expression<dim>> density;
  };

  /// int t . u over the reference area of a boundary; components in Pa.
  template <int dim>
  class TractionLoad : public DeadLoad
  {
  public:
    TractionLoad(const Discretisation<dim>   &discretisation,
                 dealii::types::boundary_id   boundary,
                 std::vector<Expression<dim>> traction);

  protected:
    void fill(double load, Vector &force) const override;

  private:
    const Discretisation<dim>   &discretisation;
    dealii::types::boundary_id   boundary;
    std::vector<Expression<dim>> traction;
    FaceTables<dim>              tables;
  };

  /// Pressure in Pa on the deformed boundary, against the outward normal. It has a potential only
  /// for closed or suitably held surfaces, so its value is 0; its tangent is exact and in
  /// general unsymmetric.
  template <int dim>
  class FollowerPressure : public Term
  {
  public:
    FollowerPressure(const Discretisation<dim> &discretisation,
                     dealii::types::boundary_id boundary,
                     Expression<dim>            pressure);

    Evaluation add(const Vector &state, double load, const Target &target) const override;

  private:
    void add_tangent(const BoundaryFace                &face,
                     const FaceTable<dim>              &table,
                     const typename FaceTable<dim>::At &at,
                     const FacePoint<dim>              &point,
                     double                             pressure,
                     const Target                      &target) const;

    const Discretisation<dim> &discretisation;
    dealii::types::boundary_id boundary;
    Expression<dim>            pressure;
    FaceTables<dim>            tables;
  };
} // namespace isochor
