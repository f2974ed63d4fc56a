#pragma once

// The parts of Scene::declare and Scene::parse, and what they share. All functions work in the
// subsection "Scene" that the caller has entered.

#include <isochor/core/parameters.h>
#include <isochor/scene/scene.h>

namespace isochor::scene_parts
{
  void     declare_mesh(dealii::ParameterHandler &prm);
  void     declare_material(dealii::ParameterHandler &prm);
  void     declare_supports(dealii::ParameterHandler &prm);
  void     declare_loads(dealii::ParameterHandler &prm);
  void     declare_probes(dealii::ParameterHandler &prm);
  Material parse_material(dealii::ParameterHandler &prm);
  MeshRequest
  parse_mesh(dealii::ParameterHandler &prm, int dim, const std::filesystem::path &folder);
  template <int dim>
  void parse_supports(dealii::ParameterHandler &prm, Scene<dim> &scene);
  template <int dim>
  void parse_loads(dealii::ParameterHandler &prm, Scene<dim> &scene);
  template <int dim>
  void parse_probes(dealii::ParameterHandler &prm, Scene<dim> &scene);

  /// An entry "NAME: VALUE" of a list parameter.
  struct Entry
  {
    std::string name;
    std::string value;
    std::string origin; ///< "Scene/Key: entry 'TEXT'", the beginning of every message about it
  };

  /// The entries of the list parameter @p key. @p form describes an entry for messages. Throws
  /// UserError for one without a name or a value.
  std::vector<Entry>
  entries_of(dealii::ParameterHandler &prm, const std::string &key, const std::string &form);

  /// Throws UserError beginning with @p origin if @p name cannot be a boundary's.
  void check_boundary_name(const std::string &name, const std::string &origin);

  /// 0, 1, 2 for x, y, z. Throws UserError beginning with @p origin, also for z in 2D.
  unsigned int parse_component(const std::string &word, int dim, const std::string &origin);
} // namespace isochor::scene_parts
