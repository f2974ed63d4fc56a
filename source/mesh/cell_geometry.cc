#include <isochor/mesh/cell_geometry.h>

#include <bit>

namespace isochor
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    template <int dim>
    std::vector<unsigned int> make_node_vertices(const CellKind kind)
    {
      std::vector<unsigned int> nodes;
      for (unsigned int v = 0; v < n_vertices(kind, dim); ++v)
        nodes.push_back(1u << v);
      for (const auto &[a, b] : reference_edges<dim>(kind))
        nodes.push_back(1u << a | 1u << b);
      if (kind == CellKind::simplex) // quadratics have nothing inside the faces
        return nodes;
      if (dim == 3)
        for (const auto &face : reference_faces<dim>(kind))
          {
            nodes.push_back(0);
            for (const unsigned int v : face)
              nodes.back() |= 1u << v;
          }
      nodes.push_back((1u << n_vertices(kind, dim)) - 1);
      return nodes;
    }

    template <int dim>
    std::vector<Point<dim>> reference_vertices(const CellKind kind)
    {
      std::vector<Point<dim>> vertices;
      for (unsigned int v = 0; v < n_vertices(kind, dim); ++v)
        vertices.push_back(reference_vertex<dim>(kind, v));
      return vertices;
    }

    // Gradients of the barycentric coordinates: products of them are the simplex's shape functions.
    template <int dim>
    std::vector<Tensor<1, dim>>
    simplex_gradients(const unsigned int order, const unsigned int n, const Point<dim> &x)
    {
      std::array<double, dim + 1>         lambda{1.};
      std::array<Tensor<1, dim>, dim + 1> gradient;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lambda[d + 1] = x[d];
          lambda[0] -= x[d];
          gradient[d + 1][d] = 1;
          gradient[0][d]     = -1;
        }
      std::vector<Tensor<1, dim>> gradients(n);
      for (unsigned int v = 0; v <= dim; ++v)
        gradients[v] = order == 1 ? gradient[v] : (4 * lambda[v] - 1) * gradient[v];
      const auto &edges = reference_edges<dim>(CellKind::simplex);
      for (unsigned int i = dim + 1; i < n; ++i)
        {
          const auto [a, b] = edges[i - dim - 1];
          gradients[i]      = 4 * (lambda[a] * gradient[b] + lambda[b] * gradient[a]);
        }
      return gradients;
    }

    // Value and derivative at x of the polynomial of the given order that is 1 at @p node and 0 at
    // the other nodes 0, 1/2 (order 2), 1.
    std::array<double, 2> lagrange(const unsigned int order, const double node, const double x)
    {
      if (order == 1)
        return node == 0 ? std::array{1 - x, -1.} : std::array{x, 1.};
      if (node == 0)
        return {(1 - x) * (1 - 2 * x), 4 * x - 3};
      if (node == 1)
        return {x * (2 * x - 1), 4 * x - 1};
      return {4 * x * (1 - x), 4 - 8 * x};
    }

    template <int dim>
    std::vector<Tensor<1, dim>>
    hypercube_gradients(const unsigned int order, const unsigned int n, const Point<dim> &x)
    {
      const auto                  vertices = reference_vertices<dim>(CellKind::hypercube);
      std::vector<Tensor<1, dim>> gradients(n);
      for (unsigned int i = 0; i < n; ++i)
        {
          const Point<dim> node = middle(node_vertices<dim>(CellKind::hypercube)[i], vertices);
          for (unsigned int d = 0; d < dim; ++d)
            {
              gradients[i][d] = 1;
              for (unsigned int e = 0; e < dim; ++e)
                gradients[i][d] *= lagrange(order, node[e], x[e])[d == e ? 1 : 0];
            }
        }
      return gradients;
    }
  } // namespace

  template <int dim>
  const std::vector<unsigned int> &node_vertices(const CellKind kind)
  {
    static const std::array nodes{make_node_vertices<dim>(CellKind::simplex),
                                  make_node_vertices<dim>(CellKind::hypercube)};
    return nodes[static_cast<unsigned int>(kind)];
  }

  template <int dim>
  unsigned int n_geometry_nodes(const CellKind kind, const unsigned int order)
  {
    return order == 1 ? n_vertices(kind, dim) : node_vertices<dim>(kind).size();
  }

  template <int dim>
  Point<dim> middle(const unsigned int vertex_bits, const std::vector<Point<dim>> &vertices)
  {
    Point<dim> sum;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      if (vertex_bits >> v & 1)
        sum += vertices[v];
    return sum / static_cast<double>(std::popcount(vertex_bits));
  }

  template <int dim>
  std::vector<unsigned int> renumbered_nodes(const CellKind                   kind,
                                             const std::vector<unsigned int> &vertices)
  {
    const std::vector<unsigned int> &nodes = node_vertices<dim>(kind);
    std::vector<unsigned int>        old_nodes;
    for (const unsigned int bits : nodes)
      {
        unsigned int old_bits = 0;
        for (unsigned int v = 0; v < vertices.size(); ++v)
          if (bits >> v & 1)
            old_bits |= 1u << vertices[v];
        const auto old = std::find(nodes.begin(), nodes.end(), old_bits);
        if (old == nodes.end())
          throw std::logic_error("vertices renumbered in a way that tears edges");
        old_nodes.push_back(old - nodes.begin());
      }
    return old_nodes;
  }

  template <int dim>
  std::vector<Point<dim>> cell_vertices(const RawMesh<dim> &mesh, const std::size_t cell)
  {
    std::vector<Point<dim>> vertices;
    vertices.reserve(mesh.cells[cell].vertices.size());
    for (const unsigned int v : mesh.cells[cell].vertices)
      vertices.push_back(mesh.vertices[v]);
    return vertices;
  }

  template <int dim>
  std::vector<Point<dim>> cell_nodes(const RawMesh<dim> &mesh, const std::size_t cell)
  {
    if (mesh.geometry.order == 1)
      return cell_vertices(mesh, cell);
    const unsigned int n     = n_geometry_nodes<dim>(mesh.kind, mesh.geometry.order);
    const auto         first = mesh.geometry.points.begin() + cell * n;
    return {first, first + n};
  }

  template <int dim>
  CellMap<dim>::CellMap(const CellKind                 kind,
                        const unsigned int             order,
                        const std::vector<Point<dim>> &points)
    : n_nodes(n_geometry_nodes<dim>(kind, order))
  {
    for (const Point<dim> &x : points)
      {
        const auto at_x = kind == CellKind::simplex ? simplex_gradients<dim>(order, n_nodes, x)
                                                    : hypercube_gradients<dim>(order, n_nodes, x);
        gradients.insert(gradients.end(), at_x.begin(), at_x.end());
      }
  }

  template <int dim>
  double CellMap<dim>::determinant(const unsigned int q, const std::vector<Point<dim>> &nodes) const
  {
    Tensor<2, dim> jacobian;
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        jacobian[d] += nodes[i][d] * gradients[q * n_nodes + i];
    return dealii::determinant(jacobian);
  }

  template class CellMap<2>;
  template class CellMap<3>;
  template const std::vector<unsigned int> &node_vertices<2>(CellKind);
  template const std::vector<unsigned int> &node_vertices<3>(CellKind);
  template unsigned int                     n_geometry_nodes<2>(CellKind, unsigned int);
  template unsigned int                     n_geometry_nodes<3>(CellKind, unsigned int);
  template Point<2>                         middle(unsigned int, const std::vector<Point<2>> &);
  template Point<3>                         middle(unsigned int, const std::vector<Point<3>> &);
  template std::vector<unsigned int>        renumbered_nodes<2>(CellKind,
                                                         const std::vector<unsigned int> &);
  template std::vector<unsigned int>        renumbered_nodes<3>(CellKind,
                                                         const std::vector<unsigned int> &);
  template std::vector<Point<2>>            cell_vertices(const RawMesh<2> &, std::size_t);
  template std::vector<Point<3>>            cell_vertices(const RawMesh<3> &, std::size_t);
  template std::vector<Point<2>>            cell_nodes(const RawMesh<2> &, std::size_t);
  template std::vector<Point<3>>            cell_nodes(const RawMesh<3> &, std::size_t);
} // namespace isochor
