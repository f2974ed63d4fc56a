// Every key of a scene, read and printed; displacements of supports against closed forms
// (the rotation against the matrix of Rodrigues' formula written out for the axis z, and for
// any axis by what makes a rotation: lengths and the axis stay, the angle is the one asked for).

#include <isochor/core/parameters.h>
#include <isochor/scene/scene.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <fstream>
#include <iostream>

using namespace isochor;

namespace
{
  template <int dim>
  Scene<dim> parse(const std::string &settings)
  {
    dealii::ParameterHandler prm;
    Scene<dim>::declare(prm);
    std::ofstream("test_scene.prm") << "subsection Scene\nset Dimension = " << dim << '\n'
                                    << settings << "end\n";
    read_parameter_file(prm, "test_scene.prm");
    return Scene<dim>::parse(prm, "/folder/prm");
  }

  template <int dim>
  void print(const Scene<dim> &scene)
  {
    std::cout << "mesh '" << scene.mesh.source << "', size " << scene.mesh.size << ", cells";
    for (const unsigned int n : scene.mesh.cells)
      std::cout << ' ' << n;
    std::cout << ", split " << split_names.name(scene.mesh.split) << '\n'
              << "E " << scene.material.youngs_modulus << ", nu " << scene.material.poisson_ratio
              << ", density " << scene.material.density << ", "
              << energy_names.name(scene.material.energy) << ", "
              << volumetric_strain_names.name(scene.material.volumetric_strain) << ", "
              << kappa_convention_names.name(scene.material.kappa) << ", ratio "
              << scene.material.mooney_rivlin_ratio << '\n'
              << "gravity " << scene.gravity << '\n';
    dealii::Point<dim> X;
    for (unsigned int d = 0; d < dim; ++d)
      X[d] = d + 1.;
    for (const Support<dim> &support : scene.supports)
      {
        std::cout << "support " << support.boundary << " (" << support.origin << "):";
        for (unsigned int d = 0; d < dim; ++d)
          std::cout << (support.components[d] ? " held" : " free");
        std::cout << (support.moves ? ", moves" : ", rests")
                  << ", at load 0.5: " << support.displacement(X, 0.5) << '\n';
      }
    for (const auto &component : scene.body_force)
      std::cout << "body force [" << component.text() << "] " << component.value(X, 0.5) << '\n';
    for (const Traction<dim> &traction : scene.tractions)
      {
        std::cout << "traction " << traction.boundary << ":";
        for (const auto &component : traction.components)
          std::cout << " [" << component.text() << "] " << component.value(X, 0.5);
        std::cout << '\n';
      }
    for (const Pressure<dim> &pressure : scene.pressures)
      std::cout << "pressure " << pressure.boundary << ": [" << pressure.value.text() << "] "
                << pressure.value.value(X, 0.5) << '\n';
    for (const ProbeRequest<dim> &probe : scene.probes)
      {
        std::cout << "probe " << probe.name << ": kind " << static_cast<int>(probe.kind);
        if (!probe.boundary.empty())
          std::cout << ", boundary " << probe.boundary;
        if (probe.point)
          std::cout << ", point " << *probe.point;
        if (probe.component)
          std::cout << ", component " << *probe.component;
        for (const auto &exact : probe.exact)
          std::cout << ", [" << exact.text() << "] " << exact.value(X, 0.5);
        if (probe.without_mean)
          std::cout << ", without mean";
        std::cout << '\n';
      }
    for (const auto &[boundary, origin] : boundary_references(scene))
      std::cout << "names " << boundary << ": " << origin << '\n';
  }

  void check(const std::string &title, const double error)
  {
    std::cout << title << ": " << (error < 1e-14 ? "exact" : "WRONG by " + std::to_string(error))
              << '\n';
  }

  void expressions()
  {
    const double           pi = dealii::numbers::PI;
    const dealii::Point<3> X(0.3, -0.7, 1.1);
    const Expression<3>    formula("sin(pi*x)*exp (y) + load*z^2 + max(x, y)", "test");
    const Expression<3>    copy = formula;
    check("formula",
          std::abs(copy.value(X, 0.25)
                   - (std::sin(pi * 0.3) * std::exp(-0.7) + 0.25 * 1.1 * 1.1 + 0.3)));
    const Expression<2> planar("x*y*load", "test");
    check("in 2D", std::abs(planar.value({2., 3.}, 0.5) - 3.));
    const Expression<3> number(" 6.25e6 ", "test");
    check("plain number",
          std::abs(number.value(X, 0.) - 6.25e6) + std::abs(*number.constant() - 6.25e6));
    std::cout << "depends on load: " << formula.depends_on_load() << number.depends_on_load()
              << Expression<3>("2*x", "").depends_on_load()
              << ", is constant: " << formula.constant().has_value()
              << number.constant().has_value() << '\n';
  }

  void rotations()
  {
    const double pi = dealii::numbers::PI;
    {
      const auto support = parse<3>("set Mesh = box(1,1,1)\nset Prescribed rotation = right: 90 "
                                    "about 1, 2, 3 axis 0, 0, 4\n")
                               .supports.at(0);
      const dealii::Point<3>     X(1.5, 2.25, -1.);
      const double               a = 0.4 * pi / 2.;
      const dealii::Tensor<1, 3> exact({std::cos(a) * 0.5 - std::sin(a) * 0.25 - 0.5,
                                        std::sin(a) * 0.5 + std::cos(a) * 0.25 - 0.25,
                                        0.});
      check("rotation about z", (support.displacement(X, 0.4) - exact).norm());
      check("no load, no rotation", support.displacement(X, 0.).norm());
    }
    {
      const auto support
          = parse<2>("set Mesh = rectangle(1,1)\nset Prescribed rotation = right: 90 about 1, 0\n")
                .supports.at(0);
      // (2, 0) turns counterclockwise about (1, 0) to (1, 1)
      check("quarter turn in 2D",
            (support.displacement({2., 0.}, 1.) - dealii::Tensor<1, 2>({-1., 1.})).norm());
    }
    {
      const auto support = parse<3>("set Mesh = box(1,1,1)\nset Prescribed rotation = right: -70 "
                                    "about 0.1, 0.2, 0.3 axis 1, -2, 0.5\n")
                               .supports.at(0);
      const dealii::Point<3> c(0.1, 0.2, 0.3), X(1., 1., 1.);
      dealii::Tensor<1, 3>   axis({1., -2., 0.5});
      axis /= axis.norm();
      const dealii::Tensor<1, 3> r = X - c, turned = r + support.displacement(X, 1.);
      const auto across = r - (r * axis) * axis, across_turned = turned - (turned * axis) * axis;
      check("any axis: length", std::abs(turned.norm() - r.norm()));
      check("any axis: along it", std::abs(turned * axis - r * axis));
      check("any axis: angle",
            std::abs(
                std::atan2(cross_product_3d(across, across_turned) * axis, across * across_turned)
                + 70. * pi / 180.));
      check("any axis: points on it rest", support.displacement(c + 3. * axis, 1.).norm());
      const double small = 1e-9;
      check("small load: linear in it",
            (support.displacement(X, small) / small + 70. * pi / 180. * cross_product_3d(axis, r))
                    .norm()
                / 1e8);
    }
  }
} // namespace

int main()
{
  std::cout << "defaults\n";
  print(parse<3>("set Mesh = ../meshes/cantilever.geo\n"));

  std::cout << "3D\n";
  print(parse<3>("set Mesh = box(1, 0.1, 0.1)\nset Mesh size = 0.05\nset Cells = 30, 3, 3\n"
                 "set Split = 5-tet\nset Young's modulus = 266e3\nset Poisson ratio = 0.4999\n"
                 "set Density = 1070\nset Energy = Bonet-Wood\nset Volumetric strain = log J\n"
                 "set Volumetric modulus = K\nset Fixed = left, the wall; floor\n"
                 "set Fixed components = bottom: y; back: x, z\n"
                 "set Prescribed displacement = right: 0.1*load, max(x, y), - ; top: -, 0, -\n"
                 "set Prescribed rotation = front: 180 about 0, 0, 0 axis 1, 0, 0;\n"
                 "set Gravity = 0, -9.8, 0\nset Body force = 1e3, max(x, y)*load, -z\n"
                 "set Traction = a: 0, 6.25e6, x*load; b: 1, 2, 3\n"
                 "set Pressure = inner: 10e3; outer: atan2(y, x)\n"
                 "set Probes = tip: mean displacement on right; top: mean  displacement y on top; "
                 "d: displacement at 1, 0.05, 0.05; m: max displacement magnitude; "
                 "lo: min displacement z on right; v: volume; c: cavity volume in inner; "
                 "r: reaction on left; rx: reaction x on the wall; e: displacement y at 0,0,0; "
                 "l: displacement L2 error against x, max(y, z), load; "
                 "h: displacement H1 error against 0, x*y, 0; "
                 "p: pressure L2 error against load*x; "
                 "q: pressure L2 error without mean against max(x, y)\n"));

  std::cout << "2D\n";
  print(parse<2>("set Mesh = /meshes/./plate.msh\nset Gravity = 0, -9.8\nset Cells = 4, 5\n"
                 "set Fixed components = bottom: y\nset Prescribed displacement = top: -, 1e-3\n"
                 "set Prescribed rotation = right: 0 about 0, 0\nset Traction = right: 0, 1\n"
                 "set Probes = p: displacement at 1, 2; m: min displacement magnitude on top\n"));

  std::cout << "volumetric strain that goes with the energy\n";
  for (const std::string &energy : energy_names.names())
    for (const std::string strain : {"automatic", "log J"})
      {
        const Material material
            = parse<3>("set Mesh = a.msh\nset Mooney-Rivlin ratio = 0.2\nset Energy = " + energy
                       + "\nset Volumetric strain = " + strain + "\n")
                  .material;
        std::cout << energy_names.name(material.energy) << ", " << strain << ": "
                  << volumetric_strain_names.name(material.volumetric_strain) << ", ratio "
                  << material.mooney_rivlin_ratio << '\n';
      }

  std::cout << "expressions\n";
  expressions();
  std::cout << "rotations\n";
  rotations();
}
