#pragma once

// Supports written in one line.

#include <isochor/scene/scene.h>

namespace isochor::testing
{
  /// Holds @p components ("x", "xy", ...) of @p boundary, at rest unless told otherwise.
  template <int dim>
  Support<dim> held(
      const std::string                                                        &boundary,
      const std::string                                                        &components,
      std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &, double)> displacement
      = [](const dealii::Point<dim> &, double) { return dealii::Tensor<1, dim>(); })
  {
    Support<dim> support;
    support.boundary = boundary;
    support.origin   = "support of '" + boundary + "'";
    for (const char c : components)
      support.components[c - 'x'] = true;
    support.displacement = std::move(displacement);
    return support;
  }

  template <int dim>
  const std::vector<std::string> box_sides
      = dim == 2 ? std::vector<std::string>{"left", "right", "bottom", "top"}
                 : std::vector<std::string>{"left", "right", "bottom", "top", "back", "front"};

  template <int dim>
  const std::string all_components = dim == 2 ? "xy" : "xyz";

  /// Young's modulus 3 Pa (mu = 1 Pa at nu = 0.5), the left side held, tractions on the right.
  template <int dim>
  Scene<dim> clamped_and_pulled(const double poisson_ratio)
  {
    Scene<dim> scene;
    scene.material.youngs_modulus = 3.;
    scene.material.poisson_ratio  = poisson_ratio;
    scene.supports.push_back(held<dim>("left", all_components<dim>));
    std::vector<Expression<dim>> components;
    components.emplace_back("0.3", "test");
    components.emplace_back("0.2*y", "test");
    if (dim == 3)
      components.emplace_back("-0.1", "test");
    scene.tractions.push_back({"right", components});
    return scene;
  }
} // namespace isochor::testing
