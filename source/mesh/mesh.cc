#include <isochor/mesh/mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_tools.h>

#include <limits>

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

    // One description at a time is built and sent away, so that rank 0 holds the whole mesh and one
    // part. (deal.II's create_description_from_triangulation_in_groups does the same, but
    // creates the mesh itself: an error there would leave the other ranks waiting.)
    template <int dim>
    Description<dim> scatter(const dealii::Triangulation<dim> &whole, MPI_Comm communicator)
    {
      using namespace dealii::TriangulationDescription;
      const auto describe = [&](const unsigned int rank) {
        return Utilities::create_description_from_triangulation(
            whole, communicator, Settings::default_setting, rank);
      };
      if (MPI::this_mpi_process(communicator) == 0)
        {
          for (unsigned int rank = 1; rank < MPI::n_mpi_processes(communicator); ++rank)
            {
              const std::vector<char> buffer = dealii::Utilities::pack(describe(rank), false);
              AssertThrow(buffer.size() <= std::numeric_limits<int>::max(),
                          dealii::ExcMessage("A rank's part of the mesh exceeds 2 GB."));
              check_mpi(MPI_Send(buffer.data(),
                                 static_cast<int>(buffer.size()),
                                 MPI_CHAR,
                                 rank,
                                 description_tag,
                                 communicator));
            }
          return describe(0);
        }

      MPI_Status status;
      int        size = 0;
      check_mpi(MPI_Probe(0, description_tag, communicator, &status));
      check_mpi(MPI_Get_count(&status, MPI_CHAR, &size));
      std::vector<char> buffer(size);
      check_mpi(MPI_Recv(
          buffer.data(), size, MPI_CHAR, 0, description_tag, communicator, MPI_STATUS_IGNORE));
      auto description = dealii::Utilities::unpack<Description<dim>>(buffer, false);
      description.comm = communicator; // not part of what is packed
      return description;
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
    on_root_collectively(communicator, [&] {
      RawMesh<dim> raw = make();
      raise_ids(raw);
      whole.create_triangulation(raw.vertices, raw.cells, raw.boundary);
      if (MPI::n_mpi_processes(communicator) > 1)
        part(whole);
      mesh->names   = std::move(raw.names);
      mesh->quality = raw.quality;
    });

    mesh->triangulation.create_triangulation(scatter(whole, communicator));
    lower_ids(mesh->triangulation);
    mesh->names      = MPI::broadcast(communicator, mesh->names);
    MeshQuality &q   = mesh->quality;
    const auto   all = MPI::broadcast(communicator,
                                    std::vector<double>{q.min_angle, q.max_aspect, q.total_volume});
    q                = {all[0], all[1], all[2]};
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
