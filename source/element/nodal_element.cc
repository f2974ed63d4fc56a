#include <isochor/element/nodal_element.h>

namespace isochor
{
  namespace
  {
    template <int dim>
    dealii::FiniteElementData<dim> layout(const ShapeFunctions<dim> &shape)
    {
      return dealii::FiniteElementData<dim>(shape.nodes_per_object(),
                                            reference_cell<dim>(shape.kind()),
                                            1,
                                            shape.degree(),
                                            shape.is_discontinuous()
                                                ? dealii::FiniteElementData<dim>::L2
                                                : dealii::FiniteElementData<dim>::H1);
    }
  } // namespace

  template <int dim>
  NodalElement<dim>::NodalElement(const ShapeFunctions<dim> &shape)
    : dealii::FiniteElement<dim>(
        layout(shape),
        std::vector<bool>(1, false),
        std::vector<dealii::ComponentMask>(1, dealii::ComponentMask(1, true)))
  {
    for (unsigned int i = 0; i < shape.n_nodes(); ++i)
      this->unit_support_points.push_back(shape.node(i));
  }

  template <int dim>
  std::unique_ptr<dealii::FiniteElement<dim>> NodalElement<dim>::clone() const
  {
    return std::make_unique<NodalElement<dim>>(*this);
  }

  template <int dim>
  std::string NodalElement<dim>::get_name() const
  {
    return "NodalElement<" + std::to_string(dim) + ">(" + std::to_string(this->n_dofs_per_cell())
           + " nodes)";
  }

  template <int dim>
  dealii::UpdateFlags
  NodalElement<dim>::requires_update_flags(const dealii::UpdateFlags flags) const
  {
    return flags;
  }

  template <int dim>
  auto NodalElement<dim>::get_data(const dealii::UpdateFlags,
                                   const dealii::Mapping<dim> &,
                                   const dealii::Quadrature<dim> &,
                                   ShapeData &) const -> std::unique_ptr<InternalData>
  {
    throw std::logic_error("NodalElement has no shape functions; use reference tables");
  }

  template <int dim>
  void NodalElement<dim>::fill_fe_values(const Cell &,
                                         const dealii::CellSimilarity::Similarity,
                                         const dealii::Quadrature<dim> &,
                                         const dealii::Mapping<dim> &,
                                         const MappingData &,
                                         const MappedData &,
                                         const InternalData &,
                                         ShapeData &) const
  {
    throw std::logic_error("NodalElement has no shape functions; use reference tables");
  }

  template <int dim>
  void NodalElement<dim>::fill_fe_subface_values(const Cell &,
                                                 const unsigned int,
                                                 const unsigned int,
                                                 const dealii::Quadrature<dim - 1> &,
                                                 const dealii::Mapping<dim> &,
                                                 const MappingData &,
                                                 const MappedData &,
                                                 const InternalData &,
                                                 ShapeData &) const
  {
    throw std::logic_error("NodalElement has no shape functions; use reference tables");
  }

  template class NodalElement<2>;
  template class NodalElement<3>;
} // namespace isochor
