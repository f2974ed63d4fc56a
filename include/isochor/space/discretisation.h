#pragma once

// A mesh with an element on it: the numbering of the unknowns and, for every cell that this rank
// computes, the local indices and affine geometry that kernels read. Made once per run; the
// Newton loop sees nothing of deal.II's cells.
//
// Numbering. Each field is one scalar element with its own DoFHandler (nodes); the unknowns of
// rank r are the displacement components dim * i + c of its nodes, then its pressures, so that
// the range of each rank is contiguous and one distributed vector holds the state.
//
// Cells. A rank loops over its own cells and the ghost cells that touch an unknown it owns, and
// writes only owned rows: assembly needs no communication.

#include <isochor/core/types.h>
#include <isochor/element/element_table.h>
#include <isochor/element/lagrange_simplex.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/base/types.h>

#include <memory>

namespace dealii
{
  template <int dim, int spacedim>
  class Triangulation;
}

namespace isochor
{
  /// Tables of the cells this rank computes, owned cells first.
  template <int dim>
  struct CellTables
  {
    unsigned int n_owned = 0;
    unsigned int n_cells = 0;
    unsigned int n_x     = 0; ///< displacement nodes per cell
    unsigned int n_p     = 0; ///< pressure nodes per cell, 0 for displacement elements

    /// [cell * n_x + a]: local index of component 0 of displacement node a; component c is at
    /// + c. For cubics, the two nodes of an edge are already in the order of the shape functions.
    std::vector<LocalIndex> x;
    /// [cell * n_p + j]: local index of pressure node j.
    std::vector<LocalIndex> p;
    /// [(cell * dim + k) * dim + J] = d xi_k / d X_J, 1/m.
    std::vector<double> inverse_jacobian;
    /// det dX / d xi > 0, m^dim; the volume is this divided by dim!.
    std::vector<double> determinant;
    /// [cell * (dim + 1) + v]: reference positions of the vertices, m.
    std::vector<dealii::Point<dim>> vertices;
    /// Is the unknown's row on this rank? Shorthand for local index < n_owned_unknowns.
    LocalIndex n_owned_unknowns = 0;

    /// Reference position of a reference-cell point of a cell.
    dealii::Point<dim> position(unsigned int cell, const dealii::Point<dim> &xi) const;
    /// [k][J] as in inverse_jacobian.
    const double *inverse(const unsigned int cell) const
    {
      return &inverse_jacobian[cell * dim * dim];
    }
  };

  struct BoundaryFace
  {
    LocalIndex                 cell; ///< index into CellTables
    unsigned int               face; ///< number within the cell
    dealii::types::boundary_id id;
    bool                       owned; ///< by ownership of the cell: sum over these once
  };

  template <int dim>
  class Discretisation
  {
  public:
    /// Collective. @p triangulation must outlive this object's construction only.
    Discretisation(const dealii::Triangulation<dim, dim> &triangulation, const Element &element);

    const Element              element;
    const LagrangeSimplex<dim> x_shape;
    /// Degree 0 for displacement elements, where it is not used.
    const LagrangeSimplex<dim> p_shape;

    CellTables<dim>           cells;
    std::vector<BoundaryFace> boundary_faces;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

    /// Of each locally owned unknown: the global displacement node it lives on (a pressure: the
    /// displacement node at the same place or nearest to it in the cell).
    std::vector<GlobalIndex> node_of_row;

    GlobalIndex n_displacement_nodes  = 0; ///< over all ranks
    GlobalIndex n_pressures           = 0; ///< over all ranks
    GlobalIndex n_cells               = 0; ///< over all ranks
    LocalIndex  n_owned_displacements = 0; ///< scalar unknowns; pressures follow in the vector

    GlobalIndex n_unknowns() const
    {
      return dim * n_displacement_nodes + n_pressures;
    }
    MPI_Comm communicator() const
    {
      return partitioner->get_mpi_communicator();
    }
    /// A zero vector of all unknowns with ghost entries.
    Vector make_vector() const
    {
      return Vector(partitioner);
    }
  };
} // namespace isochor
