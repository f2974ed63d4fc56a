#pragma once

// Meshes of the unit box for tests, with the boundaries left, right, bottom, top, back, front.

#include <isochor/mesh/mesh.h>

#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

namespace isochor::testing
{
  /// Unstructured, by gmsh.
  template <int dim>
  std::unique_ptr<Mesh<dim>> gmsh_box(const double size)
  {
    const std::string file = dim == 2 ? "unit_square.geo" : "unit_cube.geo";
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::ofstream(file) << (dim == 2 ? "SetFactory(\"OpenCASCADE\");\n"
                                         "Rectangle(1) = {0, 0, 0, 1, 1};\n"
                                         "Physical Curve(\"bottom\") = {1};\n"
                                         "Physical Curve(\"right\") = {2};\n"
                                         "Physical Curve(\"top\") = {3};\n"
                                         "Physical Curve(\"left\") = {4};\n"
                                         "Physical Surface(\"body\") = {1};\n"
                                       : "SetFactory(\"OpenCASCADE\");\n"
                                         "Box(1) = {0, 0, 0, 1, 1, 1};\n"
                                         "Physical Surface(\"left\") = {1};\n"
                                         "Physical Surface(\"right\") = {2};\n"
                                         "Physical Surface(\"bottom\") = {3};\n"
                                         "Physical Surface(\"top\") = {4};\n"
                                         "Physical Surface(\"back\") = {5};\n"
                                         "Physical Surface(\"front\") = {6};\n"
                                         "Physical Volume(\"body\") = {1};\n");
    MeshRequest request;
    request.source = file;
    request.size   = size;
    return make_mesh<dim>(request, MPI_COMM_WORLD);
  }

  /// n blocks per direction, for simplices each cut into 2 triangles or 6 tetrahedra.
  template <int dim>
  MeshRequest box_request(const unsigned int n, const CellKind kind = CellKind::simplex)
  {
    MeshRequest request;
    request.kind   = kind;
    request.source = dim == 2 ? "rectangle(1, 1)" : "box(1, 1, 1)";
    request.cells.assign(dim, n);
    request.split = dim == 2 ? Split::right_diagonal : Split::six_tets;
    return request;
  }

  /// The same, with interior vertices moved at random, each simplex' vertices in a random (positive)
  /// order, and ranks that meet at a ragged surface.
  template <int dim>
  std::unique_ptr<Mesh<dim>> distorted_box(const unsigned int n,
                                           const CellKind     kind = CellKind::simplex)
  {
    auto         raw = make_raw_mesh<dim>(box_request<dim>(n, kind));
    std::mt19937 random(7);

    std::uniform_real_distribution<double> shift(-0.13 / n, 0.13 / n);
    for (auto &vertex : raw.vertices)
      {
        bool inside = true;
        for (unsigned int d = 0; d < dim; ++d)
          inside = inside && vertex[d] > 1e-9 && vertex[d] < 1. - 1e-9;
        for (unsigned int d = 0; d < dim && inside; ++d)
          vertex[d] += shift(random);
      }
    // Cyclic permutations of three vertices are even.
    for (auto &cell : raw.cells)
      for (unsigned int turn = 0; turn < (kind == CellKind::simplex ? 4 : 0); ++turn)
        {
          const unsigned int          keep = random() % (dim + 1);
          std::array<unsigned int, 3> three{};
          for (unsigned int v = 0, k = 0; v <= dim && k < 3; ++v)
            if (dim == 2 || v != keep)
              three[k++] = v;
          std::swap(cell.vertices[three[0]], cell.vertices[three[1]]);
          std::swap(cell.vertices[three[1]], cell.vertices[three[2]]);
        }

    dealii::Triangulation<dim> whole;
    whole.create_triangulation(raw.vertices, raw.cells, raw.boundary);
    const int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    for (const auto &cell : whole.active_cell_iterators())
      {
        const auto   centre = cell->center();
        const double place  = centre[0] + 0.2 * std::sin(40. * centre[1] + 20. * centre[dim - 1]);
        cell->set_subdomain_id(std::clamp(static_cast<int>(n_ranks * place), 0, n_ranks - 1));
      }

    auto mesh = std::make_unique<Mesh<dim>>(MPI_COMM_WORLD);
    mesh->triangulation.create_triangulation(
        dealii::TriangulationDescription::Utilities::create_description_from_triangulation(
            whole, MPI_COMM_WORLD));
    mesh->kind  = kind;
    mesh->names = raw.names;
    return mesh;
  }

  /// Distorted boxes of both kinds of cells.
  template <int dim>
  class DistortedBoxes
  {
  public:
    explicit DistortedBoxes(const unsigned int n)
      : meshes{distorted_box<dim>(n), distorted_box<dim>(n, CellKind::hypercube)}
    {
    }

    const Mesh<dim> &operator[](const CellKind kind) const
    {
      return *meshes[static_cast<unsigned int>(kind)];
    }

  private:
    std::array<std::unique_ptr<Mesh<dim>>, 2> meshes;
  };
} // namespace isochor::testing
