#include "block_grid.h"

#include <isochor/mesh/cell_geometry.h>

#include <algorithm>
#include <map>

namespace isochor
{
  namespace
  {
    using dealii::Point;

    // Corners of a block are numbered by bits: corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1).
    // A piece is a cell of the block, by its corners.
    using Piece = std::vector<unsigned int>;

    // Kuhn: one simplex for each order in which a path along the edges may go from the first to the
    // last corner. In 2D that is the cut by the right diagonal. Neighbours fit where the edges
    // between them go the same way.
    template <int dim>
    std::vector<Piece> kuhn_split()
    {
      std::array<unsigned int, dim> axes;
      for (unsigned int d = 0; d < dim; ++d)
        axes[d] = d;
      std::vector<Piece> simplices;
      do
        {
          Piece simplex(dim + 1, 0);
          for (unsigned int d = 0; d < dim; ++d)
            simplex[d + 1] = simplex[d] | (1u << axes[d]);
          unsigned int inversions = 0;
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e < d; ++e)
              inversions += axes[e] > axes[d];
          if (inversions % 2 == 1)
            std::swap(simplex[dim - 1], simplex[dim]);
          simplices.push_back(simplex);
        }
      while (std::next_permutation(axes.begin(), axes.end()));
      return simplices;
    }

    // A core of the four corners of one parity, and one tetrahedron at each other corner.
    // Neighbouring blocks take the other parity, so that the core's corners are the grid points
    // of one colour of a checkerboard.
    std::vector<Piece> five_split(const bool mirrored)
    {
      if (mirrored)
        return {{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}};
      return {{0, 5, 3, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 0, 6}, {7, 3, 5, 6}};
    }

    // The cells of a block whose first corner has an even or an odd colour.
    template <int dim>
    std::array<std::vector<Piece>, 2> pieces_of_block(const CellKind kind, const Split split)
    {
      if (kind == CellKind::hypercube)
        {
          Piece all;
          for (unsigned int c = 0; c < n_vertices(kind, dim); ++c)
            all.push_back(c);
          return {{{all}, {all}}};
        }
      if (split == Split::five_tets)
        return {five_split(false), five_split(true)};
      return {kuhn_split<dim>(), kuhn_split<dim>()};
    }

    // The vertices of a section, each once.
    struct Section
    {
      struct Vertex
      {
        unsigned int patch, a, b, colour;
      };

      explicit Section(const std::vector<Patch> &patches)
        : index(patches.size())
      {
        std::map<std::array<unsigned int, 3>, unsigned int> known;
        for (unsigned int p = 0; p < patches.size(); ++p)
          for (unsigned int b = 0; b <= patches[p].n[1]; ++b)
            for (unsigned int a = 0; a <= patches[p].n[0]; ++a)
              {
                const auto key             = patches[p].key(a, b);
                const auto [entry, is_new] = known.try_emplace(key, vertices.size());
                if (is_new)
                  vertices.push_back({p, a, b, (key[0] + key[1] + key[2]) % 2});
                index[p].push_back(entry->second);
              }
      }

      std::vector<Vertex>                    vertices;
      std::vector<std::vector<unsigned int>> index; ///< [patch][b * (n[0] + 1) + a]
    };

    template <int dim>
    class Filler
    {
    public:
      Filler(const BlockGrid<dim> &grid,
             const CellKind        kind,
             const Split           split,
             const unsigned int    geometry_order)
        : grid(grid)
        , section(grid.patches)
        , pieces(pieces_of_block<dim>(kind, split))
      {
        mesh.kind           = kind;
        mesh.names          = grid.names;
        mesh.geometry.order = geometry_order;
      }

      RawMesh<dim> fill()
      {
        const unsigned int n_layers = dim == 3 ? grid.n_layers : 1;
        for (unsigned int layer = 0; layer < n_layers + (dim == 3); ++layer)
          for (const auto &vertex : section.vertices)
            mesh.vertices.push_back(
                grid.map(vertex.patch, unit(vertex.patch, {vertex.a, vertex.b, layer})));
        for (unsigned int layer = 0; layer < n_layers; ++layer)
          for (unsigned int p = 0; p < grid.patches.size(); ++p)
            for (unsigned int b = 0; b < grid.patches[p].n[1]; ++b)
              for (unsigned int a = 0; a < grid.patches[p].n[0]; ++a)
                add_block(p, {a, b, layer});
        return std::move(mesh);
      }

    private:
      using Index = std::array<unsigned int, 3>; // a, b, layer

      Point<dim> unit(const unsigned int patch, const Index &index) const
      {
        Point<dim> point;
        for (unsigned int d = 0; d < dim; ++d)
          point[d]
              = static_cast<double>(index[d]) / (d < 2 ? grid.patches[patch].n[d] : grid.n_layers);
        return point;
      }

      static Index corner(Index block, const unsigned int c)
      {
        for (unsigned int d = 0; d < dim; ++d)
          block[d] += c >> d & 1;
        return block;
      }

      unsigned int section_vertex(const unsigned int patch, const Index &index) const
      {
        return section.index[patch][index[1] * (grid.patches[patch].n[0] + 1) + index[0]];
      }

      void add_block(const unsigned int patch, const Index &block)
      {
        const unsigned int colour = section.vertices[section_vertex(patch, block)].colour;
        for (const Piece &piece : pieces[(colour + block[2]) % 2])
          {
            dealii::CellData<dim> cell(piece.size());
            for (unsigned int v = 0; v < piece.size(); ++v)
              {
                const Index index = corner(block, piece[v]);
                cell.vertices[v]
                    = index[2] * section.vertices.size() + section_vertex(patch, index);
              }
            mesh.cells.push_back(cell);
            add_faces(patch, block, piece);
            if (mesh.geometry.order == 2)
              add_nodes(patch, block, piece);
          }
      }

      // The faces of the last cell that lie on a side of the body.
      void add_faces(const unsigned int patch, const Index &block, const Piece &piece)
      {
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int end = 0; end < 2; ++end)
            {
              const int id = d < 2 ? grid.patches[patch].sides[2 * d + end] : grid.ends[end];
              const unsigned int n = d < 2 ? grid.patches[patch].n[d] : grid.n_layers;
              if (id < 0 || block[d] != (end == 0 ? 0 : n - 1))
                continue;
              for (const auto &vertices : reference_faces<dim>(mesh.kind))
                if (std::all_of(vertices.begin(), vertices.end(), [&](const unsigned int v) {
                      return (piece[v] >> d & 1) == end;
                    }))
                  {
                    dealii::CellData<dim - 1> face(vertices.size());
                    for (unsigned int v = 0; v < vertices.size(); ++v)
                      face.vertices[v] = mesh.cells.back().vertices[vertices[v]];
                    face.boundary_id = id;
                    boundary_faces(mesh).push_back(face);
                  }
            }
      }

      // The nodes of the last cell.
      void add_nodes(const unsigned int patch, const Index &block, const Piece &piece)
      {
        const auto              vertices = cell_vertices(mesh, mesh.cells.size() - 1);
        std::vector<Point<dim>> units;
        for (const unsigned int c : piece)
          units.push_back(unit(patch, corner(block, c)));
        const auto &nodes = node_vertices<dim>(mesh.kind);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          mesh.geometry.points.push_back(i < piece.size() || grid.has_flat_sides
                                             ? middle(nodes[i], vertices)
                                             : grid.map(patch, middle(nodes[i], units)));
      }

      const BlockGrid<dim>                   &grid;
      const Section                           section;
      const std::array<std::vector<Piece>, 2> pieces;
      RawMesh<dim>                            mesh;
    };
  } // namespace

  template <int dim>
  RawMesh<dim> fill(const BlockGrid<dim> &grid,
                    const CellKind        kind,
                    const Split           split,
                    const unsigned int    geometry_order)
  {
    return Filler<dim>(grid, kind, split, geometry_order).fill();
  }

  template RawMesh<2> fill(const BlockGrid<2> &, CellKind, Split, unsigned int);
  template RawMesh<3> fill(const BlockGrid<3> &, CellKind, Split, unsigned int);
} // namespace isochor
