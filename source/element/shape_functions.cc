#include <isochor/element/bubble_simplex.h>
#include <isochor/element/hypercube_functions.h>

#include <stdexcept>

namespace isochor
{
  template <int dim>
  std::unique_ptr<const ShapeFunctions<dim>> make_shape_functions(const CellKind    kind,
                                                                  const FieldSpace &space)
  {
    const bool simplex = kind == CellKind::simplex;
    switch (space.family)
      {
        case Family::lagrange:
          if (simplex)
            return std::make_unique<LagrangeSimplex<dim>>(space.degree);
          return std::make_unique<LagrangeHypercube<dim>>(space.degree);
        case Family::bubble:
          if (simplex && space.degree == 1)
            return std::make_unique<BubbleSimplex<dim>>();
          break;
        case Family::discontinuous:
          if (!simplex)
            return std::make_unique<DiscontinuousHypercube<dim>>(space.degree);
          if (space.degree == 0)
            return std::make_unique<LagrangeSimplex<dim>>(0);
          break;
      }
    throw std::logic_error("shape functions that do not exist");
  }

  template std::unique_ptr<const ShapeFunctions<2>> make_shape_functions(CellKind,
                                                                         const FieldSpace &);
  template std::unique_ptr<const ShapeFunctions<3>> make_shape_functions(CellKind,
                                                                         const FieldSpace &);
} // namespace isochor
