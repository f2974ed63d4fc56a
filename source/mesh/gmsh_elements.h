#pragma once

// Which of gmsh's elements are cells that we can use. Within a GmshSession.

#include <isochor/mesh/mesh_request.h>

#include <map>

namespace isochor
{
  /// What gmsh says of a type of element.
  struct ElementType
  {
    explicit ElementType(int number);

    /// "tetrahedra", for messages.
    std::string family() const;

    std::string         name; ///< "Tetrahedron 10"
    int                 dim, order, n_nodes, n_vertices;
    std::vector<double> coordinates; ///< of the nodes on gmsh's reference element
  };

  /// For each node of ours its place among gmsh's; empty if gmsh has other nodes (a quadrilateral
  /// of 8).
  template <int dim>
  std::vector<unsigned int> node_order(const ElementType &type, CellKind kind, unsigned int order);

  /// Throws UserError, starting with @p origin, unless these are cells as asked for: of one kind
  /// and order. @p n_cells: how many of each type there are.
  template <int dim>
  void check_types(const std::map<int, std::size_t> &n_cells,
                   const MeshRequest                &request,
                   const std::string                &origin);
} // namespace isochor
