#include <isochor/element/hypercube_functions.h>

#include <algorithm>
#include <stdexcept>

namespace isochor
{
  namespace
  {
    /// Lagrange polynomial of node n / k in one coordinate, and its derivative.
    std::array<double, 2> lagrange(const unsigned int k, const unsigned int n, const double x)
    {
      std::array<double, 2> result{1., 0.};
      for (unsigned int m = 0; m <= k; ++m)
        if (m != n)
          {
            const double scale = 1. / (double(n) - double(m));
            result[1]          = result[1] * (k * x - m) * scale + result[0] * k * scale;
            result[0] *= (k * x - m) * scale;
          }
      return result;
    }
  } // namespace

  template <int dim>
  LagrangeHypercube<dim>::LagrangeHypercube(const unsigned int degree)
    : degree_(degree)
  {
    if (degree < 1 || degree > 2)
      throw std::logic_error("Lagrange hypercubes are implemented for degrees 1 and 2");

    // In the middle of the vertices of an edge, a face, the cell.
    const auto add_middle = [&](const auto &vertices) {
      std::array<unsigned int, dim> index{};
      for (unsigned int d = 0; d < dim; ++d)
        {
          unsigned int sum = 0;
          for (const unsigned int v : vertices)
            sum += degree * (v >> d & 1);
          index[d] = sum / vertices.size();
        }
      indices.push_back(index);
    };

    std::vector<unsigned int> all;
    for (unsigned int v = 0; v < n_vertices(CellKind::hypercube, dim); ++v)
      {
        all.push_back(v);
        add_middle(std::array{v});
      }
    if (degree == 2)
      {
        for (const auto &edge : reference_edges<dim>(CellKind::hypercube))
          add_middle(edge);
        if (dim == 3)
          for (const auto &face : reference_faces<dim>(CellKind::hypercube))
            add_middle(face);
        add_middle(all);
      }
  }

  template <int dim>
  dealii::Point<dim> LagrangeHypercube<dim>::node(const unsigned int i) const
  {
    dealii::Point<dim> xi;
    for (unsigned int d = 0; d < dim; ++d)
      xi[d] = double(indices[i][d]) / degree_;
    return xi;
  }

  template <int dim>
  double LagrangeHypercube<dim>::value(const unsigned int i, const dealii::Point<dim> &xi) const
  {
    double product = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      product *= lagrange(degree_, indices[i][d], xi[d])[0];
    return product;
  }

  template <int dim>
  dealii::Tensor<1, dim> LagrangeHypercube<dim>::gradient(const unsigned int        i,
                                                          const dealii::Point<dim> &xi) const
  {
    dealii::Tensor<1, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
      gradient[d] = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto [value, slope] = lagrange(degree_, indices[i][d], xi[d]);
        for (unsigned int e = 0; e < dim; ++e)
          gradient[e] *= e == d ? slope : value;
      }
    return gradient;
  }

  template <int dim>
  std::vector<unsigned int> LagrangeHypercube<dim>::nodes_on_face(const unsigned int face_no) const
  {
    // Face 2 d + side is where coordinate d is side.
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      if (indices[i][face_no / 2] == degree_ * (face_no % 2))
        nodes.push_back(i);
    return nodes;
  }

  template <int dim>
  std::vector<unsigned int> LagrangeHypercube<dim>::nodes_per_object() const
  {
    std::vector<unsigned int> per_object(dim + 1, degree_ - 1);
    per_object[0] = 1;
    return per_object;
  }

  template <int dim>
  DiscontinuousHypercube<dim>::DiscontinuousHypercube(const unsigned int degree)
    : degree_(degree)
  {
    if (degree > 1)
      throw std::logic_error("discontinuous hypercube functions are of degree 0 or 1");
  }

  template <int dim>
  dealii::Point<dim> DiscontinuousHypercube<dim>::node(unsigned int /*i*/) const
  {
    return reference_centre<dim>(CellKind::hypercube);
  }

  template <int dim>
  double DiscontinuousHypercube<dim>::value(const unsigned int        i,
                                            const dealii::Point<dim> &xi) const
  {
    return i == 0 ? 1. : xi[i - 1] - .5;
  }

  template <int dim>
  dealii::Tensor<1, dim>
  DiscontinuousHypercube<dim>::gradient(const unsigned int i,
                                        const dealii::Point<dim> & /*xi*/) const
  {
    dealii::Tensor<1, dim> gradient;
    if (i > 0)
      gradient[i - 1] = 1.;
    return gradient;
  }

  template <int dim>
  std::vector<unsigned int> DiscontinuousHypercube<dim>::nodes_on_face(unsigned int /*face*/) const
  {
    return {};
  }

  template <int dim>
  std::vector<unsigned int> DiscontinuousHypercube<dim>::nodes_per_object() const
  {
    std::vector<unsigned int> per_object(dim + 1, 0);
    per_object[dim] = n_nodes();
    return per_object;
  }

  template class LagrangeHypercube<2>;
  template class LagrangeHypercube<3>;
  template class DiscontinuousHypercube<2>;
  template class DiscontinuousHypercube<3>;
} // namespace isochor
