#include <isochor/element/lagrange_simplex.h>

#include <stdexcept>

namespace isochor
{
  template <int dim>
  std::array<double, dim + 1> barycentric(const dealii::Point<dim> &xi)
  {
    std::array<double, dim + 1> lambda;
    lambda[0] = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lambda[d + 1] = xi[d];
        lambda[0] -= xi[d];
      }
    return lambda;
  }

  template <int dim>
  LagrangeSimplex<dim>::LagrangeSimplex(const unsigned int degree)
    : degree_(degree)
  {
    if (degree > 3)
      throw std::logic_error("Lagrange simplices are implemented up to degree 3");

    if (degree == 0)
      {
        indices.push_back({});
        return;
      }

    for (unsigned int v = 0; v <= dim; ++v)
      {
        MultiIndex vertex{};
        vertex[v] = degree;
        indices.push_back(vertex);
      }

    if (degree >= 2)
      for (const auto &ends : reference_edges<dim>(CellKind::simplex))
        {
          for (unsigned int n = 1; n < degree; ++n)
            {
              MultiIndex inner{};
              inner[ends[0]] = degree - n;
              inner[ends[1]] = n;
              indices.push_back(inner);
            }
          if (degree == 3)
            cubic_edges.push_back({ends, {{n_nodes() - 2, n_nodes() - 1}}});
        }

    if (degree == 3 && dim == 3)
      for (const auto &face : reference_faces<dim>(CellKind::simplex))
        {
          MultiIndex inner{};
          for (const unsigned int v : face)
            inner[v] = 1;
          indices.push_back(inner);
        }
    else if (degree == 3 && dim == 2)
      {
        MultiIndex inner;
        inner.fill(1);
        indices.push_back(inner);
      }
  }

  template <int dim>
  dealii::Point<dim> LagrangeSimplex<dim>::node(const unsigned int i) const
  {
    if (degree_ == 0)
      return reference_centre<dim>(CellKind::simplex);
    dealii::Point<dim> xi;
    for (unsigned int d = 0; d < dim; ++d)
      xi[d] = double(indices[i][d + 1]) / degree_;
    return xi;
  }

  template <int dim>
  double LagrangeSimplex<dim>::value(const unsigned int i, const dealii::Point<dim> &xi) const
  {
    const auto lambda  = barycentric(xi);
    double     product = 1.;
    for (unsigned int v = 0; v <= dim; ++v)
      for (unsigned int m = 0; m < indices[i][v]; ++m)
        product *= (degree_ * lambda[v] - m) / (m + 1.);
    return product;
  }

  template <int dim>
  dealii::Tensor<1, dim> LagrangeSimplex<dim>::gradient(const unsigned int        i,
                                                        const dealii::Point<dim> &xi) const
  {
    const auto                  lambda = barycentric(xi);
    std::array<double, dim + 1> factor, slope;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        factor[v] = 1.;
        slope[v]  = 0.;
        for (unsigned int m = 0; m < indices[i][v]; ++m)
          {
            const double term = (degree_ * lambda[v] - m) / (m + 1.);
            slope[v]          = slope[v] * term + factor[v] * degree_ / (m + 1.);
            factor[v] *= term;
          }
      }

    std::array<double, dim + 1> by_lambda;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        by_lambda[v] = slope[v];
        for (unsigned int w = 0; w <= dim; ++w)
          if (w != v)
            by_lambda[v] *= factor[w];
      }

    dealii::Tensor<1, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
      gradient[d] = by_lambda[d + 1] - by_lambda[0];
    return gradient;
  }

  template <int dim>
  std::vector<unsigned int> LagrangeSimplex<dim>::nodes_on_face(const unsigned int face_no) const
  {
    std::vector<unsigned int> nodes;
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        unsigned int on_face = 0;
        for (const unsigned int v : reference_faces<dim>(CellKind::simplex)[face_no])
          on_face += indices[i][v];
        if (degree_ > 0 && on_face == degree_)
          nodes.push_back(i);
      }
    return nodes;
  }

  template <int dim>
  std::vector<unsigned int> LagrangeSimplex<dim>::nodes_per_object() const
  {
    std::vector<unsigned int> per_object(dim + 1, 0);
    if (degree_ == 0)
      per_object[dim] = 1;
    else
      {
        per_object[0] = 1;
        per_object[1] = degree_ - 1;
        per_object[2] = degree_ == 3 ? 1 : 0;
      }
    return per_object;
  }

  template class LagrangeSimplex<2>;
  template class LagrangeSimplex<3>;
  template std::array<double, 3> barycentric(const dealii::Point<2> &);
  template std::array<double, 4> barycentric(const dealii::Point<3> &);
} // namespace isochor
