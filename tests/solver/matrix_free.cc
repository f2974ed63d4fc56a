// Without a matrix: force differentials are the assembled tangent's product, every element, with the
// unsymmetric tangent of a follower pressure; conjugate residuals and conjugate gradients end in the
// state that factors end in; and each says so where it breaks down.

#include "../common/meshes.h"
#include "../common/solve.h"
#include "../common/supports.h"

#include <isochor/form/loads.h>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  template <int dim>
  Scene<dim> pressed(const double poisson_ratio)
  {
    Scene<dim> scene;
    scene.material.youngs_modulus = 3.;
    scene.material.poisson_ratio  = poisson_ratio;
    scene.supports.push_back(held<dim>("left", all_components<dim>));
    scene.pressures.push_back({"right", Expression<dim>("0.2 + 0.1*y", "test")});
    return scene;
  }

  Vector random_vector(const Vector &like, const double size, const unsigned int seed)
  {
    // By global index: the same on any number of ranks.
    Vector v(like.get_partitioner());
    for (LocalIndex i = 0; i < v.locally_owned_size(); ++i)
      {
        std::mt19937 random(seed + v.get_partitioner()->local_to_global(i));
        v.local_element(i) = std::uniform_real_distribution<double>(-size, size)(random);
      }
    return v;
  }

  template <int dim>
  Equilibrium<dim>
  make_equilibrium(const Mesh<dim> &mesh, const Discretisation<dim> &d, const Scene<dim> &scene)
  {
    return Equilibrium<dim>(d, scene, [&](const std::string &name, const std::string &what) {
      return mesh.boundary_id(name, what);
    });
  }

  template <int dim>
  void products()
  {
    const unsigned int        n = dim == 2 ? 4 : 2;
    const DistortedBoxes<dim> meshes(n);
    double                    largest = 0;
    for (const Element &element : element_table())
      {
        const Mesh<dim>          &mesh = meshes[element.kind];
        const Discretisation<dim> discretisation(mesh.triangulation, element);
        const auto   equilibrium = make_equilibrium(mesh, discretisation, pressed<dim>(0.49));
        const auto   state       = random_vector(discretisation.make_vector(), 0.02 / n, 1);
        const auto   direction   = random_vector(state, 1., 2);
        SparseMatrix matrix      = equilibrium.make_matrix();
        state.update_ghost_values();
        equilibrium.tangent(state, 1., matrix);
        Vector exact(state.get_partitioner()), product(exact);
        matrix.vmult(exact, direction);
        equilibrium.tangent_product(state, 1., direction, product);
        product -= exact;
        raise(largest, product.linfty_norm() / exact.linfty_norm());
      }
    out() << dim << "D, " << element_table().size() << " elements: product less matrix "
          << below(largest, 1e-12) << '\n';
  }

  template <int dim>
  void states()
  {
    const DistortedBoxes<dim> meshes(dim == 2 ? 4 : 2);
    for (const auto &[name, nu] : {std::pair("P1", 0.3),
                                   std::pair("P1-P1", 0.49),
                                   std::pair("P1-P1s", 0.5),
                                   std::pair("P2-P1", 0.5),
                                   std::pair("Q2-P1", 0.49)})
      {
        const Element            &element = find_element(name, "");
        const Mesh<dim>          &mesh    = meshes[element.kind];
        const Discretisation<dim> discretisation(mesh.triangulation, element);
        Scene<dim>                scene = pressed<dim>(nu);
        scene.pressures.clear();
        scene.gravity[1]       = -0.2;
        scene.material.density = 1.;
        scene.supports.push_back(
            held<dim>("right", "x", [](const dealii::Point<dim> &, const double load) {
              dealii::Tensor<1, dim> u;
              u[0] = 0.1 * load;
              return u;
            }));
        SolveOptions options;
        options.tolerance = 1e-10;
        const auto direct = solve(mesh, discretisation, scene, options);
        out() << "  " << name << " in " << dim << "D, nu = " << nu << ':';
        for (const auto solver : {LinearSolver::cr, LinearSolver::cg})
          {
            options.linear.solver = solver;
            const auto free       = solve(mesh, discretisation, scene, options);
            Vector     apart(free.state.get_partitioner());
            apart = free.state;
            apart -= direct.state;
            out() << ' ' << linear_solver_names.name(solver) << ' '
                  << run_status_names.name(free.report.status) << free.report.reason
                  << ", states apart "
                  << below(apart.linfty_norm() / direct.state.linfty_norm(), 1e-6);
          }
        out() << '\n';
      }
  }

  /// Neither method is for the unsymmetric tangent of a follower pressure, and they say so.
  void follower_pressure()
  {
    const auto              mesh = distorted_box<3>(2);
    const Discretisation<3> discretisation(mesh->triangulation, find_element("P1-P1", ""));
    SolveOptions            options;
    options.tolerance     = 1e-10;
    options.minimum_step  = 0.6;
    options.linear.solver = LinearSolver::cg;
    const auto solution   = solve(*mesh, discretisation, pressed<3>(0.49), options);
    const auto reason     = solution.report.reason;
    out() << "follower pressure: " << run_status_names.name(solution.report.status)
          << ", and says why: " << yes(reason.find("is not symmetric") != std::string::npos)
          << '\n';
  }

  /// diag(1, -1, 1, -1, ...) and b = (1, 1, ...): b . A b = 0 stops both methods at once.
  void breakdown()
  {
    const auto              mesh = distorted_box<2>(2);
    const Discretisation<2> discretisation(mesh->triangulation, find_element("P1", ""));
    Vector                  b = discretisation.make_vector(), x(b);
    for (LocalIndex i = 0; i < b.locally_owned_size(); ++i)
      b.local_element(i) = 1.;
    const auto product = [](Vector &dst, const Vector &src) {
      for (LocalIndex i = 0; i < src.locally_owned_size(); ++i)
        dst.local_element(i) = (i % 2 == 0 ? 1. : -1.) * src.local_element(i);
    };
    for (const auto method : {KrylovMethod::conjugate_residuals, KrylovMethod::conjugate_gradients})
      out() << symmetric_krylov(method, product, x, b, 1e-8, 100).failure << '\n';
  }
} // namespace

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  products<2>();
  products<3>();
  states<2>();
  states<3>();
  follower_pressure();
  breakdown();
}
