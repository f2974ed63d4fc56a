#include <isochor/core/reference_cell.h>

#include <deal.II/grid/reference_cell.h>

namespace isochor
{
  namespace
  {
    template <int dim>
    std::vector<std::vector<unsigned int>> make_faces(const CellKind kind)
    {
      const auto                             cell = reference_cell<dim>(kind);
      std::vector<std::vector<unsigned int>> faces(cell.n_faces());
      for (unsigned int face = 0; face < faces.size(); ++face)
        for (unsigned int v = 0; v < cell.face_reference_cell(face).n_vertices(); ++v)
          faces[face].push_back(cell.face_to_cell_vertices(face, v, 1));
      return faces;
    }

    template <int dim>
    std::vector<std::array<unsigned int, 2>> make_edges(const CellKind kind)
    {
      std::vector<std::array<unsigned int, 2>> edges;
      const auto                               cell = reference_cell<dim>(kind);
      if constexpr (dim == 2)
        for (const auto &face : make_faces<2>(kind))
          edges.push_back({{face[0], face[1]}});
      else
        for (unsigned int edge = 0; edge < cell.n_lines(); ++edge)
          {
            const auto [face, line] = cell.standard_line_to_face_and_line_index(edge);
            const auto on_face      = cell.face_reference_cell(face);
            edges.emplace_back();
            for (unsigned int end = 0; end < 2; ++end)
              {
                // A triangle's line l goes from its vertex l to l + 1; deal.II 9.4.1 has no
                // function for lines of cells.
                const unsigned int vertex = on_face == dealii::ReferenceCells::Triangle
                                                ? (line + end) % 3
                                                : on_face.face_to_cell_vertices(line, end, 1);
                edges.back()[end]         = cell.face_to_cell_vertices(face, vertex, 1);
              }
          }
      return edges;
    }
  } // namespace

  std::string cells_name(const CellKind kind, const int dim)
  {
    if (kind == CellKind::simplex)
      return dim == 2 ? "triangles" : "tetrahedra";
    return dim == 2 ? "quadrilaterals" : "hexahedra";
  }

  template <int dim>
  dealii::ReferenceCell reference_cell(const CellKind kind)
  {
    return kind == CellKind::simplex ? dealii::ReferenceCells::get_simplex<dim>()
                                     : dealii::ReferenceCells::get_hypercube<dim>();
  }

  template <int dim>
  dealii::Point<dim> reference_vertex(const CellKind kind, const unsigned int vertex)
  {
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = kind == CellKind::simplex ? vertex == d + 1 : vertex >> d & 1;
    return point;
  }

  template <int dim>
  dealii::Point<dim> reference_centre(const CellKind kind)
  {
    dealii::Point<dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = kind == CellKind::simplex ? 1. / (dim + 1) : 0.5;
    return centre;
  }

  template <int dim>
  const std::vector<std::array<unsigned int, 2>> &reference_edges(const CellKind kind)
  {
    static const std::array edges{make_edges<dim>(CellKind::simplex),
                                  make_edges<dim>(CellKind::hypercube)};
    return edges[static_cast<unsigned int>(kind)];
  }

  template <int dim>
  const std::vector<std::vector<unsigned int>> &reference_faces(const CellKind kind)
  {
    static const std::array faces{make_faces<dim>(CellKind::simplex),
                                  make_faces<dim>(CellKind::hypercube)};
    return faces[static_cast<unsigned int>(kind)];
  }

  template dealii::ReferenceCell                           reference_cell<2>(CellKind);
  template dealii::ReferenceCell                           reference_cell<3>(CellKind);
  template dealii::Point<1>                                reference_vertex(CellKind, unsigned int);
  template dealii::Point<2>                                reference_vertex(CellKind, unsigned int);
  template dealii::Point<3>                                reference_vertex(CellKind, unsigned int);
  template dealii::Point<2>                                reference_centre(CellKind);
  template dealii::Point<3>                                reference_centre(CellKind);
  template const std::vector<std::array<unsigned int, 2>> &reference_edges<2>(CellKind);
  template const std::vector<std::array<unsigned int, 2>> &reference_edges<3>(CellKind);
  template const std::vector<std::vector<unsigned int>>   &reference_faces<2>(CellKind);
  template const std::vector<std::vector<unsigned int>>   &reference_faces<3>(CellKind);
} // namespace isochor
