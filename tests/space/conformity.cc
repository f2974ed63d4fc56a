// Continuity of P1, P2, P3 across cells and ranks: each cell writes the values that a polynomial of
// the element's degree has at its nodes; all cells around a node must write the same, a value that
// comes from another rank must be what is written here, and inside the cells the polynomial must
// come back. Then the L2 error of interpolating a smooth function, on meshes made anew at each
// size: degree + 1 orders. (Vertices on the boundary are not moved, so coarse meshes are a little
// less distorted and the order comes from below: 2.95, 2.97, 2.99 for P2 in 3D from 6, 9, 12 blocks.)

#include "../common/meshes.h"
#include "../common/report.h"

#include <isochor/element/cell_quadrature.h>
#include <isochor/space/discretisation.h>

#include <functional>

using namespace isochor;
using namespace isochor::testing;
namespace MPI = dealii::Utilities::MPI;

namespace
{
  template <int dim>
  using Function = std::function<double(const dealii::Point<dim> &)>;

  template <int dim>
  struct Interpolant
  {
    Vector values;          ///< by owners
    double disagreement[2]; ///< within this rank's cells; with other ranks
  };

  /// Component c is (c + 1) f.
  template <int dim>
  Interpolant<dim> interpolate(const Discretisation<dim> &discretisation, const Function<dim> &f)
  {
    const auto      &cells  = discretisation.cells;
    Vector           vector = discretisation.make_vector();
    std::vector<int> written(vector.locally_owned_size()
                             + discretisation.partitioner->n_ghost_indices());
    Interpolant<dim> result{vector, {0., 0.}};
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        for (unsigned int c = 0; c < dim; ++c)
          {
            const LocalIndex i = cells.x[cell * cells.n_x + a] + c;
            const double value = (c + 1) * f(cells.position(cell, discretisation.x_shape.node(a)));
            if (written[i])
              raise(result.disagreement[0], std::abs(value - vector.local_element(i)));
            written[i]              = true;
            vector.local_element(i) = value;
          }
    for (LocalIndex i = 0; i < discretisation.n_owned_displacements; ++i)
      if (!written[i])
        result.disagreement[0] = 1e300;

    result.values = vector;
    result.values.update_ghost_values();
    for (std::size_t i = 0; i < written.size(); ++i)
      if (written[i])
        raise(result.disagreement[1],
              std::abs(result.values.local_element(i) - vector.local_element(i)));
    return result;
  }

  /// Largest and L2 error inside the cells.
  template <int dim>
  std::array<double, 2>
  errors(const Discretisation<dim> &discretisation, const Vector &values, const Function<dim> &f)
  {
    const auto                      &cells      = discretisation.cells;
    const auto                       quadrature = cell_quadrature<dim>(CellKind::simplex, 8);
    std::vector<std::vector<double>> shape(quadrature.size());
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        shape[q].push_back(discretisation.x_shape.value(a, quadrature.point(q)));

    double largest = 0, squared = 0;
    for (std::size_t cell = 0; cell < cells.n_owned; ++cell)
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const double exact = f(cells.position(cell, quadrature.point(q)));
          for (unsigned int c = 0; c < dim; ++c)
            {
              double value = 0;
              for (unsigned int a = 0; a < cells.n_x; ++a)
                value += shape[q][a] * values.local_element(cells.x[cell * cells.n_x + a] + c);
              raise(largest, std::abs(value - (c + 1) * exact));
              if (c == 0)
                squared
                    += std::pow(value - exact, 2) * quadrature.weight(q) * cells.determinant[cell];
            }
        }
    return {{MPI::max(largest, MPI_COMM_WORLD), std::sqrt(MPI::sum(squared, MPI_COMM_WORLD))}};
  }

  template <int dim>
  double polynomial(const dealii::Point<dim> &x, const unsigned int degree)
  {
    double sum = 0.4, product = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        sum += (0.8 - 0.7 * d) * x[d];
        product *= d < degree ? x[d] - 0.3 : 1.;
      }
    return std::pow(sum, degree) + product;
  }

  template <int dim>
  void test(const std::string &title, const Mesh<dim> &mesh)
  {
    for (const std::string name : {"P1", "P2", "P3"})
      {
        const Discretisation<dim> discretisation(mesh.triangulation, find_element(name, ""));
        const Function<dim>       f = [&](const dealii::Point<dim> &x) {
          return polynomial(x, discretisation.element.displacement.degree);
        };
        const auto interpolant = interpolate(discretisation, f);
        double     jacobian = 0, volume = 0;
        for (std::size_t cell = 0; cell < discretisation.cells.n_cells; ++cell)
          {
            const double det = discretisation.cells.determinant[cell];
            volume += cell < discretisation.cells.n_owned ? det / (dim == 2 ? 2 : 6) : 0.;
            dealii::Tensor<2, dim> inverse;
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int d = 0; d < dim; ++d)
                inverse[k][d] = discretisation.cells.inverse(cell)[k * dim + d];
            // N_(k + 1) = xi_k falls from 1 at its vertex to 0 at the first.
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int v = 1; v <= dim; ++v)
                {
                  const auto *vertex = &discretisation.cells.geometry[cell * (dim + 1)];
                  raise(jacobian,
                        std::abs(inverse[k] * (vertex[v] - vertex[0]) - (v == k + 1 ? 1. : 0.)));
                }
            raise(jacobian, std::abs(det * dealii::determinant(inverse) - 1.));
          }
        out() << name << ", " << title << ": cells disagree "
              << below(MPI::max(interpolant.disagreement[0], MPI_COMM_WORLD), 1e-13)
              << ", ranks disagree "
              << below(MPI::max(interpolant.disagreement[1], MPI_COMM_WORLD), 1e-13)
              << ", error inside " << below(errors(discretisation, interpolant.values, f)[0], 1e-12)
              << ", geometry " << below(MPI::max(jacobian, MPI_COMM_WORLD), 1e-12) << ", volume "
              << MPI::sum(volume, MPI_COMM_WORLD) << '\n';
      }
  }

  template <int dim>
  void rates(const unsigned int n)
  {
    const Function<dim> f = [](const dealii::Point<dim> &x) {
      return std::sin(2. * x[0] + 1.3 * x[1] - 0.8 * x[dim - 1]) + std::exp(x[0] * x[dim - 1]);
    };
    const auto coarse = distorted_box<dim>(n), fine = distorted_box<dim>(2 * n);
    for (const std::string name : {"P1", "P2", "P3"})
      {
        const auto error = [&](const Mesh<dim> &mesh) {
          const Discretisation<dim> discretisation(mesh.triangulation, find_element(name, ""));
          return errors(discretisation, interpolate(discretisation, f).values, f)[1];
        };
        out() << name << " in " << dim << "D: L2 order of interpolation "
              << one_decimal(std::log2(error(*coarse) / error(*fine))) << '\n';
      }
  }
} // namespace

int main(int argc, char **argv)
{
  const MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>("distorted square", *distorted_box<2>(5));
  test<2>("square by gmsh", *gmsh_box<2>(0.2));
  test<3>("distorted cube", *distorted_box<3>(4));
  test<3>("cube by gmsh", *gmsh_box<3>(0.3));
  rates<2>(12);
  rates<3>(9);
}
