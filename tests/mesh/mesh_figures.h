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
  template <int dim>
  const std::vector<dealii::CellData<dim - 1>> &boundary_faces(const RawMesh<dim> &mesh)
  {
    if constexpr (dim == 2)
      return mesh.boundary.boundary_lines;
    else
      return mesh.boundary.boundary_quads;
  }

  template <int dim>
  double face_area(const std::vector<dealii::Point<dim>> &v)
  {
    if constexpr (dim == 2)
      return v[0].distance(v[1]);
    else
      return cross_product_3d(v[1] - v[0], v[2] - v[0]).norm() / 2;
  }

  template <int dim>
  double signed_volume(const RawMesh<dim> &mesh, const dealii::CellData<dim> &cell)
  {
    dealii::Tensor<2, dim> edges;
    for (unsigned int d = 0; d < dim; ++d)
      edges[d] = mesh.vertices[cell.vertices[d + 1]] - mesh.vertices[cell.vertices[0]];
    return determinant(edges) / (dim == 2 ? 2 : 6);
  }

  template <int dim>
  std::map<std::string, double> areas(const RawMesh<dim> &mesh)
  {
    std::map<std::string, double> area;
    for (const auto &face : boundary_faces(mesh))
      {
        std::vector<dealii::Point<dim>> v;
        for (unsigned int i = 0; i < dim; ++i)
          v.push_back(mesh.vertices[face.vertices[i]]);
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
      for (unsigned int opposite = 0; opposite <= dim; ++opposite)
        {
          std::set<unsigned int> face(cell.vertices.begin(), cell.vertices.end());
          face.erase(cell.vertices[opposite]);
          ++cells_of_face[face];
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
