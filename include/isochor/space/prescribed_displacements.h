#pragma once

// Supports as prescribed unknowns: which components of which displacement nodes are held, where
// they must be at a load factor, and how a linear system takes them.

#include <isochor/algebra/sparse_matrix.h>
#include <isochor/scene/scene.h>
#include <isochor/space/discretisation.h>

#include <functional>

namespace isochor
{
  template <int dim>
  class PrescribedDisplacements
  {
  public:
    using BoundaryId = std::function<dealii::types::boundary_id(const std::string &name,
                                                                const std::string &what)>;

    /// Collective. Throws UserError if two supports ask different displacements of the same
    /// component of a node, or if the supports leave a rigid-body motion free.
    PrescribedDisplacements(const Discretisation<dim>       &discretisation,
                            const std::vector<Support<dim>> &supports,
                            const BoundaryId                &boundary_id);

    /// Owned prescribed unknowns, ascending.
    const std::vector<LocalIndex> &unknowns() const
    {
      return owned;
    }

    /// By local index, ghosts included.
    bool is_prescribed(const LocalIndex unknown) const
    {
      return is_prescribed_[unknown];
    }

    /// gap = prescribed displacement at @p load minus that of @p state on the prescribed unknowns,
    /// zero elsewhere; ghosts updated. Returns the largest magnitude over all ranks, metres.
    double gap(const Vector &state, double load, Vector &gap) const;

    /// Turn the prescribed rows into identity rows and move the prescribed columns to the right:
    /// rhs -= A(:, prescribed) gap, rhs(prescribed) = diagonal * gap. Afterwards A dx = rhs has
    /// dx = gap on the prescribed unknowns, and A is as symmetric as it was.
    void apply(SparseMatrix &matrix, Vector &rhs, const Vector &gap) const;

    /// The same for several right-hand sides and their gaps.
    using Sides = std::vector<std::pair<Vector *, const Vector *>>;
    void apply(SparseMatrix &matrix, const Sides &sides) const;

    /// Zero the prescribed entries.
    void set_zero(Vector &vector) const;

  private:
    struct Entry
    {
      LocalIndex         unknown;
      unsigned int       component;
      unsigned int       support;
      dealii::Point<dim> position;
    };

    void collect(const Discretisation<dim> &discretisation, const BoundaryId &boundary_id);
    void check_rigid_modes(MPI_Comm communicator) const;

    std::vector<Support<dim>> supports;
    std::vector<Entry>        entries;        ///< owned, one per unknown, ascending
    std::vector<LocalIndex>   owned;          ///< unknowns of entries
    std::vector<char>         is_prescribed_; ///< by local index, ghosts included
    MPI_Comm                  communicator;
  };
} // namespace isochor
