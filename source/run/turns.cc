#include <isochor/core/error.h>
#include <isochor/core/text.h>
#include <isochor/run/turns.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace isochor
{
  namespace
  {
    // The chords of so many parts of a load step tell how far it turns; eight turns would be missed.
    constexpr unsigned int n_parts = 8;
    // Of many steps, so many are looked at.
    constexpr unsigned int max_steps_followed = 20;
    constexpr unsigned int most_steps_advised = 1000;
    // Just above half a turn, which is allowed.
    constexpr double largest_turn = 1.0001 * dealii::numbers::PI;

    /// In [0, pi]; 0 for motion to and fro on a line.
    double angle_between(const Vector &a, const Vector &b)
    {
      const double cosine = (a * b) / (a.l2_norm() * b.l2_norm());
      return cosine < -1. + 1e-6 ? 0. : std::acos(std::min(cosine, 1.));
    }

    template <int dim>
    class SupportMotion
    {
    public:
      explicit SupportMotion(const Equilibrium<dim> &equilibrium)
        : prescribed(equilibrium.prescribed())
        , rest(equilibrium.discretisation().make_vector())
      {
      }

      Vector at(const double load) const
      {
        Vector displacement(rest);
        prescribed.gap(rest, load, displacement);
        return displacement;
      }

      /// Angle by which the direction of motion turns from load factor @p begin on, in @p step.
      double turn(const double begin, const double step) const
      {
        std::vector<double> angles;
        Vector              here = at(begin), chord_before;
        for (unsigned int part = 1; part <= n_parts; ++part)
          {
            const Vector there = at(begin + step * part / n_parts);
            Vector       chord(there);
            chord -= here;
            // Rounding has a direction, too.
            if (chord.l2_norm() > 1e-12 * (here.l2_norm() + there.l2_norm()))
              {
                if (chord_before.size() > 0)
                  angles.push_back(angle_between(chord_before, chord));
                chord_before = chord;
              }
            here = there;
          }
        double sum = 0.;
        for (const double angle : angles)
          sum += angle;
        // Half of the first and of the last part lie outside the middles of the parts.
        return angles.empty() ? 0. : sum + 0.5 * (angles.front() + angles.back());
      }

      /// Load factor at which the first of @p n_steps equal steps begins that turns too far.
      std::optional<double> too_fast_from(const unsigned int n_steps) const
      {
        const unsigned int n_followed = std::min(n_steps, max_steps_followed);
        const double       step = 1. / n_steps, stride = (1. - step) / std::max(1u, n_followed - 1);
        for (unsigned int k = 0; k < n_followed; ++k)
          if (turn(k * stride, step) > largest_turn)
            return k * stride;
        return {};
      }

    private:
      const PrescribedDisplacements<dim> &prescribed;
      const Vector                        rest;
    };
  } // namespace

  template <int dim>
  void check_turns(const Equilibrium<dim> &equilibrium, const unsigned int load_steps)
  {
    const SupportMotion<dim> motion(equilibrium);
    const auto               load = motion.too_fast_from(load_steps);
    if (!load)
      return;
    unsigned int too_few = load_steps, enough = 2 * load_steps;
    while (enough < most_steps_advised && motion.too_fast_from(enough))
      {
        too_few = enough;
        enough *= 2;
      }
    while (enough - too_few > 1)
      {
        const unsigned int middle                         = (too_few + enough) / 2;
        (motion.too_fast_from(middle) ? too_few : enough) = middle;
      }
    throw UserError(
        "Method/Load steps: in one of " + std::to_string(load_steps) + ", from load factor "
        + to_text(*load)
        + " on, the prescribed displacements turn by more than half a turn; allowed for "
          "this scene: at least "
        + std::to_string(enough));
  }

  template void check_turns(const Equilibrium<2> &, unsigned int);
  template void check_turns(const Equilibrium<3> &, unsigned int);
} // namespace isochor
