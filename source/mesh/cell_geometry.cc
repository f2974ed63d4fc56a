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
    return make_shape_functions<dim>(kind, {Family::lagrange, order})->n_nodes();
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
    : shape(*make_shape_functions<dim>(kind, {Family::lagrange, order}), points)
  {
  }

  template <int dim>
  double CellMap<dim>::determinant(const unsigned int q, const std::vector<Point<dim>> &nodes) const
  {
    Tensor<2, dim> jacobian;
    for (unsigned int i = 0; i < shape.n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        jacobian[d] += nodes[i][d] * shape.gradient(q, i);
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
