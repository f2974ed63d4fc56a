#include <isochor/run/method.h>

namespace isochor
{
  void Method::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Method");
    prm.declare_entry("Element",
                      "P1-P1",
                      dealii::Patterns::Selection(element_selection()),
                      "Finite element: displacement, then pressure. P1, P2, P3 are displacement "
                      "elements (Poisson ratio below 0.5; P1 locks); P1-P1, P2-P1, P3-P2 are "
                      "mixed.");
    prm.declare_entry("Linear solver",
                      "MUMPS",
                      dealii::Patterns::Selection(linear_solver_names.selection()),
                      "MUMPS: LDL^T, any number of ranks, counts negative pivots. UMFPACK: LU, "
                      "one rank.");
    SteppingOptions::declare(prm);
    NewtonOptions::declare(prm);
    prm.leave_subsection();
  }

  Method Method::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Method");
    Method method{find_element(prm.get("Element"), "Method/Element"),
                  linear_solver_names.value(prm.get("Linear solver"), "Method/Linear solver"),
                  {},
                  {}};
    method.stepping.parse(prm);
    method.newton.parse(prm);
    prm.leave_subsection();
    return method;
  }

  void check_legal(const Method &method, const Material &material, const unsigned int n_ranks)
  {
    const std::string element(method.element.name);
    const auto [mu, kappa]
        = moduli(material.youngs_modulus, material.poisson_ratio, material.energy, material.kappa);
    if (!method.element.is_mixed() && !std::isfinite(kappa))
      throw UserError("Method/Element: " + element
                      + " has no pressure and cannot compute Scene/Poisson ratio = 0.5; choose a "
                        "mixed element ("
                      + listed(mixed_element_names())
                      + ") or a Poisson ratio below 0.5, knowing that it locks near 0.5");
    if (method.element.is_mixed() && !(kappa > 0))
      throw UserError("Method/Element: " + element
                      + " needs a positive volumetric modulus, which this Poisson ratio and "
                        "Scene/Volumetric modulus do not give; choose a displacement element "
                        "(P1, P2, P3) or a larger Poisson ratio");
    if (method.linear_solver == LinearSolver::umfpack && n_ranks > 1)
      throw UserError("Method/Linear solver: UMFPACK runs on one rank, not on "
                      + std::to_string(n_ranks) + "; choose MUMPS");
  }

  void OutputOptions::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    prm.declare_entry("Folder",
                      "",
                      dealii::Patterns::Anything(),
                      "Where results go, relative to the working directory. Empty: "
                      "results/<name of the parameter file>. --output overrides it. A folder that "
                      "exists is not overwritten unless --overwrite is given.");
    prm.declare_entry("VTU",
                      "steps",
                      dealii::Patterns::Selection(vtu_output_names.selection()),
                      "Which states are written for ParaView: of every load step, the final one "
                      "only, none.");
    prm.leave_subsection();
  }

  OutputOptions OutputOptions::parse(dealii::ParameterHandler &prm)
  {
    OutputOptions options;
    prm.enter_subsection("Output");
    options.folder = prm.get("Folder");
    options.vtu    = vtu_output_names.value(prm.get("VTU"), "Output/VTU");
    prm.leave_subsection();
    return options;
  }
} // namespace isochor
