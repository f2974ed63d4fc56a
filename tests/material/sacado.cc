// Every energy and every volumetric term against automatic differentiation: psi, P and A against
// value, first and second derivatives that Sacado (Trilinos) finds of psi written here once more, as
// a function of F that knows nothing of derivatives; of (31), which has no psi, A against the first
// derivatives of P. The rotation of the corotational energy comes from Newton's iteration
// R <- (R + R^-T) / 2 here, which Sacado differentiates step by step.

#include "deformations.h"

#include <Sacado.hpp>

using namespace isochor;
using namespace isochor::testing;

namespace
{
  constexpr double mu = 2.3, kappa = 7.1, ratio = 0.3; // Pa, Pa, 1

  using First  = Sacado::Fad::SFad<double, 9>;
  using Second = Sacado::Fad::SFad<First, 9>;

  template <typename Number>
  struct Tensor
  {
    Number entry[3][3];
  };

  template <typename Number>
  Number determinant(const Tensor<Number> &T)
  {
    const auto &t = T.entry;
    return t[0][0] * (t[1][1] * t[2][2] - t[1][2] * t[2][1])
           - t[0][1] * (t[1][0] * t[2][2] - t[1][2] * t[2][0])
           + t[0][2] * (t[1][0] * t[2][1] - t[1][1] * t[2][0]);
  }

  template <typename Number>
  Number square(const Tensor<Number> &T)
  {
    Number sum = 0.;
    for (const auto &row : T.entry)
      for (const Number &t : row)
        sum += t * t;
    return sum;
  }

  template <typename Number>
  Number trace(const Tensor<Number> &T)
  {
    return T.entry[0][0] + T.entry[1][1] + T.entry[2][2];
  }

  /// T^T T
  template <typename Number>
  Tensor<Number> right_square(const Tensor<Number> &T)
  {
    Tensor<Number> result;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        {
          Number sum = 0.;
          for (int i = 0; i < 3; ++i)
            sum += T.entry[i][a] * T.entry[i][b];
          result.entry[a][b] = sum;
        }
    return result;
  }

  template <typename Number>
  Tensor<Number> rotation_of(const Tensor<Number> &F)
  {
    Tensor<Number> R = F;
    for (int iteration = 0; iteration < 12; ++iteration)
      {
        const Number         J = determinant(R);
        const Tensor<Number> X = R;
        for (int i = 0; i < 3; ++i)
          for (int a = 0; a < 3; ++a)
            {
              const int j = (i + 1) % 3, k = (i + 2) % 3, b = (a + 1) % 3, c = (a + 2) % 3;
              R.entry[i][a]
                  = .5
                    * (X.entry[i][a]
                       + (X.entry[j][b] * X.entry[k][c] - X.entry[j][c] * X.entry[k][b]) / J);
            }
      }
    return R;
  }

  template <typename Number>
  Number psi(const Energy energy, const Tensor<Number> &F)
  {
    const Number   J  = determinant(F);
    const Number   I1 = square(F);
    Tensor<Number> strain; // small strain
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        strain.entry[i][j] = .5 * (F.entry[i][j] + F.entry[j][i]) - (i == j ? 1. : 0.);
    switch (energy)
      {
        case Energy::neo_hookean:
          return mu / 2 * (I1 - 3.) - mu * log(J);
        case Energy::simplified_bonet_wood: // what is returned for it
        case Energy::bonet_wood:
          return mu / 2 * (pow(J, -2. / 3) * I1 - 3.);
        case Energy::mooney:
          return mu / 2 * (I1 - 3.);
        case Energy::stable_neo_hookean:
          {
            // The second paper's two terms, without kappa/2 (J - 1)^2 and the constant.
            const double gamma = 1 + mu / kappa;
            return mu / 2 * (I1 - 3.) + kappa / 2 * (J - gamma) * (J - gamma)
                   - kappa / 2 * (J - 1.) * (J - 1.) - kappa / 2 * (1 - gamma) * (1 - gamma);
          }
        case Energy::mooney_rivlin:
          {
            Tensor<Number> C = right_square(F);
            for (auto &row : C.entry)
              for (Number &c : row)
                c = c * pow(J, -2. / 3);
            const Number first  = trace(C);
            const Number second = .5 * (first * first - square(C));
            return (1 - ratio) * mu / 2 * (first - 3.) + ratio * mu / 2 * (second - 3.);
          }
        case Energy::st_venant_kirchhoff:
          {
            Tensor<Number> E = right_square(F);
            for (int a = 0; a < 3; ++a)
              for (int b = 0; b < 3; ++b)
                E.entry[a][b] = .5 * (E.entry[a][b] - (a == b ? 1. : 0.));
            return mu * square(E);
          }
        case Energy::corotational:
          {
            Tensor<Number> stretched = rotation_of(F);
            for (int i = 0; i < 3; ++i)
              for (int a = 0; a < 3; ++a)
                stretched.entry[i][a] = F.entry[i][a] - stretched.entry[i][a];
            return mu * square(stretched);
          }
        case Energy::linear:
          return mu * (square(strain) - trace(strain) * trace(strain) / 3.);
        case Energy::linear_as_printed:
          return mu / 2 * square(strain) - 2 * mu / 3 * trace(strain) * trace(strain);
      }
    throw std::logic_error("an energy without a formula");
  }

  template <typename Number>
  Number phi(const VolumetricStrain strain, const Tensor<Number> &F)
  {
    switch (strain)
      {
        case VolumetricStrain::linear:
          return determinant(F) - 1.;
        case VolumetricStrain::logarithmic:
          return log(determinant(F));
        case VolumetricStrain::trace:
          return trace(F) - 3.;
      }
    throw std::logic_error("a volumetric strain without a formula");
  }

  /// Largest differences, each relative to the largest entry of its kind.
  struct Errors
  {
    double energy = 0, P = 0, A = 0;
  };

  template <typename Formula>
  Errors compare(const Deformation &deformation, const Response &response, const Formula &formula)
  {
    Errors errors;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        Tensor<Second> F;
        for (int k = 0; k < 9; ++k)
          {
            F.entry[k / 3][k % 3]       = Second(9, k, deformation.F[k][lane]);
            F.entry[k / 3][k % 3].val() = First(9, k, deformation.F[k][lane]);
          }
        const Second value     = formula(F);
        double       largest_P = 0, largest_A = 0;
        for (int k = 0; k < 9; ++k)
          {
            raise(largest_P, std::abs(value.dx(k).val()));
            for (int l = 0; l < 9; ++l)
              raise(largest_A, std::abs(value.dx(k).dx(l)));
          }
        raise(errors.energy, std::abs(response.energy[lane] - value.val().val()) / mu);
        for (int k = 0; k < 9; ++k)
          {
            raise(errors.P, std::abs(response.P[k][lane] - value.dx(k).val()) / largest_P);
            for (int l = 0; l < 9; ++l)
              raise(errors.A,
                    std::abs(response.A[9 * k + l][lane] - value.dx(k).dx(l))
                        / (largest_A + 1e-300));
          }
      }
    return errors;
  }

  void report(const std::string &name, const Errors &errors)
  {
    out() << name << ": value " << below(errors.energy, 1e-13) << ", P " << below(errors.P, 1e-13)
          << ", A " << below(errors.A, 1e-12) << '\n';
  }

  /// (31): P and A against P by its formula, and A from that.
  Errors compare_simplified(const Deformation &deformation, const Response &response)
  {
    Errors errors;
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        Tensor<First> F;
        for (int k = 0; k < 9; ++k)
          F.entry[k / 3][k % 3] = First(9, k, deformation.F[k][lane]);
        const First m = mu * pow(determinant(F), -2. / 3);
        for (int k = 0; k < 9; ++k)
          {
            const First P = m * F.entry[k / 3][k % 3];
            raise(errors.P, std::abs(response.P[k][lane] - P.val()) / mu);
            for (int l = 0; l < 9; ++l)
              raise(errors.A, std::abs(response.A[9 * k + l][lane] - P.dx(l)) / mu);
          }
      }
    return errors;
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Deformation                        deformation = samples();
  for (const std::string &name : energy_names.names())
    {
      const Energy kind = energy_names.value(name, "");
      Response     response;
      make_distortional_energy(kind, {mu, kappa, ratio})->evaluate(deformation, true, response);
      Errors errors
          = compare(deformation, response, [&](const Tensor<Second> &F) { return psi(kind, F); });
      if (kind == Energy::simplified_bonet_wood)
        {
          const double energy = errors.energy;
          errors              = compare_simplified(deformation, response);
          errors.energy       = energy;
        }
      report(name, errors);
    }
  for (const std::string &name : volumetric_strain_names.names())
    {
      const VolumetricStrain strain     = volumetric_strain_names.value(name, "");
      const auto             volumetric = evaluate(strain, deformation);
      const double           p          = -1.7;
      Response               mixed{}, displacement{};
      mixed.energy        = p * volumetric.phi;
      displacement.energy = .5 * kappa * volumetric.phi * volumetric.phi;
      add_volumetric(deformation, volumetric, batch(p), 0., true, mixed);
      add_volumetric(deformation, volumetric, kappa * volumetric.phi, kappa, true, displacement);
      report("p Phi, Phi = " + name, compare(deformation, mixed, [&](const Tensor<Second> &F) {
               return Second(p * phi(strain, F));
             }));
      report("kappa/2 Phi^2, Phi = " + name,
             compare(deformation, displacement, [&](const Tensor<Second> &F) {
               const Second value = phi(strain, F);
               return Second(kappa / 2 * value * value);
             }));
    }
}
