#pragma once

// States from elsewhere: from a formula, from another mesh of the same body.

#include <isochor/space/discretisation.h>

#include <functional>

namespace isochor
{
  /// Set the owned displacements of @p state to @p displacement (m) at the reference positions of
  /// their nodes; bubbles are zero. Not collective.
  template <int dim>
  void set_displacements(
      const Discretisation<dim>                                               &discretisation,
      const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> &displacement,
      Vector                                                                  &state);

  /// Set the owned unknowns of @p to, a state of @p fine, to what the state @p from of @p coarse,
  /// with ghosts, has at their nodes; bubbles and slopes of discontinuous pressures are zero. Each
  /// rank asks those that own the coarse cells around its nodes. A node outside the coarse body gets
  /// the continuation of the nearest cell. The elements are the same. Collective.
  template <int dim>
  void interpolate(const Discretisation<dim> &coarse,
                   const Vector              &from,
                   const Discretisation<dim> &fine,
                   Vector                    &to);
} // namespace isochor
