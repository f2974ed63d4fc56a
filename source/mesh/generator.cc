#include <isochor/mesh/generator.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <regex>

namespace isochor
{
  namespace
  {
    using dealii::Point;

    // More cells than anyone means: a size in the wrong unit must not fill the memory.
    constexpr double max_blocks = 5e7;

    struct Call
    {
      std::string         name;
      std::vector<double> arguments;
      std::string         origin; ///< start of messages
    };

    Call parse(const std::string &source)
    {
      static const std::regex pattern(R"(\s*([A-Za-z]\w*)\s*\((.*)\)\s*)");
      std::smatch             match;
      if (!std::regex_match(source, match, pattern))
        throw UserError("Mesh '" + source + "': neither a generator nor a file");
      Call call{match[1], {}, "Mesh '" + source + "'"};

      std::string text = match[2];
      for (std::size_t begin = 0; begin <= text.size();)
        {
          const std::size_t end    = std::min(text.find(',', begin), text.size());
          const std::string word   = text.substr(begin, end - begin);
          std::size_t       used   = 0;
          double            number = 0;
          try
            {
              number = std::stod(word, &used);
            }
          catch (const std::exception &)
            {
              used = 0;
            }
          if (used == 0 || word.find_first_not_of(" \t", used) != std::string::npos
              || !std::isfinite(number))
            throw UserError(call.origin + ": '"
                            + word.substr(std::min(word.find_first_not_of(" \t"), word.size()))
                            + "' is not a number");
          call.arguments.push_back(number);
          begin = end + 1;
        }
      return call;
    }

    void expect_arguments(const Call &call, const std::size_t n, const std::string &form)
    {
      if (call.arguments.size() != n)
        throw UserError(call.origin + ": " + std::to_string(call.arguments.size())
                        + " numbers where " + form + " takes " + std::to_string(n));
    }

    void expect_lengths(const Call &call)
    {
      for (const double length : call.arguments)
        if (!(length > 0))
          throw UserError(call.origin + ": lengths must be positive");
    }

    // Blocks per direction, from Cells or from the size.
    template <int dim>
    std::array<unsigned int, dim> block_counts(const MeshRequest             &request,
                                               const std::array<double, dim> &lengths,
                                               const std::string             &origin)
    {
      std::array<double, dim> counts;
      if (!request.cells.empty())
        {
          if (request.cells.size() != dim)
            throw UserError(origin + ": " + std::to_string(request.cells.size())
                            + " numbers of cells were given; it takes " + std::to_string(dim)
                            + ", one per direction");
          for (unsigned int d = 0; d < dim; ++d)
            counts[d] = request.cells[d];
          if (*std::min_element(counts.begin(), counts.end()) < 1)
            throw UserError(origin + ": each direction needs at least one cell");
        }
      else if (request.size > 0)
        for (unsigned int d = 0; d < dim; ++d)
          counts[d] = std::max(1., std::round(lengths[d] / request.size));
      else
        throw UserError(origin
                        + ": give the edge length (Mesh size) or the numbers of cells (Cells)");

      double total = 1;
      for (const double count : counts)
        total *= count;
      if (!(total <= max_blocks))
        throw UserError(origin
                        + ": that would be more than 50 million blocks; is the size in "
                          "metres?");
      std::array<unsigned int, dim> blocks;
      std::copy(counts.begin(), counts.end(), blocks.begin());
      return blocks;
    }

    // Corners of a block are numbered by bits: corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1).
    template <int dim>
    using Simplex = std::array<unsigned int, dim + 1>;

    // Kuhn: one simplex for each order in which a path along the edges may go from the first to the
    // last corner. In 2D that is the cut by the right diagonal.
    template <int dim>
    std::vector<Simplex<dim>> kuhn_split()
    {
      std::array<unsigned int, dim> axes;
      for (unsigned int d = 0; d < dim; ++d)
        axes[d] = d;
      std::vector<Simplex<dim>> simplices;
      do
        {
          Simplex<dim> simplex{};
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
    std::vector<Simplex<3>> five_split(const bool mirrored)
    {
      if (mirrored)
        return {{1, 2, 4, 7}, {0, 1, 2, 4}, {3, 2, 1, 7}, {5, 1, 4, 7}, {6, 4, 2, 7}};
      return {{0, 5, 3, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 0, 6}, {7, 3, 5, 6}};
    }

    // A grid of blocks, each cut into simplices. @p map takes the unit square or cube to the body;
    // names are those of x = 0, x = 1, y = 0, y = 1, ...
    template <int dim, typename Map>
    RawMesh<dim> grid(const std::array<unsigned int, dim>            &n,
                      const std::array<std::vector<Simplex<dim>>, 2> &splits,
                      const std::vector<std::string>                 &names,
                      const Map                                      &map)
    {
      using Index = std::array<unsigned int, dim>;
      // Call @p action(index) for all indices below @p end, the first running fastest.
      const auto for_each_index = [](const Index &end, const auto &action) {
        Index index{};
        while (index[dim - 1] < end[dim - 1])
          {
            action(index);
            ++index[0];
            for (unsigned int d = 0; d + 1 < dim && index[d] == end[d]; ++d)
              {
                index[d] = 0;
                ++index[d + 1];
              }
          }
      };

      RawMesh<dim> mesh;
      mesh.names = names;
      Index n_vertices;
      for (unsigned int d = 0; d < dim; ++d)
        n_vertices[d] = n[d] + 1;
      for_each_index(n_vertices, [&](const Index &index) {
        Point<dim> unit;
        for (unsigned int d = 0; d < dim; ++d)
          unit[d] = static_cast<double>(index[d]) / n[d];
        mesh.vertices.push_back(map(unit));
      });

      for_each_index(n, [&](const Index &block) {
        const unsigned int parity
            = std::accumulate(block.begin(), block.end(), 0u) % 2; // mirrored every other block
        for (const Simplex<dim> &simplex : splits[parity])
          {
            dealii::CellData<dim>      cell(dim + 1);
            std::array<Index, dim + 1> corners;
            for (unsigned int v = 0; v <= dim; ++v)
              {
                unsigned int vertex = 0;
                for (unsigned int d = dim; d-- > 0;)
                  {
                    corners[v][d] = block[d] + (simplex[v] >> d & 1);
                    vertex        = vertex * n_vertices[d] + corners[v][d];
                  }
                cell.vertices[v] = vertex;
              }
            mesh.cells.push_back(cell);

            // Faces on a side of the grid: those whose vertices all lie on it.
            for (unsigned int d = 0; d < dim; ++d)
              for (unsigned int side = 0; side < 2; ++side)
                {
                  dealii::CellData<dim - 1> face(dim);
                  unsigned int              found = 0;
                  for (unsigned int v = 0; v <= dim; ++v)
                    if (corners[v][d] == (side == 0 ? 0 : n[d]))
                      face.vertices[found++] = cell.vertices[v];
                  if (found != dim)
                    continue;
                  face.boundary_id = 2 * d + side;
                  if constexpr (dim == 2)
                    mesh.boundary.boundary_lines.push_back(face);
                  else
                    mesh.boundary.boundary_quads.push_back(face);
                }
          }
      });
      return mesh;
    }

    RawMesh<3> box(const MeshRequest &request, const Call &call)
    {
      expect_arguments(call, 3, "box(lx, ly, lz)");
      expect_lengths(call);
      if (request.split == Split::right_diagonal)
        throw UserError(
            call.origin + ": the split '" + split_names.name(request.split)
            + "' is for triangles; choose "
            + listed({split_names.name(Split::six_tets), split_names.name(Split::five_tets)}));
      const std::array<double, 3> l    = {call.arguments[0], call.arguments[1], call.arguments[2]};
      const auto                  kuhn = kuhn_split<3>();
      return grid<3>(
          block_counts<3>(request, l, call.origin),
          request.split == Split::five_tets ? std::array{five_split(false), five_split(true)}
                                            : std::array{kuhn, kuhn},
          {"left", "right", "bottom", "top", "back", "front"},
          [&](const Point<3> &p) { return Point<3>(l[0] * p[0], l[1] * p[1], l[2] * p[2]); });
    }

    RawMesh<2> quadrilateral(const MeshRequest &request, const Call &call)
    {
      std::array<Point<2>, 4> corner;
      if (call.name == "rectangle")
        {
          expect_arguments(call, 2, "rectangle(lx, ly)");
          expect_lengths(call);
          const double lx = call.arguments[0], ly = call.arguments[1];
          corner = {Point<2>(0, 0), Point<2>(lx, 0), Point<2>(lx, ly), Point<2>(0, ly)};
        }
      else
        {
          expect_arguments(call, 8, "quadrilateral(x0,y0, x1,y1, x2,y2, x3,y3)");
          for (unsigned int c = 0; c < 4; ++c)
            corner[c] = {call.arguments[2 * c], call.arguments[2 * c + 1]};
        }
      // The bilinear map is invertible if it is so at the four corners. Written so that a
      // triangle (two sides in line) fails too: its last cell would be degenerate.
      for (unsigned int c = 0; c < 4; ++c)
        {
          const auto a = corner[(c + 1) % 4] - corner[c], b = corner[(c + 3) % 4] - corner[c];
          if (!(a[0] * b[1] - a[1] * b[0] > 1e-9 * a.norm() * b.norm()))
            throw UserError(call.origin
                            + ": the corners must go counterclockwise round a convex "
                              "quadrilateral, the bottom side first");
        }
      if (request.split == Split::five_tets)
        throw UserError(call.origin + ": the split '" + split_names.name(request.split)
                        + "' is for tetrahedra; triangles have '"
                        + split_names.name(Split::right_diagonal) + "'");
      const std::array<double, 2> lengths
          = {(corner[0].distance(corner[1]) + corner[3].distance(corner[2])) / 2,
             (corner[0].distance(corner[3]) + corner[1].distance(corner[2])) / 2};
      const auto right = kuhn_split<2>();
      return grid<2>(block_counts<2>(request, lengths, call.origin),
                     {right, right},
                     {"left", "right", "bottom", "top"},
                     [&](const Point<2> &p) {
                       const double x = p[0], y = p[1];
                       return Point<2>((1 - x) * (1 - y) * corner[0] + x * (1 - y) * corner[1]
                                       + x * y * corner[2] + (1 - x) * y * corner[3]);
                     });
    }
  } // namespace

  bool is_generator(const std::string &source)
  {
    static const std::regex pattern(R"(\s*[A-Za-z]\w*\s*\(.*\)\s*)");
    return std::regex_match(source, pattern);
  }

  template <int dim>
  RawMesh<dim> generate(const MeshRequest &request)
  {
    const Call call      = parse(request.source);
    const bool is_volume = call.name == "box";
    if (!is_volume && call.name != "rectangle" && call.name != "quadrilateral")
      throw UserError(call.origin + ": no generator is named '" + call.name
                      + "'; choose box(lx, ly, lz), rectangle(lx, ly) or "
                        "quadrilateral(x0,y0, x1,y1, x2,y2, x3,y3)");
    if (is_volume != (dim == 3))
      throw UserError(call.origin + ": " + call.name + " is " + (is_volume ? "three" : "two")
                      + "-dimensional, the scene is " + (dim == 3 ? "three" : "two")
                      + "-dimensional");
    if constexpr (dim == 3)
      return box(request, call);
    else
      return quadrilateral(request, call);
  }

  template RawMesh<2> generate<2>(const MeshRequest &);
  template RawMesh<3> generate<3>(const MeshRequest &);
} // namespace isochor
