// Every energy at eight deformations at once:
//   P against central differences of psi, A against central differences of P (fourth order), also
//   where J < 0 if the energy is defined there,
//   A symmetric in (iJ, kL), but that of (31), which is no gradient,
//   objectivity psi(Q F) = psi(F), P(Q F) = Q P(F); of small strain, that an infinitesimal
//   rotation (a skew part of F) changes nothing,
//   isotropy psi(Q F Q^T) = psi(F), P(Q F Q^T) = Q P(F) Q^T,
//   the stress at rest: zero, but mu for (29) and (31),
//   NaN in the lane, and only there, where the energy is not defined.
// The same with the volumetric strains, in mixed and displacement form; and the second derivative
// of J at J = 0, where the volumetric term J - 1 is defined.

#include "deformations.h"

#include <functional>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  constexpr double mu = 2.3, kappa = 7.1; // Pa

  using Model = std::function<Response(const Deformation &, bool with_tangent)>;

  struct Expected
  {
    bool   gradient    = true;
    bool   objective   = true;
    bool   any_J       = false; ///< defined where J < 0, too
    double rest_stress = 0;
  };

  Response evaluate_alone(const DistortionalEnergy &energy,
                          const Deformation        &deformation,
                          const bool                with_tangent)
  {
    Response response;
    energy.evaluate(deformation, with_tangent, response);
    return response;
  }

  struct Errors
  {
    double P = 0, A = 0, asymmetry = 0;
  };

  Errors differences(const Model &model, const Deformation &deformation)
  {
    constexpr double h        = 3e-4;
    const Response   response = model(deformation, true);
    Errors           errors;
    for (int l = 0; l < 9; ++l)
      {
        const auto at = [&](const double step) {
          Deformation moved = deformation;
          moved.F[l] += step;
          moved.complete();
          return model(moved, false);
        };
        const Response a = at(h), b = at(-h), c = at(2 * h), d = at(-2 * h);
        const auto     slope = [&](const Batch &a, const Batch &b, const Batch &c, const Batch &d) {
          return (8. * (a - b) - (c - d)) / (12. * h);
        };
        raise_by(errors.P, response.P[l] - slope(a.energy, b.energy, c.energy, d.energy), mu);
        for (int k = 0; k < 9; ++k)
          {
            raise_by(errors.A,
                     response.A[9 * k + l] - slope(a.P[k], b.P[k], c.P[k], d.P[k]),
                     mu + largest(response.A[9 * k + l]));
            raise_by(errors.asymmetry, response.A[9 * k + l] - response.A[9 * l + k], mu);
          }
      }
    return errors;
  }

  /// psi and P do not change but for what @p left and @p right do to them.
  double change(const Model &model, const Matrix *left, const Matrix *right)
  {
    const Deformation deformation = samples();
    const Response    before      = model(deformation, false);
    Batch             F[9], P[9], turned[9];
    std::copy_n(deformation.F, 9, F);
    std::copy_n(before.P, 9, P);
    for (auto *tensor : {&F, &P})
      {
        if (left != nullptr)
          {
            from_left(*left, *tensor, turned);
            std::copy_n(turned, 9, *tensor);
          }
        if (right != nullptr)
          {
            from_right(*right, *tensor, turned);
            std::copy_n(turned, 9, *tensor);
          }
      }
    Deformation moved;
    std::copy_n(F, 9, moved.F);
    moved.complete();
    const Response after = model(moved, false);
    double         error = 0;
    raise_by(error, after.energy - before.energy, mu);
    for (int k = 0; k < 9; ++k)
      raise_by(error, after.P[k] - P[k], mu);
    return error;
  }

  double change_by_skew_part(const Model &model)
  {
    Deformation    deformation = samples();
    const Response before      = model(deformation, false);
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        deformation.F[3 * i + J] += 0.3 * (J - i) * (1 + i + J);
    deformation.complete();
    const Response after = model(deformation, false);
    double         error = 0;
    raise_by(error, after.energy - before.energy, mu);
    for (int k = 0; k < 9; ++k)
      raise_by(error, after.P[k] - before.P[k], mu);
    return error;
  }

  void report(const std::string &name, const Model &model, const Expected &expected)
  {
    const Errors errors = differences(model, samples());
    out() << name << "\n  ";
    if (expected.gradient)
      out() << "P against differences: " << below(errors.P, 1e-9)
            << ", A symmetric: " << below(errors.asymmetry, 1e-12);
    else
      out() << "P is no gradient: " << yes(errors.P > 0.1)
            << ", A is not symmetric: " << yes(errors.asymmetry > 0.1);
    out() << ", A against differences: " << below(errors.A, 1e-9);
    if (expected.any_J)
      {
        const Errors there = differences(model, samples(true));
        out() << "; where J < 0: " << below(there.P, 1e-9) << ", " << below(there.A, 1e-9) << ", "
              << below(there.asymmetry, 1e-12);
      }

    const Matrix   Q       = rotation(1.);
    const Response at_rest = model(diagonal(1., 1., 1.), false);
    double         stress  = 0;
    for (int k = 0; k < 9; ++k)
      raise_by(stress, at_rest.P[k] - (k % 4 == 0 ? expected.rest_stress : 0.), mu);
    if (expected.objective)
      out() << "\n  objective: " << below(change(model, &Q, nullptr), 1e-12);
    else
      out() << "\n  blind to the skew part: " << below(change_by_skew_part(model), 1e-12);
    out() << ", isotropic: " << below(change(model, &Q, &Q), 1e-12) << "; at rest: stress "
          << expected.rest_stress / mu << " mu " << below(stress, 1e-14) << ", energy "
          << below(largest(at_rest.energy), 1e-14) << "\n";
  }

  void report_with_volume(const std::string        &name,
                          const DistortionalEnergy &energy,
                          const VolumetricStrain    strain,
                          const Expected           &expected)
  {
    const std::string both = name + ", " + volumetric_strain_names.name(strain);
    report(
        both + ", mixed form",
        [&](const Deformation &deformation, const bool with_tangent) {
          // A pressure that does not vary with F; at rest, where all Phi are zero, it is zero.
          const auto volumetric = evaluate(strain, deformation);
          Batch      p;
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            p[lane] = std::abs(volumetric.phi[lane]) < 1e-14 ? 0. : 0.7 - lane;
          Response response = evaluate_alone(energy, deformation, with_tangent);
          response.energy += p * volumetric.phi;
          add_volumetric(deformation, volumetric, p, 0., with_tangent, response);
          return response;
        },
        expected);
    report(
        both + ", displacement form",
        [&](const Deformation &deformation, const bool with_tangent) {
          const auto volumetric = evaluate(strain, deformation);
          Response   response   = evaluate_alone(energy, deformation, with_tangent);
          response.energy += .5 * kappa * volumetric.phi * volumetric.phi;
          add_volumetric(
              deformation, volumetric, kappa * volumetric.phi, kappa, with_tangent, response);
          return response;
        },
        expected);
  }

  /// "finite", "NaN" or "mixed up" in lane 5; all others have to be finite.
  std::string lane_5(const Response &response)
  {
    bool       finite = true, nan = true, others = true;
    const auto look = [&](const Batch &entry) {
      finite = finite && std::isfinite(entry[5]);
      nan    = nan && std::isnan(entry[5]);
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        others = others && (lane == 5 || std::isfinite(entry[lane]));
    };
    look(response.energy);
    for (const Batch &entry : response.P)
      look(entry);
    for (const Batch &entry : response.A)
      look(entry);
    return finite && others ? "finite" : nan && others ? "NaN" : "mixed up";
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string &name : energy_names.names())
    {
      const Energy kind   = energy_names.value(name, "");
      const auto   energy = make_distortional_energy(kind, {mu, kappa, 0.3});
      Expected     expected;
      expected.gradient  = kind != Energy::simplified_bonet_wood;
      expected.objective = kind != Energy::linear && kind != Energy::linear_as_printed;
      expected.any_J     = kind != Energy::neo_hookean && kind != Energy::bonet_wood
                       && kind != Energy::simplified_bonet_wood && kind != Energy::mooney_rivlin;
      expected.rest_stress
          = kind == Energy::mooney || kind == Energy::simplified_bonet_wood ? mu : 0.;
      report(
          name,
          [&](const Deformation &deformation, const bool with_tangent) {
            return evaluate_alone(*energy, deformation, with_tangent);
          },
          expected);
      out() << "  says:" << (energy->is_symmetric() ? "" : " not") << " symmetric,"
            << (energy->is_linear() ? "" : " not") << " linear; one lane with F = diag(x, 1, 1):";
      for (const double stretch : {-0.5, 0., -1.})
        {
          Deformation flipped = samples();
          for (int k = 0; k < 9; ++k)
            flipped.F[k][5] = k == 0 ? stretch : (k % 4 == 0 ? 1. : 0.);
          flipped.complete();
          out() << " x = " << stretch << " " << lane_5(evaluate_alone(*energy, flipped, true))
                << (stretch == -1. ? "\n" : ",");
        }

      const auto usual = usual_volumetric_strain(kind);
      if (kind == Energy::neo_hookean || kind == Energy::bonet_wood)
        {
          report_with_volume(name, *energy, usual, expected);
          report_with_volume(name, *energy, VolumetricStrain::logarithmic, expected);
        }
      else if (kind == Energy::linear)
        report_with_volume(name, *energy, usual, expected);
    }

  // cof F and its derivative where F is singular: F = diag(0, 2, 3), d2J / dF_11 dF_22 = F_33 = 3,
  // d2J / dF_12 dF_21 = -3.
  const Deformation flat = diagonal(0., 2., 3.);
  Response          response{};
  add_volumetric(flat, evaluate(VolumetricStrain::linear, flat), batch(1.), 0., true, response);
  out() << "J = 0: J " << flat.J[0] << ", dJ/dF_11 " << response.P[0][3] << ", d2J/dF_11 dF_22 "
        << response.A[9 * 0 + 4][3] << ", d2J/dF_12 dF_21 " << response.A[9 * 1 + 3][3] << "\n";
}
