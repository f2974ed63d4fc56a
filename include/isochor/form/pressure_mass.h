#pragma once

// The mass matrix of the pressures, M = int N_p N_q over the reference body: the metric in which a
// volume error phi (m^dim, per pressure node) is a volumetric strain M^-1 phi. Kept cell by cell.

#include <isochor/algebra/sparse_matrix.h>
#include <isochor/space/discretisation.h>

namespace isochor
{
  template <int dim>
  class PressureMass
  {
  public:
    /// @p discretisation must outlive this.
    explicit PressureMass(const Discretisation<dim> &discretisation);

    /// dst = M src in the pressures, zero in the displacements. Updates the ghost values of @p src.
    /// Collective.
    void vmult(Vector &dst, const Vector &src) const;

    /// dst = M^-1 src in the pressures, zero in the displacements, by conjugate gradients with the
    /// diagonal, which take about as many iterations on any mesh. Collective.
    void solve(Vector &dst, const Vector &src) const;

    /// matrix += factor M in the pressure block of a matrix of the tangent's pattern.
    void add_to(SparseMatrix &matrix, double factor) const;

    /// Diagonal of M, zero in the displacements.
    const Vector &diagonal() const
    {
      return diagonal_;
    }

  private:
    const Discretisation<dim> &discretisation;
    std::vector<double>        local; ///< [(cell * n_p + j) * n_p + k]
    Vector                     diagonal_;
  };
} // namespace isochor
