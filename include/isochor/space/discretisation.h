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

#include <isochor/element/element_table.h>
#include <isochor/mesh/raw_mesh.h>
#include <isochor/space/cell_tables.h>

#include <deal.II/base/partitioner.h>

namespace dealii
{
  template <int dim, int spacedim>
  class Triangulation;
}

namespace isochor
{
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
    /// Collective. @p triangulation must outlive this object's construction only. @p geometry: by
    /// active_cell_index(), if cells are curved. Throws std::logic_error if the cells are not of the
    /// element's kind.
    Discretisation(const dealii::Triangulation<dim, dim> &triangulation,
                   const Element                         &element,
                   const GeometryNodes<dim>              &geometry = {});

  private:
    const std::unique_ptr<const ShapeFunctions<dim>> x_functions, p_functions;

  public:
    const Element              element;
    const ShapeFunctions<dim> &x_shape;
    /// Constant for displacement elements, where it is not used.
    const ShapeFunctions<dim> &p_shape;

    CellTables<dim>           cells;
    std::vector<BoundaryFace> boundary_faces;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

    /// Of each locally owned unknown: the node of the elimination order that it belongs to, on the
    /// same rank. A displacement: its own; a continuous pressure: the displacement node at the same
    /// place or nearest to it in the cell; the pressures of one cell alone: its interior node or, if
    /// it has none, a node of their own, numbered behind the displacement nodes.
    std::vector<GlobalIndex> node_of_row;
    GlobalIndex              n_nodes = 0; ///< that node_of_row counts, over all ranks

    /// Locally owned unknowns that couple with those of one cell only, bubbles or discontinuous
    /// pressures: first unknown and number of each group. They may be eliminated before the others.
    std::vector<std::pair<LocalIndex, unsigned int>> interior_displacements, interior_pressures;

    GlobalIndex n_displacement_nodes  = 0; ///< over all ranks
    GlobalIndex n_pressures           = 0; ///< over all ranks
    GlobalIndex n_cells               = 0; ///< over all ranks
    LocalIndex  n_owned_displacements = 0; ///< scalar unknowns; pressures follow in the vector
    double      mean_cell_size        = 0; ///< of the d-th root of determinants, m

    GlobalIndex n_unknowns() const
    {
      return dim * n_displacement_nodes + n_pressures;
    }
    MPI_Comm communicator() const
    {
      return partitioner->get_mpi_communicator();
    }
    /// Quadrature degree of the cells: the element's, two more if simplices are curved.
    unsigned int quadrature_degree() const
    {
      return element.quadrature_degree
             + (element.kind == CellKind::simplex && !cells.all_affine ? 2 : 0);
    }
    /// Quadrature degree that integrates a displacement over the reference body exactly.
    unsigned int volume_degree() const;
    /// A zero vector of all unknowns with ghost entries.
    Vector make_vector() const
    {
      return Vector(partitioner);
    }
  };
} // namespace isochor
