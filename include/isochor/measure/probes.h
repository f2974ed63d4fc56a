#pragma once

// Probes: the figures a scene asks for, measured on a state.

#include <isochor/measure/error_norms.h>
#include <isochor/space/face_tables.h>

#include <functional>
#include <map>

namespace isochor
{
  struct ProbeColumn
  {
    std::string name; ///< "tip y"
    std::string unit; ///< "m"; empty if it has none
    std::string title() const
    {
      return unit.empty() ? name : name + " [" + unit + "]";
    }
  };

  template <int dim>
  class Probes
  {
  public:
    using BoundaryId = std::function<dealii::types::boundary_id(const std::string &name,
                                                                const std::string &what)>;

    /// Collective. Throws UserError for an unknown boundary, a point outside the body, a cavity
    /// whose boundary is not closed.
    Probes(const Discretisation<dim>            &discretisation,
           const Material                       &material,
           const std::vector<ProbeRequest<dim>> &requests,
           const BoundaryId                     &boundary_id);

    const std::vector<ProbeColumn> &columns() const
    {
      return columns_;
    }

    /// One value per column. @p state with ghosts, at load factor @p load; @p reactions as from
    /// Equilibrium::residual. Collective.
    std::vector<double> measure(const Vector &state, const Vector &reactions, double load) const;

    /// By column of probe @p name, its derivative by the unknowns at @p state (with ghosts); of an
    /// extreme, that of the node where it is. None for volumes, reactions, norms, unknown names.
    /// Collective.
    std::map<std::size_t, Vector> derivatives(const std::string &name, const Vector &state) const;

  private:
    /// A displacement node and what its displacement counts for.
    using Weight = std::pair<LocalIndex, double>;

    struct Probe
    {
      ProbeRequest<dim>                         request;
      std::size_t                               first_column; ///< its own are consecutive
      std::optional<dealii::types::boundary_id> boundary;     ///< none: the whole body
      std::vector<LocalIndex>                   nodes; ///< owned displacement nodes it covers
      /// Of mean and point displacements: in sums over this rank's cells, which add up over ranks.
      std::vector<Weight> weights;
    };

    void                add_columns(const ProbeRequest<dim> &request);
    std::vector<Weight> mean_weights(const Probe &probe) const;
    std::vector<Weight> point_weights(const Probe &probe) const;
    void                check_closed(const Probe &probe) const;

    dealii::Tensor<1, dim> mean(const std::vector<Weight> &weights, const Vector &state) const;
    /// The extreme of column @p column among all nodes and, on the rank that owns it, its node.
    std::pair<double, std::optional<LocalIndex>>
    extreme(const Probe &probe, unsigned int column, const Vector &state) const;

    double       cavity_volume(const Probe &probe, const double *values) const;
    unsigned int n_components(const Probe &probe) const
    {
      return probe.request.component ? 1 : dim;
    }
    std::vector<double> components(const Probe &probe, const dealii::Tensor<1, dim> &vector) const;
    /// d(components) / d(vector)
    dealii::Tensor<1, dim>
    direction(const Probe &probe, unsigned int column, const dealii::Tensor<1, dim> &vector) const;

    const Discretisation<dim> &discretisation;
    FaceTables<dim>            faces;
    ErrorNorms<dim>            error_norms;
    std::vector<Probe>         probes;
    std::vector<ProbeColumn>   columns_;
  };

  /// Volume of the deformed body, m^3 (2D: m^2). Collective.
  template <int dim>
  double deformed_volume(const Discretisation<dim> &discretisation, const Vector &state);

  /// CB = |p - S p|_M / |p - mean p|_M, S the volume-weighted nodal average of cell means, M the
  /// pressure mass matrix: above 0.5 the pressure oscillates and is not to be trusted. None for
  /// displacement elements and for a constant pressure. Collective.
  template <int dim>
  std::optional<double> pressure_oscillation(const Discretisation<dim> &discretisation,
                                             const Vector              &state);
} // namespace isochor
