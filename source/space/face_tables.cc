#include <isochor/element/cell_quadrature.h>
#include <isochor/space/face_tables.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /// t_1 x t_2 in 3D, t rotated clockwise in 2D.
    template <int dim>
    dealii::Tensor<1, dim> normal_of(const std::array<dealii::Tensor<1, dim>, dim - 1> &tangents)
    {
      if constexpr (dim == 2)
        return dealii::Tensor<1, 2>({tangents[0][1], -tangents[0][0]});
      else
        return dealii::cross_product_3d(tangents[0], tangents[1]);
    }

    /// Values and derivatives along @p tangents of the functions of @p nodes at @p xi.
    template <int dim>
    void tabulate(const ShapeFunctions<dim>                         &shape,
                  const std::vector<unsigned int>                   &nodes,
                  const dealii::Point<dim>                          &xi,
                  const std::array<dealii::Tensor<1, dim>, dim - 1> &tangents,
                  std::vector<double>                               &value,
                  std::vector<std::array<double, dim - 1>>          &derivative)
    {
      for (const unsigned int a : nodes)
        {
          value.push_back(shape.value(a, xi));
          const auto gradient = shape.gradient(a, xi);
          derivative.emplace_back();
          for (unsigned int m = 0; m + 1 < dim; ++m)
            derivative.back()[m] = gradient * tangents[m];
        }
    }
  } // namespace

  template <int dim>
  unsigned int FaceTables<dim>::exact_degree(const Discretisation<dim> &discretisation)
  {
    const unsigned int k        = discretisation.x_shape.trace_degree();
    const unsigned int position = std::max(
        k, discretisation.cells.all_affine ? 1 : discretisation.cells.geometry_shape->degree());
    return k + (dim - 1) * (position - 1) + 1;
  }

  template <int dim>
  FaceTables<dim>::FaceTables(const Discretisation<dim> &discretisation, const unsigned int degree)
  {
    const CellKind kind           = discretisation.element.kind;
    const auto    &x_shape        = discretisation.x_shape;
    const auto    &geometry_shape = *discretisation.cells.geometry_shape;
    const auto     quadrature     = cell_quadrature<dim - 1>(kind, degree);

    const auto  centre = reference_centre<dim>(kind);
    const auto &faces  = reference_faces<dim>(kind);
    for (unsigned int face = 0; face < faces.size(); ++face)
      {
        FaceTable<dim> table;
        table.nodes          = x_shape.nodes_on_face(face);
        table.geometry_nodes = geometry_shape.nodes_on_face(face);
        const auto origin    = reference_vertex<dim>(kind, faces[face][0]);
        for (unsigned int m = 0; m + 1 < dim; ++m)
          table.tangents[m] = reference_vertex<dim>(kind, faces[face][m + 1]) - origin;
        table.sign = normal_of<dim>(table.tangents) * (origin - centre) > 0 ? 1 : -1;

        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            typename FaceTable<dim>::At at;
            at.xi = origin;
            for (unsigned int m = 0; m + 1 < dim; ++m)
              at.xi += quadrature.point(q)[m] * table.tangents[m];
            at.weight = quadrature.weight(q);
            tabulate(x_shape, table.nodes, at.xi, table.tangents, at.value, at.derivative);
            tabulate(geometry_shape,
                     table.geometry_nodes,
                     at.xi,
                     table.tangents,
                     at.geometry_value,
                     at.geometry_derivative);
            table.points.push_back(std::move(at));
          }
        tables.push_back(std::move(table));
      }
  }

  template <int dim>
  FacePoint<dim> evaluate_face(const CellTables<dim>             &cells,
                               const BoundaryFace                &face,
                               const FaceTable<dim>              &table,
                               const typename FaceTable<dim>::At &at,
                               const double                      *values)
  {
    FacePoint<dim> point;
    for (unsigned int n = 0; n < table.geometry_nodes.size(); ++n)
      {
        const auto &X = cells.geometry[face.cell * cells.n_g + table.geometry_nodes[n]];
        point.reference_position += at.geometry_value[n] * X;
        for (unsigned int m = 0; m + 1 < dim; ++m)
          point.tangents[m] += at.geometry_derivative[n][m] * X;
      }
    point.reference_area = normal_of<dim>(point.tangents).norm();

    for (unsigned int n = 0; values != nullptr && n < table.nodes.size(); ++n)
      {
        const double *u = values + cells.x[face.cell * cells.n_x + table.nodes[n]];
        for (unsigned int i = 0; i < dim; ++i)
          {
            point.displacement[i] += at.value[n] * u[i];
            for (unsigned int m = 0; m + 1 < dim; ++m)
              point.tangents[m][i] += at.derivative[n][m] * u[i];
          }
      }
    point.normal = table.sign * normal_of<dim>(point.tangents);
    return point;
  }

  template class FaceTables<2>;
  template class FaceTables<3>;
  template FacePoint<2> evaluate_face(const CellTables<2> &,
                                      const BoundaryFace &,
                                      const FaceTable<2> &,
                                      const FaceTable<2>::At &,
                                      const double *);
  template FacePoint<3> evaluate_face(const CellTables<3> &,
                                      const BoundaryFace &,
                                      const FaceTable<3> &,
                                      const FaceTable<3>::At &,
                                      const double *);
} // namespace isochor
