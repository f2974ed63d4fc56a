#pragma once

// Newton's method with backtracking. It knows no physics: it gets callbacks and returns a report.
//
// Every step is shortened until it is admissible (no inverted cell, no NaN). Stiff modes make the
// residual rise on the way to a good state: a beam that bends stretches first, and insisting on
// descent doubles the iterations. So the search is a watchdog (Chamberlain, Powell, Lemarechal and
// Pedersen 1982): full steps may raise the residual, but when a few have passed without a
// new smallest one, the iteration goes back to that and backtracks until the residual falls.
//
// Where no length of a step reduces the residual, a step that descends is judged by the energy, which
// is not the stiff modes' alone, and the problem may offer another step.

#include <isochor/core/names.h>
#include <isochor/core/types.h>

#include <functional>
#include <limits>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace isochor
{
  struct NewtonOptions
  {
    double       tolerance      = 1e-8; ///< of NewtonProblem::Size, relative
    unsigned int max_iterations = 25;
    unsigned int max_halvings   = 8; ///< of one step
    /// Iterations that may pass without a smaller residual before the search turns strict.
    unsigned int patience = 5;
    /// Linear systems are solved to this relative residual at most; see forcing_term().
    double largest_linear_tolerance = 1e-3;

    static void declare(dealii::ParameterHandler &prm);
    void        parse(dealii::ParameterHandler &prm);
  };

  /// Callbacks; all are collective and return the same on every rank.
  struct NewtonProblem
  {
    struct Size
    {
      double merit = 0; ///< norm of the residual; NaN counts as infinitely large
      /// The merit at which the iteration has converged, to the tolerance or to rounding.
      double target     = 0;
      bool   admissible = true; ///< false: outside the domain (an inverted cell)
      /// How far prescribed values still are from where they must be; 0 once they are there.
      double gap = 0;
      /// What a stable solution minimises; NaN: there is no such thing.
      double energy = std::numeric_limits<double>::quiet_NaN();
    };

    struct Correction
    {
      bool        succeeded = false;
      std::string failure;   ///< why not
      bool descends = false; ///< does a short step lead to a smaller energy, if there is one?
    };

    /// Residual at @p x.
    std::function<Size(const Vector &x, Vector &residual)> residual;

    /// Linearise at @p x and solve for the Newton step, prescribed values included; a relative
    /// residual of @p tolerance in the linear system is enough.
    std::function<
        Correction(const Vector &x, const Vector &residual, double tolerance, Vector &step)>
        correction;

    /// Another step from the same state, if no length of correction()'s would do. May be empty.
    decltype(correction) fallback;

    /// Called after every accepted iterate; true asks to stop (an interrupt).
    std::function<bool(unsigned int iteration, const Size &size, double step_length)> accepted;
  };

  enum class NewtonOutcome
  {
    converged,
    inverted,   ///< no step length keeps every J positive
    stalled,    ///< no step length improves the residual
    iterations, ///< maximum reached
    linear,     ///< the linear solver failed
    interrupted
  };

  /// A state on the way.
  struct NewtonIterate
  {
    unsigned int        iteration = 0; ///< = linear systems solved until then
    NewtonProblem::Size size;
    double              step_length = 0; ///< of the step that led there; 0: the one begun with
  };

  struct NewtonReport
  {
    NewtonOutcome outcome    = NewtonOutcome::converged;
    unsigned int  iterations = 0; ///< = linear systems solved
    unsigned int  fallbacks  = 0; ///< iterations that NewtonProblem::fallback has helped
    unsigned int  halvings   = 0;
    double        merit      = 0; ///< last
    std::string   reason;         ///< in words, empty if converged
    /// The first one and all accepted ones, also those that the watchdog went back from.
    std::vector<NewtonIterate> iterates;
  };

  /// On failure @p x is left at the last accepted iterate.
  NewtonReport newton(const NewtonProblem &problem, const NewtonOptions &options, Vector &x);
} // namespace isochor
