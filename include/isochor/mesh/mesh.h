#pragma once

// The distributed mesh: a deal.II triangulation that each rank holds its share of, and the
// names of its boundaries.

#include <isochor/mesh/raw_mesh.h>

#include <deal.II/distributed/fully_distributed_tria.h>

namespace isochor
{
  template <int dim>
  struct Mesh
  {
    explicit Mesh(MPI_Comm communicator)
      : triangulation(communicator)
    {
    }

    dealii::parallel::fullydistributed::Triangulation<dim> triangulation;
    std::vector<std::string> names; ///< name of boundary id 0, 1, ...; the same on every rank
    MeshQuality              quality;

    /// Throws UserError("<what>: no boundary is named 'name'; this mesh has ...").
    dealii::types::boundary_id boundary_id(const std::string &name, const std::string &what) const;
  };

  /// Boundary id of faces that no name was given to.
  inline constexpr dealii::types::boundary_id unnamed_boundary = 9999;

  /// Collective. Rank 0 makes the whole mesh, parts it and hands out the parts.
  template <int dim>
  std::unique_ptr<Mesh<dim>> make_mesh(const MeshRequest &request, MPI_Comm communicator);
} // namespace isochor
