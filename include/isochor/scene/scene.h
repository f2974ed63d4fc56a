#pragma once

// What is simulated: mesh, material, supports, loads, probes. A scene knows no element and no
// solver. Boundaries are names here; the mesh turns them into numbers.

#include <isochor/material/moduli.h>
#include <isochor/mesh/mesh_request.h>
#include <isochor/scene/expression.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <filesystem>
#include <functional>
#include <optional>

namespace isochor
{
  struct Material : MaterialParameters
  {
    double density = 1000; ///< kg/m^3, reference
  };

  /// Prescribes displacement components on a boundary.
  template <int dim>
  struct Support
  {
    std::string           boundary;
    std::string           origin;       ///< the parameter and entry it came from, for messages
    std::array<bool, dim> components{}; ///< which are prescribed
    /// Displacement in metres at a reference position for a load factor; only the prescribed
    /// components count.
    std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &, double)> displacement;
    /// Does it change with the load factor?
    bool moves = false;
  };

  /// Dead traction in Pa of reference area, multiplied by the load factor.
  template <int dim>
  struct Traction
  {
    std::string                  boundary;
    std::vector<Expression<dim>> components;
    std::string                  origin = {}; ///< the parameter and entry, for messages
  };

  /// Follower pressure in Pa of deformed area, multiplied by the load factor; positive pushes
  /// against the body.
  template <int dim>
  struct Pressure
  {
    std::string     boundary;
    Expression<dim> value;
    std::string     origin = {}; ///< the parameter and entry, for messages
  };

  enum class ProbeKind
  {
    mean_displacement,
    point_displacement,
    min_displacement,
    max_displacement,
    volume,
    cavity_volume,
    reaction,
    displacement_l2_error,
    displacement_h1_error,
    pressure_l2_error
  };

  /// A figure that is measured in every run and compared between runs.
  template <int dim>
  struct ProbeRequest
  {
    std::string                       name;
    ProbeKind                         kind     = ProbeKind::volume;
    std::string                       boundary = {}; ///< empty: the whole body
    std::optional<dealii::Point<dim>> point    = {}; ///< reference position, for point_displacement
    /// 0..dim-1: that component; dim: the magnitude; none: all components, one column each.
    std::optional<unsigned int> component = {};
    std::string                 origin    = {}; ///< the parameter and entry, for messages
    /// Errors: the exact field, dim formulas of a displacement (m) or one of a pressure (Pa).
    std::vector<Expression<dim>> exact = {};
    /// pressure_l2_error: both pressures count less their mean over the body.
    bool without_mean = false;
  };

  template <int dim>
  struct Scene
  {
    MeshRequest               mesh;
    Material                  material;
    std::vector<Support<dim>> supports;
    dealii::Tensor<1, dim>    gravity; ///< m/s^2, multiplied by the load factor
    /// N/m^3 of reference volume, multiplied by the load factor: dim formulas, or none.
    std::vector<Expression<dim>> body_force;
    /// m, where Newton's method begins: dim formulas, or none for a body at rest.
    std::vector<Expression<dim>>   initial_displacement;
    std::vector<Traction<dim>>     tractions;
    std::vector<Pressure<dim>>     pressures;
    std::vector<ProbeRequest<dim>> probes;

    /// Declares subsection "Scene" with the defaults and units of every key.
    static void declare(dealii::ParameterHandler &prm);

    /// Relative paths are relative to @p folder, the parameter file's. Throws UserError naming
    /// section/key, the bad value and what is allowed.
    static Scene parse(dealii::ParameterHandler &prm, const std::filesystem::path &folder);
  };

  /// Reads Scene/Dimension: 2 (plane strain) or 3.
  int dimension_of(dealii::ParameterHandler &prm);

  /// Every boundary that the scene names, with the origin of the name for messages: supports,
  /// tractions, pressures, probes. To be looked up once there is a mesh.
  template <int dim>
  std::vector<std::pair<std::string, std::string>> boundary_references(const Scene<dim> &scene);

  /// Throws UserError for a traction or pressure on a boundary all of whose displacement
  /// components are prescribed: it would have no effect.
  template <int dim>
  void check_loads_against_supports(const Scene<dim> &scene);
} // namespace isochor
