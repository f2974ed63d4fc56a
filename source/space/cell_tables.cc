#include <isochor/space/cell_tables.h>

namespace isochor
{
  namespace
  {
    template <int dim>
    void complete(PointMap<dim> &map)
    {
      map.inverse     = dealii::invert(map.jacobian);
      map.determinant = dealii::determinant(map.jacobian);
    }

    template <int dim>
    void add_product(dealii::Tensor<2, dim>       &jacobian,
                     const dealii::Point<dim>     &node,
                     const dealii::Tensor<1, dim> &gradient)
    {
      for (unsigned int d = 0; d < dim; ++d)
        jacobian[d] += node[d] * gradient;
    }

    template <int dim>
    PointMap<dim> affine_map(const CellTables<dim> &cells, const std::size_t cell)
    {
      PointMap<dim> map;
      for (unsigned int k = 0; k < dim; ++k)
        {
          // On a hypercube, vertex 2^k is the neighbour of vertex 0 along coordinate k.
          const unsigned int v = cells.kind == CellKind::simplex ? k + 1 : 1u << k;
          for (unsigned int d = 0; d < dim; ++d)
            {
              map.jacobian[d][k] = cells.vertex(cell, v)[d] - cells.vertex(cell, 0)[d];
              map.inverse[k][d]  = cells.inverse(cell)[k * dim + d];
            }
        }
      map.determinant = cells.determinant[cell];
      return map;
    }
  } // namespace

  template <int dim>
  dealii::Point<dim> CellTables<dim>::position(const std::size_t         cell,
                                               const dealii::Point<dim> &xi) const
  {
    dealii::Point<dim> position;
    for (unsigned int i = 0; i < n_g; ++i)
      position += geometry_shape->value(i, xi) * geometry[cell * n_g + i];
    return position;
  }

  template <int dim>
  PointMap<dim> CellTables<dim>::map(const std::size_t cell, const dealii::Point<dim> &xi) const
  {
    if (is_affine[cell])
      return affine_map(*this, cell);
    PointMap<dim> map;
    for (unsigned int i = 0; i < n_g; ++i)
      add_product(map.jacobian, geometry[cell * n_g + i], geometry_shape->gradient(i, xi));
    complete(map);
    return map;
  }

  template <int dim>
  GeometryTable<dim>::GeometryTable(const CellTables<dim>                 &cells,
                                    const std::vector<dealii::Point<dim>> &points)
    : cells(cells)
    , shape(*cells.geometry_shape, points)
  {
  }

  template <int dim>
  PointMap<dim> GeometryTable<dim>::map(const std::size_t cell, const unsigned int point) const
  {
    if (cells.is_affine[cell])
      return affine_map(cells, cell);
    PointMap<dim> map;
    for (unsigned int i = 0; i < cells.n_g; ++i)
      add_product(map.jacobian, cells.geometry[cell * cells.n_g + i], shape.gradient(point, i));
    complete(map);
    return map;
  }

  template <int dim>
  dealii::Point<dim> GeometryTable<dim>::position(const std::size_t  cell,
                                                  const unsigned int point) const
  {
    dealii::Point<dim> position;
    for (unsigned int i = 0; i < cells.n_g; ++i)
      position += shape.value(point, i) * cells.geometry[cell * cells.n_g + i];
    return position;
  }

  template <int dim>
  void add_cell_geometry(CellTables<dim> &cells)
  {
    const std::size_t         cell  = cells.determinant.size();
    const dealii::Point<dim> *nodes = &cells.geometry[cell * cells.n_g];

    // Affine if every node is where the affine map of the first dim + 1 vertices puts it.
    cells.is_affine.push_back(1);
    cells.determinant.push_back(0.);
    cells.inverse_jacobian.resize((cell + 1) * dim * dim);
    PointMap<dim> map       = affine_map(cells, cell);
    double        deviation = 0, size = 0;
    for (unsigned int i = 1; i < cells.n_g; ++i)
      {
        const auto                   xi = cells.geometry_shape->node(i);
        const dealii::Tensor<1, dim> d  = nodes[i] - nodes[0];
        deviation = std::max(deviation, (d - map.jacobian * dealii::Tensor<1, dim>(xi)).norm());
        size      = std::max(size, d.norm());
      }
    if (deviation > 1e-11 * size)
      {
        cells.is_affine.back() = 0;
        cells.all_affine       = false;
        map                    = cells.map(cell, reference_centre<dim>(cells.kind));
      }
    else
      complete(map);

    cells.determinant.back() = map.determinant;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int J = 0; J < dim; ++J)
        cells.inverse_jacobian[(cell * dim + k) * dim + J] = map.inverse[k][J];
  }

  template struct CellTables<2>;
  template struct CellTables<3>;
  template class GeometryTable<2>;
  template class GeometryTable<3>;
  template void add_cell_geometry(CellTables<2> &);
  template void add_cell_geometry(CellTables<3> &);
} // namespace isochor
