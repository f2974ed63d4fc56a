#pragma once

// A deal.II finite element that only says where its nodes sit: one, two, ... on each vertex,
// edge, face, cell. A DoFHandler needs no more to number a field.

#include <isochor/element/shape_functions.h>

#include <deal.II/fe/fe.h>

namespace isochor
{
  /// Shape functions live in ShapeFunctions and are evaluated from reference tables; FEValues
  /// throws. (deal.II 9.4.1's FE_SimplexP stops at degree 2, and its FESystem of elements with
  /// DoFs inside faces is broken.)
  template <int dim>
  class NodalElement : public dealii::FiniteElement<dim>
  {
  public:
    explicit NodalElement(const ShapeFunctions<dim> &shape);

    std::unique_ptr<dealii::FiniteElement<dim>> clone() const override;
    std::string                                 get_name() const override;
    dealii::UpdateFlags requires_update_flags(const dealii::UpdateFlags flags) const override;

  private:
    using InternalData = typename dealii::FiniteElement<dim>::InternalDataBase;
    using MappingData  = typename dealii::Mapping<dim>::InternalDataBase;
    using MappedData   = dealii::internal::FEValuesImplementation::MappingRelatedData<dim, dim>;
    using ShapeData = dealii::internal::FEValuesImplementation::FiniteElementRelatedData<dim, dim>;
    using Cell      = typename dealii::Triangulation<dim>::cell_iterator;

    std::unique_ptr<InternalData> get_data(const dealii::UpdateFlags,
                                           const dealii::Mapping<dim> &,
                                           const dealii::Quadrature<dim> &,
                                           ShapeData &) const override;
    void                          fill_fe_values(const Cell &,
                                                 const dealii::CellSimilarity::Similarity,
                                                 const dealii::Quadrature<dim> &,
                                                 const dealii::Mapping<dim> &,
                                                 const MappingData &,
                                                 const MappedData &,
                                                 const InternalData &,
                                                 ShapeData &) const override;
    void                          fill_fe_subface_values(const Cell &,
                                                         const unsigned int,
                                                         const unsigned int,
                                                         const dealii::Quadrature<dim - 1> &,
                                                         const dealii::Mapping<dim> &,
                                                         const MappingData &,
                                                         const MappedData &,
                                                         const InternalData &,
                                                         ShapeData &) const override;
  };
} // namespace isochor
