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
    double longest_edge(const std::array<Point<dim>, dim + 1> &vertices)
    {
      double longest = 0;
      for (unsigned int a = 0; a <= dim; ++a)
        for (unsigned int b = 0; b < a; ++b)
          longest = std::max(longest, vertices[a].distance(vertices[b]));
      return longest;
    }

    // Angle in degrees from its sine and cosine up to a common factor: accurate near 0 and 180,
    // where acos is not.
    double degrees(const double sine, const double cosine)
    {
      return std::atan2(sine, cosine) * 180 / M_PI;
    }
  } // namespace

  template <>
  CellShape cell_shape<2>(const std::array<Point<2>, 3> &v)
  {
    CellShape  shape;
    const auto cross
        = [](const Tensor<1, 2> &a, const Tensor<1, 2> &b) { return a[0] * b[1] - a[1] * b[0]; };
    shape.volume          = cross(v[1] - v[0], v[2] - v[0]) / 2;
    shape.longest_edge    = longest_edge<2>(v);
    shape.smallest_height = 2 * std::abs(shape.volume) / shape.longest_edge;
    shape.min_angle       = 180;
    for (unsigned int a = 0; a < 3; ++a)
      {
        const Tensor<1, 2> e = v[(a + 1) % 3] - v[a];
        const Tensor<1, 2> f = v[(a + 2) % 3] - v[a];
        shape.min_angle      = std::min(shape.min_angle, degrees(std::abs(cross(e, f)), e * f));
      }
    return shape;
  }

  template <>
  CellShape cell_shape<3>(const std::array<Point<3>, 4> &v)
  {
    CellShape          shape;
    const Tensor<1, 3> a = v[1] - v[0], b = v[2] - v[0], c = v[3] - v[0];

    shape.volume       = a * cross_product_3d(b, c) / 6;
    shape.longest_edge = longest_edge<3>(v);

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
          shape.min_angle = std::min(shape.min_angle,
                                     degrees(cross_product_3d(n[i], n[j]).norm(), -(n[i] * n[j])));
      }
    shape.smallest_height = 3 * std::abs(shape.volume) / largest_face;
    return shape;
  }

  template <int dim>
  std::array<Point<dim>, dim + 1> cell_vertices(const RawMesh<dim> &mesh, const std::size_t cell)
  {
    std::array<Point<dim>, dim + 1> vertices;
    for (unsigned int v = 0; v <= dim; ++v)
      vertices[v] = mesh.vertices[mesh.cells[cell].vertices[v]];
    return vertices;
  }

  template <int dim>
  MeshQuality measure_quality(const RawMesh<dim> &mesh)
  {
    MeshQuality quality;
    quality.min_angle = 180;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const CellShape shape = cell_shape<dim>(cell_vertices(mesh, cell));
        quality.min_angle     = std::min(quality.min_angle, shape.min_angle);
        quality.max_aspect
            = std::max(quality.max_aspect, shape.longest_edge / shape.smallest_height);
        quality.total_volume += shape.volume;
      }
    return quality;
  }

  template std::array<Point<2>, 3> cell_vertices<2>(const RawMesh<2> &, std::size_t);
  template std::array<Point<3>, 4> cell_vertices<3>(const RawMesh<3> &, std::size_t);
  template MeshQuality             measure_quality<2>(const RawMesh<2> &);
  template MeshQuality             measure_quality<3>(const RawMesh<3> &);
} // namespace isochor
