// Every energy, alone and with every volumetric strain, in mixed and displacement form, at eight
// deformations at once:
//   P against central differences of psi, A against central differences of P,
//   A symmetric in (iJ, kL),
//   objectivity psi(Q F) = psi(F), P(Q F) = Q P(F),
//   the stress at rest, which is zero,
//   NaN in the lane, and only there, where J <= 0,
// and the second derivative of J at J = 0, where the volumetric term J - 1 is defined.

#include <isochor/material/distortional_energy.h>

#include "../common/report.h"

#include <cmath>
#include <functional>

using namespace isochor;
using testing::below;
using testing::yes;

namespace
{
  constexpr double mu = 2.3, kappa = 7.1; // Pa

  /// Eight deformations, J between 0.4 and 2.5.
  Deformation samples()
  {
    Deformation deformation;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      for (int k = 0; k < 9; ++k)
        deformation.F[k][lane]
            = (k % 4 == 0 ? 0.8 + 0.08 * lane : 0.) + 0.3 * std::sin(1. + 2.7 * k + 1.3 * lane);
    deformation.complete();
    return deformation;
  }

  /// Rotation about (1, 2, 2) / 3 by 1 radian, times F.
  Deformation rotated(const Deformation &deformation, double (&Q)[9])
  {
    const double axis[3] = {1. / 3., 2. / 3., 2. / 3.}, c = std::cos(1.), s = std::sin(1.);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        Q[3 * i + j] = (i == j ? c : 0.) + (1 - c) * axis[i] * axis[j]
                       + (i == j ? 0. : ((j - i + 3) % 3 == 1 ? -s : s) * axis[3 - i - j]);
    Deformation result;
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        result.F[3 * i + J] = Q[3 * i] * deformation.F[J] + Q[3 * i + 1] * deformation.F[3 + J]
                              + Q[3 * i + 2] * deformation.F[6 + J];
    result.complete();
    return result;
  }

  /// The larger of both; a NaN stays.
  double worse(const double error, const double other)
  {
    return std::isnan(error) || error >= other ? error : other;
  }

  double largest(const Batch &x)
  {
    double most = 0;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      most = worse(most, std::abs(x[lane]));
    return most;
  }

  void worsen(double &error, const Batch &difference, const double scale = 1.)
  {
    error = worse(error, largest(difference) / scale);
  }

  using Model = std::function<Response(const Deformation &, bool with_tangent)>;

  Response evaluate_alone(const DistortionalEnergy &energy,
                          const Deformation        &deformation,
                          const bool                with_tangent)
  {
    Response response;
    energy.evaluate(deformation, with_tangent, response);
    return response;
  }

  void report(const std::string &name, const Model &model)
  {
    constexpr double  step        = 1e-5;
    const Deformation deformation = samples();
    const Response    response    = model(deformation, true);
    double            P_error = 0, A_error = 0, asymmetry = 0;
    for (int l = 0; l < 9; ++l)
      {
        Deformation plus = deformation, minus = deformation;
        plus.F[l] += step;
        minus.F[l] -= step;
        plus.complete();
        minus.complete();
        const Response ahead = model(plus, false), behind = model(minus, false);
        worsen(P_error, response.P[l] - (ahead.energy - behind.energy) / (2 * step), mu);
        for (int k = 0; k < 9; ++k)
          {
            worsen(A_error,
                   response.A[9 * k + l] - (ahead.P[k] - behind.P[k]) / (2 * step),
                   mu + largest(response.A[9 * k + l]));
            worsen(asymmetry, response.A[9 * k + l] - response.A[9 * l + k], mu);
          }
      }

    double         Q[9], turned = 0;
    const Response after = model(rotated(deformation, Q), false);
    worsen(turned, after.energy - response.energy, mu);
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J)
        worsen(turned,
               after.P[3 * i + J] - Q[3 * i] * response.P[J] - Q[3 * i + 1] * response.P[3 + J]
                   - Q[3 * i + 2] * response.P[6 + J],
               mu);

    Deformation rest;
    for (int k = 0; k < 9; ++k)
      rest.F[k] = batch(k % 4 == 0 ? 1. : 0.);
    rest.complete();
    const Response at_rest = model(rest, false);
    double         stress  = 0;
    for (int k = 0; k < 9; ++k)
      worsen(stress, at_rest.P[k], mu);

    testing::out() << name << "\n  P against differences: " << below(P_error, 1e-8)
                   << "\n  A against differences: " << below(A_error, 1e-7)
                   << "\n  A symmetric: " << below(asymmetry, 1e-12)
                   << "\n  objective: " << below(turned, 1e-12)
                   << "\n  stress at rest: " << below(stress, 1e-14)
                   << "\n  energy at rest: " << below(largest(at_rest.energy), 1e-14) << "\n";
  }

  bool all_finite_but(const Response &response, const unsigned int bad)
  {
    bool as_expected = true;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        const bool finite = lane != bad;
        as_expected       = as_expected && std::isfinite(response.energy[lane]) == finite;
        for (const Batch &entry : response.P)
          as_expected = as_expected && std::isfinite(entry[lane]) == finite;
        for (const Batch &entry : response.A)
          as_expected = as_expected && std::isfinite(entry[lane]) == finite;
      }
    return as_expected;
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const Energy kind : {Energy::neo_hookean, Energy::bonet_wood})
    {
      const auto        energy = make_distortional_energy(kind, mu);
      const std::string name   = energy_names.name(kind);
      report(name, [&](const Deformation &deformation, const bool with_tangent) {
        return evaluate_alone(*energy, deformation, with_tangent);
      });

      for (const VolumetricStrain strain :
           {VolumetricStrain::linear, VolumetricStrain::logarithmic})
        {
          const std::string both = name + ", " + volumetric_strain_names.name(strain);
          report(both + ", mixed form",
                 [&](const Deformation &deformation, const bool with_tangent) {
                   // A pressure that does not vary with F; at rest, where J = 1, it is zero.
                   Batch p;
                   for (unsigned int lane = 0; lane < n_lanes; ++lane)
                     p[lane] = std::abs(deformation.J[lane] - 1.) < 1e-14 ? 0. : 0.7 - lane;
                   const auto volumetric = evaluate(strain, deformation.J);
                   Response   response   = evaluate_alone(*energy, deformation, with_tangent);
                   response.energy += p * volumetric.phi;
                   add_volumetric(deformation, volumetric, p, 0., with_tangent, response);
                   return response;
                 });
          report(
              both + ", displacement form",
              [&](const Deformation &deformation, const bool with_tangent) {
                const auto volumetric = evaluate(strain, deformation.J);
                Response   response   = evaluate_alone(*energy, deformation, with_tangent);
                response.energy += .5 * kappa * volumetric.phi * volumetric.phi;
                add_volumetric(
                    deformation, volumetric, kappa * volumetric.phi, kappa, with_tangent, response);
                return response;
              });
        }

      for (const double stretch : {-0.5, 0.})
        {
          Deformation flipped = samples();
          for (int k = 0; k < 9; ++k)
            flipped.F[k][5] = k == 0 ? stretch : (k % 4 == 0 ? 1. : 0.);
          flipped.complete();
          testing::out() << name << ", one lane with J = " << stretch
                         << ": NaN there and only there: "
                         << yes(all_finite_but(evaluate_alone(*energy, flipped, true), 5)) << "\n";
        }
    }

  // cof F and its derivative where F is singular: F = diag(0, 2, 3), d2J / dF_11 dF_22 = F_33 = 3,
  // d2J / dF_12 dF_21 = -3.
  Deformation flat;
  for (int k = 0; k < 9; ++k)
    flat.F[k] = batch(k == 4 ? 2. : k == 8 ? 3. : 0.);
  flat.complete();
  Response response{};
  add_volumetric(flat, evaluate(VolumetricStrain::linear, flat.J), batch(1.), 0., true, response);
  testing::out() << "J = 0: J " << flat.J[0] << ", dJ/dF_11 " << response.P[0][3]
                 << ", d2J/dF_11 dF_22 " << response.A[9 * 0 + 4][3] << ", d2J/dF_12 dF_21 "
                 << response.A[9 * 1 + 3][3] << "\n";
}
