#include <isochor/element/cell_quadrature.h>
#include <isochor/mesh/quality.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    template <int dim>
    double longest_edge(const CellKind kind, const std::vector<Point<dim>> &vertices)
    {
      double longest = 0;
      for (const auto &[a, b] : reference_edges<dim>(kind))
        longest = std::max(longest, vertices[a].distance(vertices[b]));
      return longest;
    }

    // Angle in degrees from its sine and cosine up to a common factor: accurate near 0 and 180,
    // where acos is not.
    double degrees(const double sine, const double cosine)
    {
      return std::atan2(sine, cosine) * 180 / M_PI;
    }

    double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    double angle(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
    {
      return degrees(std::abs(cross(a, b)), a * b);
    }

    double angle(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      return degrees(cross_product_3d(a, b).norm(), a * b);
    }

    CellShape simplex_shape(const std::vector<Point<2>> &v)
    {
      CellShape shape;
      shape.volume          = cross(v[1] - v[0], v[2] - v[0]) / 2;
      shape.longest_edge    = longest_edge<2>(CellKind::simplex, v);
      shape.smallest_height = 2 * std::abs(shape.volume) / shape.longest_edge;
      shape.min_angle       = 180;
      for (unsigned int a = 0; a < 3; ++a)
        shape.min_angle
            = std::min(shape.min_angle, angle(v[(a + 1) % 3] - v[a], v[(a + 2) % 3] - v[a]));
      return shape;
    }

    CellShape simplex_shape(const std::vector<Point<3>> &v)
    {
      CellShape          shape;
      const Tensor<1, 3> a = v[1] - v[0], b = v[2] - v[0], c = v[3] - v[0];

      shape.volume       = a * cross_product_3d(b, c) / 6;
      shape.longest_edge = longest_edge<3>(CellKind::simplex, v);

      // Twice the area vectors of the faces opposite vertices 1, 2, 3 and 0, all inward or all
      // outward; they add up to zero.
      std::array<Tensor<1, 3>, 4> n;
      n[1] = cross_product_3d(b, c);
      n[2] = cross_product_3d(c, a);
      n[3] = cross_product_3d(a, b);
      n[0] = -(n[1] + n[2] + n[3]);

      double largest_face = 0;
      shape.min_angle     = 180;
      for (unsigned int i = 0; i < 4; ++i)
        {
          largest_face = std::max(largest_face, n[i].norm() / 2);
          for (unsigned int j = 0; j < i; ++j)
            shape.min_angle = std::min(shape.min_angle, angle(n[i], -n[j]));
        }
      shape.smallest_height = 3 * std::abs(shape.volume) / largest_face;
      return shape;
    }

    // Smallest height and smallest angle of the parallelogram or parallelepiped of these edges.
    std::array<double, 2> corner_shape(const std::array<Tensor<1, 2>, 2> &e)
    {
      return {std::abs(cross(e[0], e[1])) / std::max(e[0].norm(), e[1].norm()), angle(e[0], e[1])};
    }

    std::array<double, 2> corner_shape(const std::array<Tensor<1, 3>, 3> &e)
    {
      double largest_area = 0, smallest_angle = 180;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const Tensor<1, 3> &a = e[(d + 1) % 3], &b = e[(d + 2) % 3];
          largest_area   = std::max(largest_area, cross_product_3d(a, b).norm());
          smallest_angle = std::min({smallest_angle,
                                     angle(a, b),
                                     // between the planes that meet in edge d
                                     angle(cross_product_3d(e[d], a), cross_product_3d(e[d], b))});
        }
      return {std::abs(e[0] * cross_product_3d(e[1], e[2])) / largest_area, smallest_angle};
    }

    // The integral of the Jacobian determinant; exact, see volume_rule.
    template <int dim>
    double integrate(const CellMap<dim>            &map,
                     const dealii::Quadrature<dim> &rule,
                     const std::vector<Point<dim>> &nodes)
    {
      double volume = 0;
      for (unsigned int q = 0; q < rule.size(); ++q)
        volume += rule.weight(q) * map.determinant(q, nodes);
      return volume;
    }

    // For Jacobian determinants of maps of order k: degree dim (k - 1) on simplices, dim k - 1 in each
    // direction on hypercubes.
    template <int dim>
    dealii::Quadrature<dim> volume_rule(const CellKind kind, const unsigned int order)
    {
      return cell_quadrature<dim>(
          kind, kind == CellKind::simplex ? std::max(1u, dim * (order - 1)) : dim * order - 1);
    }

    template <int dim>
    CellShape hypercube_shape(const std::vector<Point<dim>> &v)
    {
      static const dealii::Quadrature<dim> rule = volume_rule<dim>(CellKind::hypercube, 1);
      static const CellMap<dim>            map(CellKind::hypercube, 1, rule.get_points());

      CellShape shape;
      shape.volume          = integrate(map, rule, v);
      shape.longest_edge    = longest_edge<dim>(CellKind::hypercube, v);
      shape.smallest_height = shape.longest_edge;
      shape.min_angle       = 180;
      for (unsigned int corner = 0; corner < v.size(); ++corner)
        {
          std::array<Tensor<1, dim>, dim> edges;
          for (unsigned int d = 0; d < dim; ++d)
            edges[d] = v[corner ^ 1u << d] - v[corner];
          const auto [height, angle] = corner_shape(edges);
          // Written so that a height that is no number stays one.
          if (!(height >= shape.smallest_height))
            shape.smallest_height = height;
          shape.min_angle = std::min(shape.min_angle, angle);
        }
      return shape;
    }
  } // namespace

  template <int dim>
  CellShape cell_shape(const CellKind kind, const std::vector<Point<dim>> &vertices)
  {
    return kind == CellKind::simplex ? simplex_shape(vertices) : hypercube_shape(vertices);
  }

  template <int dim>
  MeshQuality measure_quality(const RawMesh<dim> &mesh)
  {
    const auto         rule = volume_rule<dim>(mesh.kind, mesh.geometry.order);
    const CellMap<dim> map(mesh.kind, mesh.geometry.order, rule.get_points());
    MeshQuality        quality;
    quality.min_angle = 180;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const CellShape shape = cell_shape(mesh.kind, cell_vertices(mesh, cell));
        quality.min_angle     = std::min(quality.min_angle, shape.min_angle);
        quality.max_aspect
            = std::max(quality.max_aspect, shape.longest_edge / shape.smallest_height);
        quality.total_volume += mesh.geometry.order == 1
                                    ? shape.volume
                                    : integrate(map, rule, cell_nodes(mesh, cell));
      }
    return quality;
  }

  template CellShape   cell_shape(CellKind, const std::vector<Point<2>> &);
  template CellShape   cell_shape(CellKind, const std::vector<Point<3>> &);
  template MeshQuality measure_quality<2>(const RawMesh<2> &);
  template MeshQuality measure_quality<3>(const RawMesh<3> &);
} // namespace isochor
