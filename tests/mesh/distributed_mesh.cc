// The distributed mesh against the whole one: each cell is owned once, boundaries keep their areas
// and ghost cells' faces their ids, and the ghost layer holds every cell that shares a vertex with
// an owned one.

#include "../common/report.h"
#include "mesh_figures.h"

#include <isochor/mesh/cell_geometry.h>
#include <isochor/mesh/mesh.h>

#include <deal.II/grid/tria.h>

using namespace isochor;
using namespace isochor::testing;
using dealii::Utilities::MPI::sum;

// A vertex or cell by its place, to the nanometre: the same on every rank.
template <int dim>
using Place = std::array<long long, dim>;

template <int dim>
Place<dim> place(const dealii::Point<dim> &point)
{
  Place<dim> place;
  for (unsigned int d = 0; d < dim; ++d)
    place[d] = std::llround(point[d] * 1e9);
  return place;
}

// cell->center() and face->center() of hexahedra are something else.
template <typename Cell>
auto centre_of_vertices(const Cell &cell)
{
  auto centre = cell->vertex(0);
  for (unsigned int v = 1; v < cell->n_vertices(); ++v)
    centre += cell->vertex(v);
  return centre / static_cast<double>(cell->n_vertices());
}

// deal.II knows that a face of four vertices need not be flat; the test's figures do not.
template <int dim, typename Face>
double area_of(const Face &face)
{
  std::vector<dealii::Point<dim>> vertices;
  for (const unsigned int v : face->vertex_indices())
    vertices.push_back(face->vertex(v));
  return face_area<dim>(vertices);
}

template <int dim>
void show(const std::string &title, const MeshRequest &request)
{
  const auto                        mesh = make_mesh<dim>(request, MPI_COMM_WORLD);
  const dealii::Triangulation<dim> &tria = mesh->triangulation;
  std::map<std::string, double>     area;
  std::set<Place<dim>>              owned_vertices, cells_here;
  double                            n_owned = 0, volume = 0, n_wrong_ids = 0;

  // Here each rank makes the whole mesh again, to compare with.
  const auto                                       whole = make_raw_mesh<dim>(request);
  std::map<Place<dim>, dealii::types::boundary_id> id_of_face;
  for (const auto &face : boundary_faces(whole))
    {
      dealii::Point<dim> centre;
      for (const unsigned int v : face.vertices)
        centre += whole.vertices[v] / static_cast<double>(face.vertices.size());
      id_of_face[place(centre)] = face.boundary_id;
    }

  for (const auto &cell : tria.active_cell_iterators())
    if (!cell->is_artificial())
      {
        cells_here.insert(place(centre_of_vertices(cell)));
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary())
              continue;
            // Where the ghost layer ends, faces look like boundary faces to deal.II.
            const auto entry = id_of_face.find(place(centre_of_vertices(face)));
            n_wrong_ids += face->boundary_id()
                           != (entry == id_of_face.end() ? rank_boundary : entry->second);
            n_wrong_ids += entry == id_of_face.end() && cell->is_locally_owned();
            if (cell->is_locally_owned())
              area[face->boundary_id() == unnamed_boundary ? "(unnamed)"
                                                           : mesh->names.at(face->boundary_id())]
                  += area_of<dim>(face);
          }
        if (cell->is_locally_owned())
          {
            ++n_owned;
            volume += cell->measure();
            for (const unsigned int v : cell->vertex_indices())
              owned_vertices.insert(place(cell->vertex(v)));
          }
      }

  // The whole mesh's cells are the coarse cells; by number, and by place so that it proves something.
  const unsigned int n = n_geometry_nodes<dim>(whole.kind, whole.geometry.order);
  double n_wrong_cells = mesh->kind != whole.kind || mesh->geometry.order != whole.geometry.order;
  for (const auto &cell : tria.active_cell_iterators())
    {
      const std::size_t number   = cell->id().get_coarse_cell_id();
      bool              is_wrong = false;
      for (const unsigned int v : cell->vertex_indices())
        is_wrong = is_wrong || cell->vertex(v) != whole.vertices[whole.cells[number].vertices[v]];
      if (whole.geometry.order == 2)
        for (unsigned int i = 0; i < n; ++i)
          is_wrong = is_wrong
                     || mesh->geometry.points.at(cell->active_cell_index() * n + i)
                            != whole.geometry.points[number * n + i];
      n_wrong_cells += is_wrong;
    }
  n_wrong_cells += mesh->geometry.points.size()
                   != (whole.geometry.order == 2 ? n * tria.n_active_cells() : 0);
  // On one rank nothing is reordered.
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    n_wrong_cells += mesh->geometry.points != whole.geometry.points;

  double n_missing = 0;
  for (const auto &cell : whole.cells)
    {
      dealii::Point<dim> centre;
      bool               touches = false;
      for (const unsigned int v : cell.vertices)
        {
          centre += whole.vertices[v] / static_cast<double>(cell.vertices.size());
          touches = touches || owned_vertices.count(place(whole.vertices[v])) > 0;
        }
      n_missing += touches && cells_here.count(place(centre)) == 0;
    }

  const double n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const double most    = dealii::Utilities::MPI::max(n_owned, MPI_COMM_WORLD);
  const double n_all   = sum(n_owned, MPI_COMM_WORLD);
  out() << title << "\n  every cell owned once: " << yes(n_all == whole.cells.size())
        << ", volume: "
        << yes(whole.geometry.order == 2
               || std::abs(sum(volume, MPI_COMM_WORLD) / whole.quality.total_volume - 1) < 1e-12)
        << ", quality: "
        << yes(mesh->quality.min_angle == whole.quality.min_angle
               && mesh->quality.max_aspect == whole.quality.max_aspect
               && mesh->quality.total_volume == whole.quality.total_volume)
        << ", balanced to 10 %: " << yes(most * n_ranks < 1.1 * n_all)
        << "\n  cells missing from the ghost layer " << sum(n_missing, MPI_COMM_WORLD)
        << ", faces with a wrong id " << sum(n_wrong_ids, MPI_COMM_WORLD)
        << ", cells with other vertices or nodes " << sum(n_wrong_cells, MPI_COMM_WORLD) << "\n ";
  auto whole_area = areas(whole);
  out() << " area against the whole mesh's:";
  for (const auto &name : mesh->names)
    out() << " " << name << " " << sum(area[name], MPI_COMM_WORLD) / whole_area[name];
  out() << ", unnamed " << sum(area["(unnamed)"], MPI_COMM_WORLD);
  out() << "\n";
}

int main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                              meshes = ISOCHOR_SOURCE_DIR "/meshes/";

  show<3>("box, 6-tet", {"box(0.3, 0.2, 0.1)", 0.05, {}, Split::six_tets});
  show<3>("box, 5-tet", {"box(0.3, 0.2, 0.1)", 0.05, {}, Split::five_tets});
  show<3>("cantilever", {meshes + "cantilever.geo", 0.05, {}});
  show<3>("tube", {meshes + "inflated_tube.geo", 0.006, {}});
  show<2>("rectangle", {"rectangle(2, 1)", 0.1, {}});

  show<3>("tube, curved", {meshes + "inflated_tube.geo", 0.006, {}, {}, CellKind::simplex, 2});
  show<2>("plane, curved", {meshes + "quarter_annulus.geo", 0.1, {}, {}, CellKind::simplex, 2});
  const auto hex = CellKind::hypercube;
  show<3>("box, hexahedra", {"box(0.3, 0.2, 0.1)", 0.025, {}, {}, hex, 1});
  show<3>("cylinder, hexahedra", {"cylinder(1, 2)", 0.25, {}, {}, hex, 1});
  show<3>("octant, hexahedra", {"sphere_octant(1, 2)", 0.2, {}, {}, hex, 1});
  show<3>("octant, curved hexahedra", {"sphere_octant(1, 2)", 0.2, {}, {}, hex, 2});
  show<3>("tube, curved hexahedra", {meshes + "inflated_tube.geo", 0.006, {}, {}, hex, 2});
  show<2>("plane, curved quadrilaterals", {meshes + "quarter_annulus.geo", 0.1, {}, {}, hex, 2});

  const auto mesh = make_mesh<2>({"rectangle(2, 1)", 0.5, {}}, MPI_COMM_WORLD);
  out() << "top is boundary " << mesh->boundary_id("top", "Fixed") << "\n"
        << message_of<UserError>([&] { mesh->boundary_id("Top", "Scene/Fixed"); })
        << "\n"
        // Found on rank 0, thrown on all.
        << message_of<UserError>([] {
             make_mesh<2>({"rectangle(2)", 0.5, {}}, MPI_COMM_WORLD);
           })
        << "\n";
}
