#pragma once

// Displacement, pressure, J and stress at points of a cell, for pictures and point values.

#include <isochor/core/batch.h>
#include <isochor/material/distortional_energy.h>
#include <isochor/scene/scene.h>
#include <isochor/space/discretisation.h>

namespace isochor
{
  template <int dim>
  struct PointFields
  {
    dealii::Tensor<1, dim> displacement; ///< m
    /// Pa, positive in tension: the pressure unknown of a mixed element, kappa Phi(J) of a
    /// displacement element.
    double pressure = 0;
    double J        = 0; ///< det F
    /// Pa: sqrt(3/2 dev sigma : dev sigma) of the full three-dimensional Cauchy stress, sigma_33 of
    /// plane strain included.
    double von_mises = 0;
  };

  /// What the residual is made of at a point.
  template <int dim>
  struct PointForces
  {
    dealii::Tensor<2, dim> stress;          ///< dpsi_d/dF; of displacement elements all of P, Pa
    dealii::Tensor<2, dim> volume_gradient; ///< dPhi/dF; zero of displacement elements
    double                 pressure = 0;    ///< as in PointFields
    double                 misfit   = 0;    ///< Phi - p / kappa; zero of displacement elements
  };

  /// Gradient of a displacement field, d u_i / d X_J, and the pressure beside it.
  template <int dim>
  struct PointGradients
  {
    dealii::Tensor<2, dim> gradient;
    double                 pressure = 0; ///< 0 without pressures as unknowns
  };

  template <int dim>
  class CellFields
  {
  public:
    /// Shape functions at fixed points of the reference cell, in batches of eight.
    class Points
    {
    public:
      unsigned int size() const
      {
        return n_points;
      }

    private:
      friend class CellFields;

      struct XShape
      {
        Batch value;
        Batch gradient[dim]; ///< d/d xi_k
      };
      struct PShape
      {
        Batch value;
      };

      unsigned int                              n_points;
      std::shared_ptr<const GeometryTable<dim>> geometry;
      std::vector<XShape>                       x; ///< [batch * n_x + a]
      std::vector<PShape>                       p; ///< [batch * n_p + j]
    };

    /// @p discretisation must outlive this. Throws std::logic_error for a displacement element at
    /// nu = 0.5, which is refused before.
    CellFields(const Discretisation<dim> &discretisation, const Material &material);

    Points tabulate(const std::vector<dealii::Point<dim>> &reference_points) const;

    /// Fields at the points of a cell of this rank. @p values: the state's local entries, ghosts
    /// up to date (Vector::begin()). Where a field does not exist (log J of an inverted cell) it
    /// is NaN. @p fields is resized to the number of points.
    void evaluate(std::size_t                    cell,
                  const Points                  &points,
                  const double                  *values,
                  std::vector<PointFields<dim>> &fields) const;

    /// The same of stress and volumetric misfit.
    void evaluate(std::size_t                    cell,
                  const Points                  &points,
                  const double                  *values,
                  std::vector<PointForces<dim>> &forces) const;

    /// The same of a state's derivatives, whatever it is a state of.
    void evaluate(std::size_t                       cell,
                  const Points                     &points,
                  const double                     *values,
                  std::vector<PointGradients<dim>> &gradients) const;

  private:
    /// Eight points of a cell.
    struct Here
    {
      Batch displacement[dim], gradient[dim][dim], pressure;
    };
    Here
    at(std::size_t cell, const Points &points, unsigned int batch_no, const double *values) const;

    /// What the material makes of them.
    struct Constitutive
    {
      Deformation        deformation;
      Response           response; ///< of psi_d; of displacement elements also of the pressure
      VolumetricResponse volumetric;
      Batch              pressure;
    };
    Constitutive respond(const Here &here) const;

    bool is_mixed() const
    {
      return discretisation.cells.n_p > 0;
    }

    const Discretisation<dim>                &discretisation;
    std::unique_ptr<const DistortionalEnergy> energy;
    VolumetricStrain                          volumetric_strain;
    Moduli                                    moduli;
  };
} // namespace isochor
