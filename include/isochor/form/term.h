#pragma once

// A term of the Lagrangian L(u, p): its value, its contribution to the residual dL/d(u, p) and to
// the tangent d2L/d(u, p)2. Terms know no solver; they add to what they are given.

#include <isochor/algebra/sparse_matrix.h>
#include <isochor/form/curvature_filter.h>

#include <limits>

namespace isochor
{
  struct CellOffsets;
  class PredictedStress;

  struct Evaluation
  {
    double value        = 0;                                       ///< J, of the cells owned here
    double min_jacobian = std::numeric_limits<double>::infinity(); ///< over quadrature points
  };

  /// Where to add; a null pointer means not wanted.
  struct Target
  {
    Vector            *residual = nullptr; ///< ghost entries are scratch
    SparseMatrix      *tangent  = nullptr;
    const CellOffsets *offsets  = nullptr; ///< of the tangent
    /// The geometric stiffness of this stress in the place of the state's.
    const PredictedStress *stress = nullptr;
    /// The tangent's product with this direction (ghosts up to date), without a matrix; not together
    /// with a residual.
    const Vector *direction = nullptr;
    Vector       *product   = nullptr; ///< ghost entries are scratch
    /// Of the tangent's displacement block, cell by cell.
    CurvatureFilter filter = CurvatureFilter::none;
  };

  class Term
  {
  public:
    virtual ~Term() = default;

    /// @p state with up-to-date ghosts; @p load is the load factor. Not collective: rows owned by
    /// this rank are complete afterwards, value and min_jacobian are of this rank.
    virtual Evaluation add(const Vector &state, double load, const Target &target) const = 0;
  };
} // namespace isochor
