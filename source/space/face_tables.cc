#include <isochor/element/simplex_quadrature.h>
#include <isochor/space/face_tables.h>

namespace isochor
{
  namespace
  {
    template <int dim>
    dealii::Point<dim> vertex(const unsigned int v)
    {
      return v == 0 ? dealii::Point<dim>() : dealii::Point<dim>::unit_vector(v - 1);
    }

    /// t_1 x t_2 in 3D, t rotated clockwise in 2D.
    template <int dim>
    dealii::Tensor<1, dim> normal_of(const std::array<dealii::Tensor<1, dim>, dim - 1> &tangents)
    {
      if constexpr (dim == 2)
        return dealii::Tensor<1, 2>({tangents[0][1], -tangents[0][0]});
      else
        return dealii::cross_product_3d(tangents[0], tangents[1]);
    }
  } // namespace

  template <int dim>
  unsigned int FaceTables<dim>::exact_degree(const LagrangeSimplex<dim> &x_shape)
  {
    const unsigned int k = x_shape.degree();
    return k + (dim - 1) * (k - 1) + 1;
  }

  template <int dim>
  FaceTables<dim>::FaceTables(const LagrangeSimplex<dim> &x_shape, const unsigned int degree)
  {
    const auto quadrature = simplex_quadrature<dim - 1>(degree);
    for (unsigned int face = 0; face <= dim; ++face)
      {
        FaceTable<dim> table;
        table.nodes         = x_shape.nodes_on_face(face);
        const auto vertices = face_vertices<dim>(face);
        const auto origin   = vertex<dim>(vertices[0]);
        for (unsigned int m = 0; m + 1 < dim; ++m)
          table.tangents[m] = vertex<dim>(vertices[m + 1]) - origin;

        // The vertex that is not on the face lies on its inner side.
        unsigned int opposite = (dim + 1) * dim / 2;
        for (const unsigned int v : vertices)
          opposite -= v;
        table.sign = normal_of<dim>(table.tangents) * (origin - vertex<dim>(opposite)) > 0 ? 1 : -1;

        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            typename FaceTable<dim>::At at;
            at.xi = origin;
            for (unsigned int m = 0; m + 1 < dim; ++m)
              at.xi += quadrature.point(q)[m] * table.tangents[m];
            at.weight = quadrature.weight(q);
            for (const unsigned int a : table.nodes)
              {
                at.value.push_back(x_shape.value(a, at.xi));
                const auto                  gradient = x_shape.gradient(a, at.xi);
                std::array<double, dim - 1> derivative;
                for (unsigned int m = 0; m + 1 < dim; ++m)
                  derivative[m] = gradient * table.tangents[m];
                at.derivative.push_back(derivative);
              }
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
    point.reference_position = cells.position(face.cell, at.xi);

    const auto vertices = face_vertices<dim>(face.face);
    const auto corner
        = [&](const unsigned int v) { return cells.vertices[face.cell * (dim + 1) + vertices[v]]; };
    for (unsigned int m = 0; m + 1 < dim; ++m)
      point.tangents[m] = corner(m + 1) - corner(0);
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
