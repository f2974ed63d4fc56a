#include <isochor/core/patterns.h>
#include <isochor/core/text.h>
#include <isochor/run/method.h>

namespace isochor
{
  namespace
  {
    constexpr const char *consistent = "consistent", *lumped = "lumped";

    bool has_linear_pressure(const Element &element)
    {
      return element.pressure && element.pressure->family == Family::lagrange
             && element.pressure->degree == 1;
    }

    void check_element(const Element &element, const Material &material)
    {
      const std::string name(element.name);
      const double      kappa = moduli(material).kappa;
      if (!element.is_mixed() && !std::isfinite(kappa))
        throw UserError("Method/Element: " + name
                        + " has no pressure and cannot compute Scene/Poisson ratio = 0.5; choose a "
                          "mixed element ("
                        + listed(element_names([&](const Element &other) {
                            return other.is_mixed() && other.kind == element.kind;
                          }))
                        + ") or a Poisson ratio below 0.5, knowing that it locks near 0.5");
      if (element.is_mixed() && !(kappa > 0))
        throw UserError("Method/Element: " + name
                        + " needs a positive volumetric modulus, which this Poisson ratio and "
                          "Scene/Volumetric modulus do not give; choose a displacement element ("
                        + listed(element_names([&](const Element &other) {
                            return !other.is_mixed() && other.kind == element.kind;
                          }))
                        + ") or a larger Poisson ratio");
    }

    /// The legal pairs of an element and a solver.
    struct SolverRow
    {
      Solver solver;
      bool (*takes)(const Element &);
      const char *needs;
    };
    constexpr SolverRow solver_table[]
        = {{Solver::newton, [](const Element &) { return true; }, "any element"},
           {Solver::dual_ascent,
            [](const Element &element) { return element.is_mixed(); },
            "the pressures of a mixed element"}};

    void check_solver(const Method &method)
    {
      const std::string name = solver_names.name(method.solver);
      for (const SolverRow &row : solver_table)
        if (row.solver == method.solver && !row.takes(method.element))
          throw UserError("Method/Solver: '" + name + "' needs " + row.needs + ", which "
                          + std::string(method.element.name)
                          + " has not; choose Newton, or an element among "
                          + listed(element_names([&](const Element &other) {
                              return row.takes(other) && other.kind == method.element.kind;
                            })));
      if (!is_matrix_free(method.linear.solver))
        return;
      const std::string linear = linear_solver_names.name(method.linear.solver);
      if (method.solver == Solver::dual_ascent)
        throw UserError(
            "Method/Linear solver: " + linear
            + " has no factors for 'dual ascent' to keep; choose automatic, kept, direct "
              "or UMFPACK, or Method/Solver = Newton");
      if (method.linear.condensation != Condensation::automatic
          && method.linear.condensation != Condensation::none)
        throw UserError("Method/Condensation: " + linear
                        + " has no matrix to eliminate unknowns from; choose automatic or none");
    }

    void check_condensation(const Method &method, const Material &material)
    {
      const Element    &element = method.element;
      const std::string name(element.name);
      const auto        legal
          = [](const Element &other) { return has_linear_pressure(other) && !other.is_stabilised; };
      const std::string known = listed(element_names(legal));
      if (method.compliance.lumped && !legal(element))
        throw UserError("Method/Compliance matrix: " + name
                        + " has no lumped compliance matrix (it needs a continuous linear pressure "
                          "without stabilisation); choose consistent, or an element among "
                        + known);
      if (method.linear.condensation == Condensation::pressure)
        {
          if (!legal(element))
            throw UserError("Method/Condensation: 'pressure' is for a continuous linear pressure "
                            "without stabilisation, which "
                            + name + " has not; choose automatic, or an element among " + known);
          if (!method.compliance.lumped)
            throw UserError("Method/Condensation: 'pressure' needs a diagonal compliance matrix; "
                            "set Method/Compliance matrix = lumped, or choose automatic");
          const double kappa = moduli(material).kappa;
          if (!std::isfinite(kappa))
            throw UserError(
                "Method/Condensation: 'pressure' divides by 1 / kappa, which is zero at "
                "Scene/Poisson ratio = 0.5; choose automatic or none, or a Poisson "
                "ratio below 0.5");
        }
      if (method.linear.condensation == Condensation::cells && !element.has_bubble()
          && !element.has_discontinuous_pressure())
        throw UserError("Method/Condensation: 'cells' has nothing to eliminate in " + name
                        + "; choose automatic or none, or an element with a bubble or a "
                          "discontinuous pressure ("
                        + listed(element_names([](const Element &other) {
                            return other.has_bubble() || other.has_discontinuous_pressure();
                          }))
                        + ")");
    }
  } // namespace

  void Method::declare(dealii::ParameterHandler &prm)
  {
    const ComplianceOptions compliance;
    const LinearOptions     linear;
    prm.enter_subsection("Method");
    prm.declare_entry(
        "Element",
        "P1-P1",
        dealii::Patterns::Selection(element_selection() + "|" + automatic_element),
        "Finite element: displacement, then pressure. P: triangles, tetrahedra; Q: "
        "quadrilaterals, hexahedra. P1, P2, P3, Q1, Q2 are displacement elements "
        "(Poisson ratio below 0.5; P1 locks); the others are mixed. P0, and P1 behind "
        "Q2: discontinuous pressure. MINI: P1 and a bubble, with P1. P1-P1s: P1-P1 "
        "with a stabilised pressure. auto: the cheapest element and mesh size with which the error "
        "is expected to be below Accuracy; Mesh size (or Cells) is where the search begins.");
    prm.declare_entry("Stabilisation",
                      to_text(compliance.stabilisation),
                      NumberPattern::above(0),
                      "P1-P1s: scale s of its pressure projection s / mu int (p - P0 p)(q - P0 q), "
                      "greater than 0. No unit.");
    prm.declare_entry("Compliance matrix",
                      consistent,
                      dealii::Patterns::Selection(std::string(consistent) + "|" + lumped),
                      "C = int N_p N_q / kappa, or the diagonal matrix of its row sums (lumped; "
                      "continuous linear pressures).");
    prm.declare_entry(
        "Condensation",
        condensation_names.name(Condensation::automatic),
        dealii::Patterns::Selection(condensation_names.selection()),
        "Unknowns that are eliminated before the linear solver; the result is the "
        "same. cells: bubbles and, at a Poisson ratio below 0.5, discontinuous "
        "pressures, cell by cell. pressure: a continuous pressure with the lumped "
        "compliance matrix, at a Poisson ratio below 0.5. automatic: cells, where "
        "there is something to eliminate; bubbles alone before Linear solver = block.");
    prm.declare_entry(
        "Linear solver",
        linear_solver_names.name(LinearSolver::automatic),
        dealii::Patterns::Selection(linear_solver_names.selection()),
        "kept: MUMPS' LDL^T in single precision, kept over several Newton iterations "
        "as the preconditioner of FGMRES. direct: MUMPS' LDL^T in double precision, "
        "anew in every iteration. UMFPACK: LU, likewise, one rank. block: FGMRES with "
        "algebraic multigrid for displacements and a mass matrix for pressures; no "
        "factors, for stable mixed elements on fine meshes. CR, CG: conjugate residuals or "
        "gradients with diagonal scaling and without a matrix; many iterations, and either may "
        "break down on a mixed element. kept and direct count negative pivots. automatic: kept; "
        "block if the factors do not fit into Memory limit or, for a stable element, take longer "
        "than its iterations.");
    prm.declare_entry("Memory limit",
                      to_text(linear.memory_limit),
                      NumberPattern::at_least(0),
                      "Of the factors, all MPI ranks together, MB (1e6 bytes). 0: 80 % of what the "
                      "machines have available when the run starts.");
    prm.declare_entry(
        "Newton tangent",
        newton_tangent_names.name(linear.tangent),
        dealii::Patterns::Selection(newton_tangent_names.selection()),
        "predicted stress: the geometric stiffness of the stress that the last iteration's tangent "
        "foretold for this state (Magisano and others 2017); fewer iterations where the stress "
        "follows the strain steeply, as near a Poisson ratio of 0.5. consistent: the derivative of "
        "the unbalanced forces, Newton's method as in textbooks.");
    prm.declare_entry(
        "Nested levels",
        "0",
        dealii::Patterns::Integer(0, 10),
        "Number of coarser meshes, each with twice the edge length (half the blocks) "
        "of the next one, that are solved on first: the equilibrium at the full load, "
        "interpolated, is where Newton's method begins on the mesh itself. Where that "
        "fails, load stepping begins from rest. No unit.");
    prm.declare_entry(
        "Solver",
        solver_names.name(Solver::newton),
        dealii::Patterns::Selection(solver_names.selection()),
        "Of a load step. Newton: displacements and pressures together. dual ascent: "
        "mixed elements; displacements by Newton's method at given pressures, which a "
        "gradient ascent corrects. The result is the same.");
    prm.declare_entry("Time limit",
                      "0",
                      NumberPattern::at_least(0),
                      "Of a run, s: at the first Newton iteration after it the run ends as not "
                      "converged, with its last converged state. 0: none.");
    SteppingOptions::declare(prm);
    NewtonOptions::declare(prm);
    DualOptions::declare(prm);
    prm.leave_subsection();
  }

  Method Method::parse(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Method");
    const std::string element = prm.get("Element");
    Method            method{element == automatic_element ? element_table().front()
                                                          : find_element(element, "Method/Element"),
                  {},
                  {},
                  {},
                  {},
                  {},
                  {},
                  {}};
    method.chooses_element   = element == automatic_element;
    method.nested_levels     = prm.get_integer("Nested levels");
    method.compliance.lumped = prm.get("Compliance matrix") == lumped;
    method.compliance.stabilisation
        = parse_number(prm.get("Stabilisation"), "Method/Stabilisation");
    method.linear.solver
        = linear_solver_names.value(prm.get("Linear solver"), "Method/Linear solver");
    method.linear.condensation
        = condensation_names.value(prm.get("Condensation"), "Method/Condensation");
    method.linear.tangent
        = newton_tangent_names.value(prm.get("Newton tangent"), "Method/Newton tangent");
    method.linear.memory_limit = parse_number(prm.get("Memory limit"), "Method/Memory limit");
    method.time_limit          = parse_number(prm.get("Time limit"), "Method/Time limit");
    method.stepping.parse(prm);
    method.newton.parse(prm);
    method.solver = solver_names.value(prm.get("Solver"), "Method/Solver");
    method.dual.parse(prm);
    prm.leave_subsection();
    return method;
  }

  void check_legal(const Method &method, const Material &material, const unsigned int n_ranks)
  {
    check_element(method.element, material);
    check_condensation(method, material);
    check_solver(method);
    if (method.solver == Solver::dual_ascent && method.stepping.kind == Stepping::arc_length)
      throw UserError(
          "Method/Stepping: arc length follows a path with Newton's method only; choose "
          "fixed or adaptive, or Method/Solver = Newton");
    if (method.linear.solver == LinearSolver::umfpack && n_ranks > 1)
      throw UserError("Method/Linear solver: UMFPACK runs on one rank, not on "
                      + std::to_string(n_ranks) + "; choose direct or automatic");
  }

  namespace
  {
    std::optional<double> parse_checkpoint(const std::string &text)
    {
      if (text == "never")
        return {};
      if (text == "steps")
        return 0.;
      const std::string what = "Output/Checkpoint";
      try
        {
          if (const double seconds = parse_number(text, what); seconds >= 0.)
            return seconds;
        }
      catch (const UserError &)
        {
        }
      throw UserError(what + ": '" + text
                      + "' is not allowed; choose steps, never, or a number of seconds of at least "
                        "0");
    }
  } // namespace

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
    prm.declare_entry("Checkpoint",
                      "steps",
                      dealii::Patterns::Anything(),
                      "When the state is saved, so that --restart can go on from it after an "
                      "interruption: steps (after each load step), never, or a number of seconds, "
                      "at least 0, that lie at least between two saves. The last two are kept; a "
                      "run that converges removes them. Example: 60");
    prm.declare_entry(
        "Error estimates",
        "false",
        dealii::Patterns::Bool(),
        "Also estimate the discretisation error of mean, point and extreme displacements "
        "from the run itself, by dual-weighted residuals; about a tenth of the run's "
        "seconds. Not by the matrix-free linear solvers.");
    prm.declare_entry("Inf-sup test",
                      "false",
                      dealii::Patterns::Bool(),
                      "Also compute the inf-sup constant and the number of spurious pressure modes "
                      "of a mixed element, at rest and in the final state (--inf-sup asks for the "
                      "same). Several factorisations each.");
    prm.declare_entry("Iterations",
                      "false",
                      dealii::Patterns::Bool(),
                      "Also write iterations.csv, with a row per iteration of Newton's method, or "
                      "of dual ascent, of converged and failed load steps. Not of coarser meshes "
                      "(Nested levels).");
    prm.leave_subsection();
  }

  OutputOptions OutputOptions::parse(dealii::ParameterHandler &prm)
  {
    OutputOptions options;
    prm.enter_subsection("Output");
    options.folder              = prm.get("Folder");
    options.vtu                 = vtu_output_names.value(prm.get("VTU"), "Output/VTU");
    options.inf_sup             = prm.get_bool("Inf-sup test");
    options.error_estimates     = prm.get_bool("Error estimates");
    options.iterations          = prm.get_bool("Iterations");
    options.checkpoint_interval = parse_checkpoint(trim(prm.get("Checkpoint")));
    prm.leave_subsection();
    return options;
  }
} // namespace isochor
