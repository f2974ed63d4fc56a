// A homogeneous deformation x = F X on every element, in 2D (plane strain) and 3D: displacement,
// J, pressure and von Mises stress at vertices, midpoints and other points of each cell, against
//   neo-Hookean (32)  sigma = mu / J (b - I) + q Phi' I          b = F F^T
//   Bonet-Wood (30)   sigma = mu J^(-5/3) dev b + q Phi' I
// with q = kappa Phi(J) for displacement elements and a linear field p(X) for mixed ones. The von
// Mises stress of these is computed from the six components, which CellFields does not do.
// Printed are the largest relative errors: all zero but for rounding.

#include "../common/fields.h"

#include <isochor/element/element_table.h>
#include <isochor/measure/cell_fields.h>
#include <isochor/mesh/mesh.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>
#include <limits>

using namespace isochor;

namespace
{
  template <int dim>
  dealii::Tensor<2, 3> deformation_gradient()
  {
    dealii::Tensor<2, 3> F;
    F[0] = dealii::Tensor<1, 3>({1.3, 0.4, dim == 3 ? -0.2 : 0.});
    F[1] = dealii::Tensor<1, 3>({-0.1, 0.9, dim == 3 ? 0.3 : 0.});
    F[2] = dealii::Tensor<1, 3>({dim == 3 ? 0.15 : 0., 0., dim == 3 ? 1.1 : 1.});
    return F;
  }

  /// Any linear field of the reference position, Pa.
  template <int dim>
  double pressure_field(const dealii::Point<dim> &X)
  {
    double p = 5e5;
    for (unsigned int d = 0; d < dim; ++d)
      p += (d + 1) * 1e5 * X[d];
    return p;
  }

  double von_mises(const dealii::Tensor<2, 3> &s)
  {
    return std::sqrt(0.5
                         * (std::pow(s[0][0] - s[1][1], 2) + std::pow(s[1][1] - s[2][2], 2)
                            + std::pow(s[2][2] - s[0][0], 2))
                     + 3 * (std::pow(s[0][1], 2) + std::pow(s[1][2], 2) + std::pow(s[2][0], 2)));
  }

  /// A NaN is an infinite error.
  void keep_larger(double &worst, const double error)
  {
    worst = error <= worst  ? worst
            : error > worst ? error
                            : std::numeric_limits<double>::infinity();
  }

  struct Errors
  {
    double displacement = 0, pressure = 0, J = 0, von_mises = 0;
  };

  template <int dim>
  Errors errors(const Mesh<dim> &mesh, const Element &element, const Material &material)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    const auto               &cells = discretisation.cells;
    const auto                F     = deformation_gradient<dim>();
    const double              J     = determinant(F);

    const auto displacement_field = [&](const dealii::Point<dim> &X) {
      dealii::Tensor<1, dim> u;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int K = 0; K < dim; ++K)
          u[i] += (F[i][K] - (i == K ? 1 : 0)) * X[K];
      return u;
    };

    Vector state = discretisation.make_vector();
    testing::interpolate(discretisation, displacement_field, pressure_field<dim>, state);

    const Moduli m   = moduli(material);
    const double phi = material.volumetric_strain == VolumetricStrain::linear ? J - 1 : std::log(J);
    dealii::Tensor<2, 3> sigma = F * transpose(F);
    sigma *= material.energy == Energy::neo_hookean ? m.mu / J : m.mu * std::pow(J, -5. / 3);

    // Eleven points: more than a batch, and not a multiple of eight.
    std::vector<dealii::Point<dim>> reference_points;
    const auto quadratic = make_shape_functions<dim>(element.kind, {Family::lagrange, 2});
    for (unsigned int i = 0; i < quadratic->n_nodes(); ++i)
      reference_points.push_back(quadratic->node(i));
    while (reference_points.size() < 11)
      reference_points.push_back(0.6 * reference_points[reference_points.size() / 2]
                                 + (0.4 / (dim + 1)) * dealii::Point<dim>::unit_vector(0));

    const CellFields<dim>         fields(discretisation, material);
    const auto                    points = fields.tabulate(reference_points);
    std::vector<PointFields<dim>> at;
    Errors                        worst;
    for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
      {
        fields.evaluate(cell, points, state.begin(), at);
        for (unsigned int q = 0; q < reference_points.size(); ++q)
          {
            const auto X = cells.position(cell, reference_points[q]);
            // A constant pressure knows the middle of its cell.
            const auto   centre = cells.position(cell, discretisation.p_shape.node(0));
            const double field  = pressure_field(discretisation.p_shape.degree() == 0 ? centre : X);
            const double p      = element.is_mixed() ? field : m.kappa * phi;
            keep_larger(worst.displacement, (at[q].displacement - displacement_field(X)).norm());
            keep_larger(worst.pressure, std::abs(at[q].pressure - p) / std::abs(p));
            keep_larger(worst.J, std::abs(at[q].J - J));
            keep_larger(worst.von_mises,
                        std::abs(at[q].von_mises - von_mises(sigma)) / von_mises(sigma));
          }
      }
    for (double *const error : {&worst.displacement, &worst.pressure, &worst.J, &worst.von_mises})
      *error = dealii::Utilities::MPI::max(*error, MPI_COMM_WORLD);
    return worst;
  }

  template <int dim>
  void test(const std::string &source)
  {
    MeshRequest request;
    request.source  = source;
    request.size    = 0.5;
    request.split   = dim == 2 ? Split::right_diagonal : Split::six_tets;
    const bool root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

    for (const Element &element : element_table())
      {
        request.kind    = element.kind;
        const auto mesh = make_mesh<dim>(request, MPI_COMM_WORLD);
        for (const Energy energy : {Energy::neo_hookean, Energy::bonet_wood})
          for (const VolumetricStrain strain :
               {VolumetricStrain::linear, VolumetricStrain::logarithmic})
            {
              Material material;
              material.energy            = energy;
              material.volumetric_strain = strain;
              const Errors e             = errors(*mesh, element, material);
              if (root)
                std::cout << dim << "D " << element.name << ", " << energy_names.name(energy)
                          << ", " << volumetric_strain_names.name(strain) << ": " << e.displacement
                          << ' ' << e.pressure << ' ' << e.J << ' ' << e.von_mises << '\n';
            }
      }
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>("rectangle(1, 1)");
  test<3>("box(1, 1, 1)");
}
