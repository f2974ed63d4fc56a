#pragma once

// Dual ascent, "nonlinear Uzawa", of "Locking-Proof Tetrahedra", section 8.3: the pressures are
// climbed to from outside,
//   x_{k+1} = arg min L(x, p_k)              (39)  by Newton's method on the displacements
//   p_{k+1} = p_k + omega d                  (40)  d = M^-1 (phi(x_{k+1}) - C p_k), a strain
//   omega   = d . phi / (d . A_2 d)          (41)  A_2 = G K^-1 G^T + C, one more solve
//
// Augmented, the paper's cure for bodies that the distortional energy alone cannot hold: the primal
// problem has a finite volumetric stiffness kappa_a. The paper adds kappa_a / 2 int Phi(J)^2, the
// standard material of a Poisson ratio about 0.4. But constraints hold for averages around nodes,
// not for the J of a cell: that term stays at the solution and changes it. Here the pressures take
// its part, with a compliance M / kappa_a around p_k,
//   (x, q) = arg min max L(x, q) - 1/2 (q - p_k) . (M / kappa_a) (q - p_k),
// which is kappa_a / 2 |phi|^2 in the metric M^-1 when q is eliminated and kappa infinite. It vanishes
// at the solution, q = p_k, for any kappa; the solution is Newton's. Its system has the unknowns of
// Newton's and a tangent that is definite on both blocks, whatever kappa and the inf-sup constant.

#include <isochor/form/pressure_mass.h>
#include <isochor/solver/dual_directions.h>
#include <isochor/solver/tangent_solver.h>

namespace isochor
{
  enum class Solver
  {
    newton,
    dual_ascent
  };
  inline constexpr auto solver_names
      = name_table<Solver>({{Solver::newton, "Newton"}, {Solver::dual_ascent, "dual ascent"}});

  /// In which metric the ascent is steepest.
  enum class DualMetric
  {
    mass, ///< of strains: d = M^-1 phi
    nodes ///< as the paper prints it: d = phi
  };
  inline constexpr auto dual_metric_names
      = name_table<DualMetric>({{DualMetric::mass, "mass"}, {DualMetric::nodes, "nodes"}});

  struct DualOptions
  {
    /// Of kappa_a = 2 mu nu / (1 - 2 nu); 0: not augmented.
    double           augmentation_poisson_ratio = 0.4;
    DualAcceleration acceleration               = DualAcceleration::none;
    DualMetric       metric                     = DualMetric::mass;
    unsigned int     max_iterations             = 200; ///< per load step

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
  };

  /// Dual iterations of one load step. Volume error: sum |phi - C p| over the volume, the paper's.
  struct DualReport
  {
    unsigned int iterations = 0;
    /// Until the volume error was at most 1 % and 0.01 %; 0: never.
    unsigned int        to_one_percent = 0, to_hundredth_percent = 0;
    std::vector<double> volume_errors = {}; ///< after each iteration
  };
  /// The larger of each count; no volume errors.
  DualReport most(const DualReport &a, const DualReport &b);

  template <int dim>
  class DualAscent
  {
  public:
    /// Changes the tangents of @p tangent_solver for its lifetime. References must outlive this.
    DualAscent(const Equilibrium<dim> &equilibrium,
               TangentSolver<dim>     &tangent_solver,
               const NewtonOptions    &newton_options,
               const DualOptions      &options,
               Stopwatch              &stopwatch);
    ~DualAscent();
    DualAscent(const DualAscent &)            = delete;
    DualAscent &operator=(const DualAscent &) = delete;

    /// The equilibrium at @p load, from @p state, to the tolerance of Newton's method on forces and
    /// constraints. On failure @p state is of no use. The report counts the iterations of Newton's
    /// method on the primal problems; its iterates are the dual ones. Collective.
    NewtonReport
    solve(double load, const std::function<bool()> &interrupted, ResidualSize &size, Vector &state);

    /// Of the last solve().
    const DualReport &report() const
    {
      return counts;
    }

  private:
    /// A change of the pressures, and what the primal solution does about it to first order.
    struct Ascent
    {
      Vector response;      ///< of state
      double curvature = 0; ///< minus the second derivative of the dual function, J
    };
    /// The equilibrium at an iterate, and how far from it the volume is.
    struct Evaluated
    {
      ResidualSize size;
      Vector       gradient;         ///< phi - C q, m^dim; zero in the displacements
      double       volume_error = 0; ///< see DualReport
    };

    bool is_augmented() const
    {
      return augmentation > 0.;
    }
    void change_tangent(SparseMatrix &matrix) const;
    NewtonReport
    primal(double load, double target, const std::function<bool()> &interrupted, DualIterate &at);
    /// The same from where @p ascent leads; where that fails, from the displacements of @p before.
    NewtonReport primal_after(double                       load,
                              double                       target,
                              const std::function<bool()> &interrupted,
                              const DualIterate           &before,
                              DualIterate                 &at);
    Evaluated    evaluate(double load, const DualIterate &at) const;
    bool respond(double load, const DualIterate &at, const Vector &direction, Ascent &ascent);

    const Equilibrium<dim> &equilibrium;
    TangentSolver<dim>     &tangent_solver;
    NewtonOptions           newton_options;
    DualOptions             options;
    Stopwatch              &stopwatch;
    PressureMass<dim>       mass;
    std::vector<char>       is_pressure;      ///< by local index, ghosts included
    double                  augmentation = 0; ///< kappa_a, Pa
    double                  volume       = 0; ///< m^dim
    double                  volume_norm  = 0; ///< |int N_p|
    DualDirections          directions;
    bool                    has_system = false; ///< has the tangent solver linearised?
    DualReport              counts;
  };
} // namespace isochor
