#include <isochor/mesh/cell_geometry.h>
#include <isochor/mesh/mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_tools.h>

#include <limits>
#include <unordered_map>

namespace isochor
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    template <int dim>
    using Description = dealii::TriangulationDescription::Description<dim, dim>;

    constexpr int description_tag = 417;

    // deal.II gives the outside of the ghost layer the boundary id 0, as if it bore the first name.
    // So ids travel one higher than they are, and what arrives as 0 is none of the body's.
    template <int dim>
    void raise_ids(RawMesh<dim> &raw)
    {
      for (auto &face : raw.boundary.boundary_lines)
        ++face.boundary_id;
      for (auto &face : raw.boundary.boundary_quads)
        ++face.boundary_id;
    }

    template <int dim>
    void lower_ids(dealii::Triangulation<dim> &triangulation)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            face->set_boundary_id(face->boundary_id() == 0 ? rank_boundary
                                                           : face->boundary_id() - 1);
    }

    void check_mpi(const int error)
    {
      if (error != MPI_SUCCESS)
        throw std::runtime_error("MPI could not hand out the mesh");
    }

    // What one rank gets.
    template <int dim>
    struct Part
    {
      Description<dim>                description;
      std::vector<dealii::Point<dim>> nodes; ///< of the description's coarse cells, in their order
    };

    template <int dim>
    Part<dim> part_of(const dealii::Triangulation<dim> &whole,
                      const RawMesh<dim>               &raw,
                      const unsigned int                rank,
                      MPI_Comm                          communicator)
    {
      using namespace dealii::TriangulationDescription;
      Part<dim> part{Utilities::create_description_from_triangulation(
                         whole, communicator, Settings::default_setting, rank),
                     {}};
      // The number of a coarse cell of the whole mesh is that in the raw mesh.
      const unsigned int n
          = raw.geometry.order == 1 ? 0 : n_geometry_nodes<dim>(raw.kind, raw.geometry.order);
      for (const auto cell : part.description.coarse_cell_index_to_coarse_cell_id)
        for (unsigned int i = 0; i < n; ++i)
          part.nodes.push_back(raw.geometry.points[cell * n + i]);
      return part;
    }

    // One part at a time is built and sent away, so that rank 0 holds the whole mesh and one
    // part. (deal.II's create_description_from_triangulation_in_groups does the same, but
    // creates the mesh itself: an error there would leave the other ranks waiting.)
    template <int dim>
    Part<dim>
    scatter(const dealii::Triangulation<dim> &whole, const RawMesh<dim> &raw, MPI_Comm communicator)
    {
      if (MPI::this_mpi_process(communicator) == 0)
        {
          for (unsigned int rank = 1; rank < MPI::n_mpi_processes(communicator); ++rank)
            {
              const Part<dim>         part = part_of(whole, raw, rank, communicator);
              const std::vector<char> buffer
                  = dealii::Utilities::pack(std::make_pair(part.description, part.nodes), false);
              AssertThrow(buffer.size() <= std::numeric_limits<int>::max(),
                          dealii::ExcMessage("A rank's part of the mesh exceeds 2 GB."));
              check_mpi(MPI_Send(buffer.data(),
                                 static_cast<int>(buffer.size()),
                                 MPI_CHAR,
                                 rank,
                                 description_tag,
                                 communicator));
            }
          return part_of(whole, raw, 0, communicator);
        }

      MPI_Status status;
      int        size = 0;
      check_mpi(MPI_Probe(0, description_tag, communicator, &status));
      check_mpi(MPI_Get_count(&status, MPI_CHAR, &size));
      std::vector<char> buffer(size);
      check_mpi(MPI_Recv(
          buffer.data(), size, MPI_CHAR, 0, description_tag, communicator, MPI_STATUS_IGNORE));
      auto [description, nodes]
          = dealii::Utilities::unpack<std::pair<Description<dim>, std::vector<dealii::Point<dim>>>>(
              buffer, false);
      description.comm = communicator; // not part of what is packed
      return {std::move(description), std::move(nodes)};
    }

    // The nodes of @p part in the order of the active cells that deal.II made of it.
    template <int dim>
    std::vector<dealii::Point<dim>> nodes_by_active_cell(const Part<dim> &part,
                                                         const Mesh<dim> &mesh)
    {
      const unsigned int n   = n_geometry_nodes<dim>(mesh.kind, mesh.geometry.order);
      const auto        &ids = part.description.coarse_cell_index_to_coarse_cell_id;
      std::unordered_map<dealii::types::coarse_cell_id, std::size_t> place;
      for (std::size_t i = 0; i < ids.size(); ++i)
        place[ids[i]] = i;

      std::vector<dealii::Point<dim>> nodes(n * mesh.triangulation.n_active_cells());
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        {
          const auto first = part.nodes.begin() + n * place.at(cell->id().get_coarse_cell_id());
          for (const unsigned int v : cell->vertex_indices())
            if (cell->vertex(v) != first[v])
              throw std::logic_error("the vertices of a cell are not where its geometry says");
          std::copy_n(first, n, nodes.begin() + n * cell->active_cell_index());
        }
      return nodes;
    }
  } // namespace

  template <int dim>
  dealii::types::boundary_id Mesh<dim>::boundary_id(const std::string &name,
                                                    const std::string &what) const
  {
    for (std::size_t id = 0; id < names.size(); ++id)
      if (names[id] == name)
        return id;
    throw UserError(what + ": no boundary is named '" + name + "'; this mesh has " + listed(names));
  }

  template <int dim>
  std::unique_ptr<Mesh<dim>>
  distribute(const std::function<RawMesh<dim>()>                     &make,
             const std::function<void(dealii::Triangulation<dim> &)> &part,
             MPI_Comm                                                 communicator)
  {
    auto                       mesh = std::make_unique<Mesh<dim>>(communicator);
    dealii::Triangulation<dim> whole;
    RawMesh<dim>               raw; // on rank 0
    on_root_collectively(communicator, [&] {
      raw = make();
      raise_ids(raw);
      whole.create_triangulation(raw.vertices, raw.cells, raw.boundary);
      raw.vertices.clear();
      raw.vertices.shrink_to_fit();
      raw.cells.clear();
      raw.cells.shrink_to_fit();
      if (MPI::n_mpi_processes(communicator) > 1)
        part(whole);
    });
    mesh->names = MPI::broadcast(communicator, raw.names);
    mesh->kind
        = static_cast<CellKind>(MPI::broadcast(communicator, static_cast<unsigned int>(raw.kind)));
    mesh->geometry.order = MPI::broadcast(communicator, raw.geometry.order);
    MeshQuality &q       = raw.quality;
    const auto   all     = MPI::broadcast(communicator,
                                    std::vector<double>{q.min_angle, q.max_aspect, q.total_volume});
    mesh->quality        = {all[0], all[1], all[2]};

    const Part<dim> part_here = scatter(whole, raw, communicator);
    mesh->triangulation.create_triangulation(part_here.description);
    lower_ids(mesh->triangulation);
    if (mesh->geometry.order > 1)
      mesh->geometry.points = nodes_by_active_cell(part_here, *mesh);
    return mesh;
  }

  template <int dim>
  std::unique_ptr<Mesh<dim>> make_mesh(const MeshRequest &request, MPI_Comm communicator)
  {
    return distribute<dim>([&] { return make_raw_mesh<dim>(request); },
                           [&](dealii::Triangulation<dim> &whole) {
                             const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
                             const unsigned int n_cells = whole.n_active_cells();
                             if (n_cells < n_ranks)
                               throw UserError("Mesh '" + request.source + "': it has "
                                               + std::to_string(n_cells) + " cells, fewer than the "
                                               + std::to_string(n_ranks) + " MPI ranks");
                             dealii::GridTools::partition_triangulation(n_ranks, whole);
                           },
                           communicator);
  }

  template struct Mesh<2>;
  template struct Mesh<3>;
  template std::unique_ptr<Mesh<2>>
  distribute<2>(const std::function<RawMesh<2>()> &,
                const std::function<void(dealii::Triangulation<2> &)> &,
                MPI_Comm);
  template std::unique_ptr<Mesh<3>>
                                    distribute<3>(const std::function<RawMesh<3>()> &,
                const std::function<void(dealii::Triangulation<3> &)> &,
                MPI_Comm);
  template std::unique_ptr<Mesh<2>> make_mesh<2>(const MeshRequest &, MPI_Comm);
  template std::unique_ptr<Mesh<3>> make_mesh<3>(const MeshRequest &, MPI_Comm);
} // namespace isochor
