#include <isochor/element/bubble_simplex.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    template <int dim>
    double peak()
    {
      return std::pow(dim + 1., dim + 1.);
    }
  } // namespace

  template <int dim>
  dealii::Point<dim> BubbleSimplex<dim>::node(const unsigned int i) const
  {
    return i <= dim ? linear.node(i) : reference_centre<dim>(CellKind::simplex);
  }

  template <int dim>
  double BubbleSimplex<dim>::value(const unsigned int i, const dealii::Point<dim> &xi) const
  {
    if (i <= dim)
      return linear.value(i, xi);
    double product = peak<dim>();
    for (const double lambda : barycentric(xi))
      product *= lambda;
    return product;
  }

  template <int dim>
  dealii::Tensor<1, dim> BubbleSimplex<dim>::gradient(const unsigned int        i,
                                                      const dealii::Point<dim> &xi) const
  {
    if (i <= dim)
      return linear.gradient(i, xi);
    const auto             lambda = barycentric(xi);
    dealii::Tensor<1, dim> gradient;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        double others = peak<dim>();
        for (unsigned int w = 0; w <= dim; ++w)
          if (w != v)
            others *= lambda[w];
        gradient += others * linear.gradient(v, xi);
      }
    return gradient;
  }

  template <int dim>
  std::vector<unsigned int> BubbleSimplex<dim>::nodes_on_face(const unsigned int face_no) const
  {
    return linear.nodes_on_face(face_no);
  }

  template <int dim>
  std::vector<unsigned int> BubbleSimplex<dim>::nodes_per_object() const
  {
    std::vector<unsigned int> per_object = linear.nodes_per_object();
    per_object[dim]                      = 1;
    return per_object;
  }

  template class BubbleSimplex<2>;
  template class BubbleSimplex<3>;
} // namespace isochor
