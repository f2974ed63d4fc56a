#include "gmsh_elements.h"

#include "gmsh_session.h"

#include <isochor/mesh/cell_geometry.h>
#include <isochor/mesh/geo_constant.h>

#include <gmsh.h>

#include <filesystem>

namespace isochor
{
  namespace fs = std::filesystem;

  ElementType::ElementType(const int number)
  {
    gmsh::model::mesh::getElementProperties(
        number, name, dim, order, n_nodes, coordinates, n_vertices);
  }

  std::string ElementType::family() const
  {
    static const std::map<std::string, std::string> plurals = {{"Triangle", "triangles"},
                                                               {"Quadrilateral", "quadrilaterals"},
                                                               {"Tetrahedron", "tetrahedra"},
                                                               {"Hexahedron", "hexahedra"},
                                                               {"Prism", "prisms"},
                                                               {"Pyramid", "pyramids"}};
    const auto plural = plurals.find(name.substr(0, name.find(' ')));
    return plural == plurals.end() ? "elements of type '" + name + "'" : plural->second;
  }

  // Found by place: gmsh's hypercubes are [-1, 1]^dim, its simplices are ours.
  template <int dim>
  std::vector<unsigned int>
  node_order(const ElementType &type, const CellKind kind, const unsigned int order)
  {
    const auto         shape = make_shape_functions<dim>(kind, {Family::lagrange, order});
    const unsigned int n     = shape->n_nodes();
    if (type.n_nodes != static_cast<int>(n))
      return {};
    const std::size_t         stride = type.coordinates.size() / n;
    std::vector<unsigned int> places;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        {
          dealii::Point<dim> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = kind == CellKind::simplex ? type.coordinates[j * stride + d]
                                                 : (type.coordinates[j * stride + d] + 1) / 2;
          if (place.distance(shape->node(i)) < 1e-6)
            places.push_back(j);
        }
    if (places.size() != n)
      throw std::logic_error("gmsh's " + type.name + " has nodes elsewhere");
    return places;
  }

  template <int dim>
  void check_types(const std::map<int, std::size_t> &n_cells,
                   const MeshRequest                &request,
                   const std::string                &origin)
  {
    const bool                         is_geo  = fs::path(request.source).extension() == ".geo";
    const bool                         is_hex  = request.kind == CellKind::hypercube;
    const std::string                  wanted  = cells_name(request.kind, dim);
    const std::string                  simplex = cells_name(CellKind::simplex, dim);
    const std::string                  hex     = cells_name(CellKind::hypercube, dim);
    std::map<std::string, std::size_t> families;
    for (const auto &[number, n] : n_cells)
      families[ElementType(number).family()] += n;

    std::string held;
    for (const auto &[family, n] : families)
      held += (held.empty() ? "" : ", ") + std::to_string(n) + " " + family;
    std::string remesh; // advice for a .geo file
    if (is_geo && !geo_constant(request.source, "hexahedra"))
      remesh = is_hex ? "in the .geo file: DefineConstant[ hexahedra = 0 ], and Recombine where it "
                        "is not 0, as it will be then"
                      : "in the .geo file: no Recombine, no extruded layers with it";
    else if (is_geo)
      remesh = "in the .geo file: make its constant hexahedra, set to "
               + std::string(is_hex ? "1" : "0") + " here, give all " + wanted;

    if (families.size() > 1
        || (families.size() == 1 && !families.count(simplex) && !families.count(hex)))
      throw UserError(origin + ": it holds " + held + "; a mesh is either all " + simplex
                      + " or all " + hex + ", and the element needs " + wanted
                      + (is_geo ? " (" + remesh + ")" : ""));
    if (families.size() == 1 && !families.count(wanted))
      throw UserError(origin + ": it holds " + held + ", the element needs " + wanted
                      + "; choose an element for " + (is_hex ? simplex : hex) + " ("
                      + (is_hex ? "P1, P2, ..." : "Q1, Q2, ...") + ")"
                      + (is_geo ? ", or " + remesh : ", or another mesh"));
    for (const auto &[number, n] : n_cells)
      {
        const ElementType type(number);
        const std::string start = origin + ": it holds " + std::to_string(n) + " " + wanted
                                  + " of order " + std::to_string(type.order) + "; ";
        const std::string setting = is_geo ? "in the .geo file: Mesh.ElementOrder = "
                                           : "have gmsh save Mesh.ElementOrder = ";
        if (type.order > 2)
          throw UserError(start + "only 1 and 2 can be used (" + setting + "1)");
        if (type.order == 2 && request.geometry_order == 1)
          throw UserError(start + "choose Geometry order = 2, or " + setting + "1");
        if (type.order == 1 && request.geometry_order == 2)
          throw UserError(start + "choose Geometry order = 1 (straight edges), or " + setting
                          + "2");
        if (node_order<dim>(type, request.kind, request.geometry_order).empty())
          throw UserError(start + "those of type '" + type.name
                          + "' have no nodes inside their faces; have gmsh save "
                            "Mesh.SecondOrderIncomplete = 0");
      }
  }

  template std::vector<unsigned int> node_order<2>(const ElementType &, CellKind, unsigned int);
  template std::vector<unsigned int> node_order<3>(const ElementType &, CellKind, unsigned int);
  template void
  check_types<2>(const std::map<int, std::size_t> &, const MeshRequest &, const std::string &);
  template void
  check_types<3>(const std::map<int, std::size_t> &, const MeshRequest &, const std::string &);
} // namespace isochor
