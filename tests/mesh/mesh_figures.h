#pragma once

// What the mesh tests print of a raw mesh.

#include <isochor/mesh/raw_mesh.h>

#include <deal.II/base/tensor.h>

#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <unistd.h>

namespace isochor::testing
{
  /// Of a flat face: a line, a triangle, or a quadrilateral in deal.II's order.
  template <int dim>
  double face_area(const std::vector<dealii::Point<dim>> &v)
  {
    if constexpr (dim == 2)
      return v[0].distance(v[1]);
    else if (v.size() == 4) // half the product of the diagonals
      return cross_product_3d(v[3] - v[0], v[2] - v[1]).norm() / 2;
    else
      return cross_product_3d(v[1] - v[0], v[2] - v[0]).norm() / 2;
  }

  /// Of simplices: the volume; of hypercubes the smallest Jacobian determinant at a vertex.
  template <int dim>
  double orientation(const RawMesh<dim> &mesh, const dealii::CellData<dim> &cell)
  {
    double smallest = 1e300;
    for (unsigned int v = 0; v < (mesh.kind == CellKind::simplex ? 1 : cell.vertices.size()); ++v)
      {
        dealii::Tensor<2, dim> edges;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int to = mesh.kind == CellKind::simplex ? d + 1 : v ^ 1u << d;
            edges[d] = (mesh.vertices[cell.vertices[to]] - mesh.vertices[cell.vertices[v]])
                       * (mesh.kind == CellKind::hypercube && (v >> d & 1) ? -1. : 1.);
          }
        smallest = std::min(smallest,
                            determinant(edges)
                                / (mesh.kind == CellKind::hypercube ? 1
                                   : dim == 2                       ? 2
                                                                    : 6));
      }
    return smallest;
  }

  template <int dim>
  std::map<std::string, double> areas(const RawMesh<dim> &mesh)
  {
    std::map<std::string, double> area;
    for (const auto &face : boundary_faces(mesh))
      {
        std::vector<dealii::Point<dim>> v;
        for (const unsigned int vertex : face.vertices)
          v.push_back(mesh.vertices[vertex]);
        area[face.boundary_id == unnamed_boundary ? "(unnamed)" : mesh.names[face.boundary_id]]
            += face_area(v);
      }
    return area;
  }

  /// Faces of one cell, of two, of more; counted without the code under test.
  template <int dim>
  std::array<unsigned int, 3> face_counts(const RawMesh<dim> &mesh)
  {
    std::map<std::set<unsigned int>, unsigned int> cells_of_face;
    for (const auto &cell : mesh.cells)
      {
        // A simplex's face lacks one vertex; a hypercube's has those with one bit alike.
        const auto add = [&](const auto &is_in) {
          std::set<unsigned int> face;
          for (unsigned int v = 0; v < cell.vertices.size(); ++v)
            if (is_in(v))
              face.insert(cell.vertices[v]);
          ++cells_of_face[face];
        };
        if (mesh.kind == CellKind::simplex)
          for (unsigned int opposite = 0; opposite <= dim; ++opposite)
            add([&](const unsigned int v) { return v != opposite; });
        else
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int side = 0; side < 2; ++side)
              add([&](const unsigned int v) { return (v >> d & 1) == side; });
      }
    std::array<unsigned int, 3> counts{};
    for (const auto &[face, n] : cells_of_face)
      ++counts[std::min(n, 3u) - 1];
    return counts;
  }

  /// A folder of its own, removed at the end.
  struct Folder
  {
    Folder()
    {
      std::string name = (std::filesystem::temp_directory_path() / "isochor-test-XXXXXX").string();
      path             = mkdtemp(name.data());
    }
    ~Folder()
    {
      std::filesystem::remove_all(path);
    }
    std::string file(const std::string &name) const
    {
      return (path / name).string();
    }
    std::filesystem::path path;
  };

  /// Print the message of the UserError that @p action throws, without the folder's name.
  inline void
  print_error(const std::string &title, const Folder &folder, const std::function<void()> &action)
  {
    std::string text = "NO ERROR";
    try
      {
        action();
      }
    catch (const UserError &error)
      {
        text = error.what();
      }
    const std::string prefix = folder.path.string() + "/";
    for (std::size_t at; (at = text.find(prefix)) != std::string::npos;)
      text.erase(at, prefix.size());
    std::cout << title << "\n  " << text << "\n";
  }
} // namespace isochor::testing
