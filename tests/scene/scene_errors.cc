// Mistakes in a scene: each gives one line that names parameter and entry and says what is
// allowed. Derived from the entries below. Standard error goes to standard output here, so that
// what deal.II might print there would show.

#include <isochor/core/parameters.h>
#include <isochor/scene/scene.h>

#include <fstream>
#include <iostream>

using namespace isochor;

namespace
{
  template <int dim>
  void refuse(const std::string &settings, const std::string &mesh = "set Mesh = mesh.geo\n")
  {
    dealii::ParameterHandler prm;
    Scene<dim>::declare(prm);
    std::ofstream("test_scene_errors.prm") << "subsection Scene\nset Dimension = " << dim << '\n'
                                           << mesh << settings << "\nend\n";
    try
      {
        read_parameter_file(prm, "test_scene_errors.prm");
        check_loads_against_supports(Scene<dim>::parse(prm, "."));
        std::cout << settings << "\n  NO ERROR\n";
      }
    catch (const UserError &error)
      {
        const std::string text = error.what();
        std::cout << text << (text.find('\n') != std::string::npos ? "  MORE THAN ONE LINE" : "")
                  << '\n';
      }
    // The handler is left at its top level.
    prm.get({"Scene"}, "Mesh");
  }
} // namespace

int main()
{
  std::cerr.rdbuf(std::cout.rdbuf());

  refuse<3>("", "");
  refuse<3>("set Mesh size = -1");
  refuse<3>("set Cells = 3, 3");
  refuse<2>("set Cells = 3, 0");
  refuse<3>("set Cells = 3, 3, 3", "set Mesh = sphere_octant(1, 2)\n");
  refuse<3>("set Geometry order = 3");
  refuse<3>("set Split = 7-tet");
  refuse<3>("set Split = right");
  refuse<2>("set Split = 5-tet");
  refuse<3>("set Density = -1070");
  refuse<3>("set Poisson ratio = 0.51");
  refuse<3>("set Poisson ratio = -1");
  refuse<3>("set Young's modulus = 0");
  refuse<3>("set Energy = Hooke");
  refuse<3>("set Volumetric modulus = bulk");
  refuse<3>("set Volumetric strain = J");
  refuse<3>("set Mooney-Rivlin ratio = 1.1");

  refuse<3>("set Fixed = left: x");
  refuse<3>("set Fixed = left,, right");
  refuse<3>("set Fixed = left, left");
  refuse<3>("set Fixed = (left)");
  refuse<3>("set Fixed components = left");
  refuse<3>("set Fixed components = left: x, w");
  refuse<2>("set Fixed components = left: z");
  refuse<3>("set Fixed components = : x");
  refuse<3>("set Prescribed displacement = right: 1, 2");
  refuse<2>("set Prescribed displacement = right: -, -");
  refuse<3>("set Prescribed displacement = right: 1, 2, 3*");
  refuse<3>("set Prescribed displacement = right: 1, 2, t");
  refuse<2>("set Prescribed displacement = right: z, 0");
  refuse<2>("set Prescribed displacement = right: foo(x), 0");
  refuse<2>("set Prescribed displacement = right: (x, 0");
  refuse<2>("set Prescribed displacement = right: 1,");
  refuse<2>("set Prescribed displacement = right: sqrt(-1), 0");
  refuse<2>("set Prescribed displacement = right:");
  refuse<3>("set Prescribed rotation = right: 90");
  refuse<3>("set Prescribed rotation = right: 90 about 0, 0, 0");
  refuse<3>("set Prescribed rotation = right: 90 about 0, 0 axis 1, 0, 0");
  refuse<3>("set Prescribed rotation = right: ninety about 0, 0, 0 axis 1, 0, 0");
  refuse<3>("set Prescribed rotation = right: 90 about 0, 0, 0 axis 0, 0, 0");
  refuse<2>("set Prescribed rotation = right: 90 about 0, 0 axis 1, 0, 0");

  refuse<3>("set Gravity = 0, -9.8");
  refuse<2>("set Gravity = 0, g");
  refuse<3>("set Traction = 0, 1, 0");
  refuse<3>("set Traction = right: 0, 1");
  refuse<3>("set Traction = right: 0, 1, 2 3");
  refuse<3>("set Pressure = inner: 0, 1, 0");
  refuse<3>("set Pressure = inner: 10 kPa");
  refuse<3>("set Fixed = left\nset Traction = left: 0, 1, 0");
  refuse<2>("set Fixed components = left: x\nset Prescribed displacement = left: -, 0\n"
            "set Pressure = left: 1");

  refuse<3>("set Probes = volume");
  refuse<3>("set Probes = v: volume; v: volume");
  refuse<3>("set Probes = a/b: volume");
  refuse<3>("set Probes = v: volum");
  refuse<3>("set Probes = v: mean displacement w on right");
  refuse<2>("set Probes = v: mean displacement z on right");
  refuse<3>("set Probes = v: mean displacement right");
  refuse<3>("set Probes = v: displacement at 1, 2");
  refuse<3>("set Probes = v: displacement on right");
  refuse<3>("set Probes = v: cavity volume");
  refuse<3>("set Probes = v: reaction x");
  refuse<3>("set Probes = v: reaction on left:right");
  refuse<3>("set Probes = v: pressure H1 error against 0");
  refuse<2>("set Probes = v: displacement H1 error against 0, 0, 0");
  refuse<3>("set Probes = v: pressure L2 error without mean against x, y");
  refuse<3>("set Body force = right: 0, 0, 0");
  refuse<2>("set Body force = 1, 2, 3");

  // Not finite where it is needed, although finite elsewhere.
  const Expression<3> formula("1/x", "Scene/Traction: entry 'right: 1/x, 0, 0'");
  try
    {
      formula.value({0., 0.5, 1.}, 0.25);
      std::cout << "NO ERROR\n";
    }
  catch (const UserError &error)
    {
      std::cout << error.what() << '\n';
    }
}
