#pragma once

// The distributed mesh: a deal.II triangulation that each rank holds its share of, and the
// names of its boundaries.

#include <isochor/mesh/raw_mesh.h>

#include <deal.II/distributed/fully_distributed_tria.h>

#include <functional>
#include <memory>

namespace isochor
{
  /// Boundary id of faces where not the body ends but what this rank knows of it: the outside of
  /// the ghost layer. deal.II takes them for boundary faces too. No vertex of theirs belongs to an
  /// owned cell.
  inline constexpr dealii::types::boundary_id rank_boundary = 9998;

  template <int dim>
  struct Mesh
  {
    explicit Mesh(MPI_Comm communicator)
      : triangulation(communicator)
    {
    }

    dealii::parallel::fullydistributed::Triangulation<dim> triangulation;
    CellKind                                               kind = CellKind::simplex;
    /// By active_cell_index() of the triangulation, ghost cells included.
    GeometryNodes<dim>       geometry;
    std::vector<std::string> names; ///< name of boundary id 0, 1, ...; the same on every rank
    MeshQuality              quality;

    /// Throws UserError("<what>: no boundary is named 'name'; this mesh has ...").
    dealii::types::boundary_id boundary_id(const std::string &name, const std::string &what) const;
  };

  /// Collective. Rank 0 makes the whole mesh, parts it (METIS, by shared faces) and hands out the
  /// parts: each rank holds its own cells and every cell that shares a vertex with one of them.
  /// Throws UserError on every rank or on none.
  template <int dim>
  std::unique_ptr<Mesh<dim>> make_mesh(const MeshRequest &request, MPI_Comm communicator);

  /// Collective. The same for a mesh that is there already: on rank 0 @p make gives the whole mesh
  /// and @p part sets the cells' subdomain ids (not called on one rank).
  template <int dim>
  std::unique_ptr<Mesh<dim>>
  distribute(const std::function<RawMesh<dim>()>                     &make,
             const std::function<void(dealii::Triangulation<dim> &)> &part,
             MPI_Comm                                                 communicator);
} // namespace isochor
