// Loads: their totals by hand (body force rho g V, traction t A, at any load factor), and the
// follower pressure: on a closed surface, however deformed, neither force nor moment; on one side
// of a box stretched by F the force -p A cof(F) N (Nanson); derivatives by differences. A single
// pressed side has no potential: its tangent is unsymmetric, that of a closed surface under
// constant pressure is symmetric (value p (V - V_0)).

#include "../common/difference.h"
#include "../common/meshes.h"
#include "../common/report.h"

#include <isochor/form/loads.h>

#include <deal.II/base/symmetric_tensor.h>

using namespace isochor;
using namespace isochor::testing;
namespace MPI = dealii::Utilities::MPI;

namespace
{
  /// Sum over the nodes of the residual and of its moment about the origin, at deformed positions.
  template <int dim>
  struct Resultant
  {
    dealii::Tensor<1, dim> force;
    dealii::Tensor<1, 3>   moment;
  };

  template <int dim>
  Resultant<dim>
  resultant(const Discretisation<dim> &discretisation, const Vector &state, const Vector &residual)
  {
    const auto       &cells = discretisation.cells;
    std::vector<bool> seen(discretisation.n_owned_displacements);
    Resultant<dim>    sum;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        {
          const LocalIndex head = cells.x[cell * cells.n_x + a];
          if (head >= cells.n_owned_unknowns || seen[head])
            continue;
          seen[head]             = true;
          const auto           X = cells.position(cell, discretisation.x_shape.node(a));
          dealii::Tensor<1, 3> x, f;
          for (unsigned int c = 0; c < dim; ++c)
            {
              x[c] = X[c] + state.local_element(head + c);
              f[c] = residual.local_element(head + c);
              sum.force[c] += f[c];
            }
          sum.moment += dealii::cross_product_3d(x, f);
        }
    sum.force  = MPI::sum(sum.force, MPI_COMM_WORLD);
    sum.moment = MPI::sum(sum.moment, MPI_COMM_WORLD);
    return sum;
  }

  /// u = G X at the nodes.
  template <int dim>
  Vector affine(const Discretisation<dim> &discretisation, const dealii::Tensor<2, dim> &G)
  {
    const auto &cells = discretisation.cells;
    Vector      state = discretisation.make_vector();
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int a = 0; a < cells.n_x; ++a)
        {
          const auto u
              = G * dealii::Tensor<1, dim>(cells.position(cell, discretisation.x_shape.node(a)));
          for (unsigned int c = 0; c < dim; ++c)
            state.local_element(cells.x[cell * cells.n_x + a] + c) = u[c];
        }
    state.update_ghost_values();
    return state;
  }

  /// Pressure on all sides, as one term.
  template <int dim>
  class ClosedSurface : public Term
  {
  public:
    ClosedSurface(const Discretisation<dim> &discretisation, const std::string &pressure)
    {
      for (unsigned int id = 0; id < 2 * dim; ++id)
        sides.push_back(std::make_unique<FollowerPressure<dim>>(
            discretisation, id, Expression<dim>(pressure, "test")));
    }
    Evaluation add(const Vector &state, double load, const Target &target) const override
    {
      for (const auto &side : sides)
        side->add(state, load, target);
      return {};
    }

  private:
    std::vector<std::unique_ptr<FollowerPressure<dim>>> sides;
  };

  template <int dim>
  void test(const Mesh<dim> &mesh, const Element &element)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, element);
    SparseMatrix              matrix;
    const CellOffsets         offsets = make_pattern(discretisation, matrix);

    Vector state = random_vector(discretisation.make_vector(), 3);
    state *= 0.05;
    state.update_ghost_values();

    const auto differences = [&](const Term &term) {
      return derivative_errors(term,
                               state,
                               0.5,
                               1e-3,
                               matrix,
                               offsets,
                               discretisation.n_owned_displacements,
                               element.is_mixed());
    };

    // Dead loads.
    dealii::Tensor<1, dim> g;
    g[0] = 1.;
    g[1] = -2.;
    BodyForce<dim>               body(discretisation, 3., g);
    std::vector<Expression<dim>> t;
    t.emplace_back("1 + 2*y", "test"); // mean 2 on the side x = 1
    t.emplace_back("-5*load", "test");
    if (dim == 3)
      t.emplace_back("0", "test");
    TractionLoad<dim> traction(discretisation, mesh.boundary_id("right", ""), t);
    // The same formulas have the same means over the unit box.
    DistributedForce<dim>        distributed(discretisation, t);
    std::vector<Expression<dim>> constant;
    for (unsigned int c = 0; c < dim; ++c)
      constant.emplace_back(std::to_string(3. * g[c]), "test");
    DistributedForce<dim> weight(discretisation, constant);
    const auto            total = [&](const Term &term, const double load) {
      return resultant(discretisation, state, residual(term, state, load)).force;
    };
    double                 dead = 0;
    dealii::Tensor<1, dim> expected;
    for (const double load : {1., 0.5, 0.25})
      {
        raise(dead, (total(body, load) + load * 3. * g).norm());
        expected[0] = -load * 2.;
        expected[1] = load * load * 5.;
        raise(dead, (total(traction, load) - expected).norm());
        raise(dead, (total(distributed, load) - expected).norm());
        // A constant density is a weight.
        Vector difference = residual(body, state, load);
        difference -= residual(weight, state, load);
        raise(dead, difference.linfty_norm());
      }
    // A linear traction's moment about the edge of the side: int (1 + 2 y) y dy = 7/6.
    const Vector at_rest = discretisation.make_vector();
    const auto   moment
        = resultant(discretisation, at_rest, residual(traction, at_rest, 0.)).moment.norm()
          + std::abs(resultant(discretisation, at_rest, residual(traction, at_rest, 1.)).moment[2]
                     - (7. / 6. + 5.));
    const auto dead_errors = differences(body);

    // Follower pressure on one side of a stretched and sheared box.
    const FollowerPressure<dim> side(
        discretisation, mesh.boundary_id("right", ""), Expression<dim>("4", "test"));
    dealii::Tensor<2, dim> G;
    G[0][0]                = 0.4;
    G[0][1]                = 0.3;
    G[1][1]                = -0.2;
    G[dim - 1][0]          = 0.15;
    const auto F           = G + dealii::unit_symmetric_tensor<dim>();
    const auto cofactor    = dealii::determinant(F) * dealii::transpose(dealii::invert(F));
    const auto nanson      = 0.5 * 4. * (cofactor * dealii::Point<dim>::unit_vector(0));
    const auto stretched   = affine(discretisation, G);
    const auto side_force  = resultant(discretisation, stretched, residual(side, stretched, 0.5));
    const auto side_errors = differences(side);

    const ClosedSurface<dim> closed(discretisation, "4");
    const Vector             pressed       = residual(closed, state, 0.5);
    const auto               net           = resultant(discretisation, state, pressed);
    const auto               closed_errors = differences(closed);
    const ClosedSurface<dim> varying(discretisation, "1 + x + 0.5*y*load");
    const auto               varying_errors = differences(varying);

    out() << element.name << " in " << dim << "D: dead loads " << below(dead, 1e-13) << ", moment "
          << below(moment, 1e-13) << ", as differences of the work "
          << below(dead_errors.residual, 1e-11) << "\n  pressure on a side: force "
          << below((side_force.force - nanson).norm(), 1e-13) << ", tangent "
          << below(side_errors.tangent, 1e-11)
          << ", unsymmetric: " << yes(side_errors.asymmetry > 1e-3)
          << "\n  on all sides: net force " << below(net.force.norm() / pressed.l2_norm(), 1e-13)
          << ", moment " << below(net.moment.norm() / pressed.l2_norm(), 1e-13) << ", tangent "
          << below(closed_errors.tangent, 1e-11) << ", asymmetry "
          << below(closed_errors.asymmetry, 1e-13) << "; not constant: tangent "
          << below(varying_errors.tangent, 1e-11)
          << ", unsymmetric: " << yes(varying_errors.asymmetry > 1e-3) << '\n';
  }

  template <int dim>
  void test()
  {
    const auto mesh = distorted_box<dim>(2);
    for (const std::string name : {"P1", "P2", "P3", "P2-P1"})
      test(*mesh, find_element(name, ""));
  }
} // namespace

int main(int argc, char **argv)
{
  const MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>();
  test<3>();
}
