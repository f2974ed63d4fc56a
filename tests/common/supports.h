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
} // namespace isochor::testing
