#pragma once

// How far a state is from an exact solution given by formulas: norms over the reference body,
// absolute, so that they fall with the order of the element.

#include <isochor/measure/cell_fields.h>

#include <deal.II/base/quadrature.h>

namespace isochor
{
  template <int dim>
  class ErrorNorms
  {
  public:
    /// @p discretisation must outlive this.
    ErrorNorms(const Discretisation<dim> &discretisation, const Material &material);

    /// The norm that a probe asks for, of @p state (with ghosts) against the probe's formulas at
    /// load factor @p load. Collective. Throws UserError where a formula has no finite value.
    double measure(const ProbeRequest<dim> &probe, const Vector &state, double load) const;

    static std::string unit(ProbeKind kind);

    /// (int |u_h - u|^2 dV)^(1/2), m^(1 + dim/2).
    double displacement_l2(const Vector                       &state,
                           const std::vector<Expression<dim>> &exact,
                           double                              load) const;

    /// (int |grad u_h - grad u|^2 dV)^(1/2), m^(dim/2). grad u comes from differences of the
    /// formulas: one formula per component cannot contradict itself, and a gradient mistyped by
    /// the user would look like an element that loses its order. Central differences of
    /// sixth order with a step of 1/64 of the cell's size err by about 1e-13 of grad u, on any mesh
    /// that resolves u; the formulas must make sense that little outside the body.
    double displacement_h1(const Vector                       &state,
                           const std::vector<Expression<dim>> &exact,
                           double                              load) const;

    /// (int (p_h - p)^2 dV)^(1/2), Pa m^(dim/2); @p without_mean: of p_h - p less its mean. p_h is
    /// the pressure unknown of a mixed element, kappa Phi(J) of a displacement element.
    double pressure_l2(const Vector          &state,
                       const Expression<dim> &exact,
                       double                 load,
                       bool                   without_mean) const;

  private:
    /// A quadrature point of an owned cell.
    struct At
    {
      std::size_t        cell;
      unsigned int       q;
      dealii::Point<dim> position; ///< reference, m
      PointMap<dim>      map;
      double             weight; ///< m^dim
    };

    /// @p action(const At &) at every quadrature point of the owned cells; what it throws on one
    /// rank ends all.
    template <typename Action>
    void for_each_point(const Action &action) const;

    double root_of_sum(double squares) const;

    const Discretisation<dim> &discretisation;
    Material                   material;
    dealii::Quadrature<dim>    quadrature;
    GeometryTable<dim>         geometry;
    ShapeTable<dim>            shape;
  };
} // namespace isochor
