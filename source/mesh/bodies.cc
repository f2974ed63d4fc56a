#include "bodies.h"

#include <cmath>

namespace isochor
{
  namespace
  {
    using dealii::Point;
    using Key = std::array<unsigned int, 3>;

    // (cos, sin) of an angle of so many right angles, exact at whole numbers: vertices that
    // belong into a plane of symmetry must lie in it.
    std::array<double, 2> direction(const double right_angles)
    {
      const double whole = std::floor(right_angles);
      const double angle = (right_angles - whole) * M_PI / 2;
      const double c = std::cos(angle), s = std::sin(angle);
      switch (static_cast<int>(whole) % 4)
        {
          case 0:
            return {c, s};
          case 1:
            return {-s, c};
          case 2:
            return {-c, -s};
          default:
            return {s, -c};
        }
    }

    // tan of an angle of so many eighths of a full turn, exact at 1.
    double tangent(const double eighths)
    {
      return std::abs(eighths) == 1 ? eighths : std::tan(eighths * M_PI / 4);
    }

    Patch rectangular_patch(const unsigned int n0, const unsigned int n1)
    {
      return {{n0, n1},
              [](const unsigned int a, const unsigned int b) {
                return Key{a, b, 0};
              },
              {0, 1, 2, 3}};
    }

    BlockGrid<3> box(const GeneratorCall &call, const MeshRequest &request)
    {
      expect_lengths(call);
      const std::vector<double> l = call.arguments;
      const auto                n = block_counts(call, request, l, 1);
      BlockGrid<3>              grid;
      grid.patches  = {rectangular_patch(n[0], n[1])};
      grid.n_layers = n[2];
      grid.ends     = {4, 5};
      grid.map      = [l](unsigned int, const Point<3> &p) {
        return Point<3>(l[0] * p[0], l[1] * p[1], l[2] * p[2]);
      };
      return grid;
    }

    // Around the x axis; the section's axes are the radius and the angle from y to z.
    BlockGrid<3> tube(const GeneratorCall &call, const MeshRequest &request)
    {
      expect_radii(call);
      const double inner = call.arguments[0], outer = call.arguments[1];
      const double length = call.arguments[2];
      const auto   n
          = block_counts(call, request, {outer - inner, M_PI / 4 * (inner + outer), length}, 4);
      const unsigned int n_around = 4 * n[1];
      BlockGrid<3>       grid;
      grid.patches        = {{{n[0], n_around},
                              [n_around](const unsigned int a, const unsigned int b) {
                         return Key{a, b % n_around, 0};
                       },
                              {2, 3, -1, -1}}};
      grid.n_layers       = n[2];
      grid.ends           = {0, 1};
      grid.has_flat_sides = false;
      grid.map            = [=](unsigned int, const Point<3> &p) {
        const auto [c, s]   = direction(4 * p[1]);
        const double radius = (1 - p[0]) * inner + p[0] * outer;
        return Point<3>(length * p[2], radius * c, radius * s);
      };
      return grid;
    }

    // A cylinder's section of radius 1: a square core with sides that bulge, and around it four
    // patches whose lines go straight to the circle.
    namespace disc
    {
      // The core's corners lie at this radius: its cells are not much smaller than those outside.
      constexpr double corner_radius = 0.6;
      // From a straight side (0) to a circle's arc (1). Such that the core's sides meet its diagonal
      // at 60 degrees: the three cells at its corner have the same angle.
      const double bulge = std::tan(M_PI / 12);

      // A core's side, its middle in direction (1, 0), at s in [-1, 1].
      std::array<double, 2> core_side(const double s)
      {
        const double h = corner_radius * std::sqrt(0.5);
        if (std::abs(s) == 1)
          return {h, s * h};
        const double angle = s * M_PI / 4;
        return {(1 - bulge) * h + bulge * corner_radius * std::cos(angle),
                (1 - bulge) * h * tangent(s) + bulge * corner_radius * std::sin(angle)};
      }

      // The blend of four sides (Coons), u and v in [-1, 1].
      std::array<double, 2> core(const double u, const double v)
      {
        const auto   side_u = core_side(u), side_v = core_side(v);
        const double h = corner_radius * std::sqrt(0.5);
        return {u * (side_v[0] - h) + side_u[1], v * (side_u[0] - h) + side_v[1]};
      }

      // The patch whose middle is in direction (1, 0): @p out from the core's side to the circle.
      std::array<double, 2> ring(const double out, const double s)
      {
        const auto   side = core_side(s);
        const double r    = std::sqrt(0.5);
        const double c    = std::abs(s) == 1 ? r : std::cos(s * M_PI / 4);
        const double d    = std::abs(s) == 1 ? s * r : std::sin(s * M_PI / 4);
        return {(1 - out) * side[0] + out * c, (1 - out) * side[1] + out * d};
      }

      std::array<double, 2> map(const unsigned int patch, const double a, const double b)
      {
        std::array<double, 2> p{};
        switch (patch)
          {
            case 0:
              return core(2 * a - 1, 2 * b - 1);
            case 1: // towards +y; sections have the axes y and z
              return ring(a, 2 * b - 1);
            case 2: // -y
              p = ring(b, 2 * a - 1);
              return {-p[0], p[1]};
            case 3: // +z
              p = ring(b, 2 * a - 1);
              return {p[1], p[0]};
            default: // -z
              p = ring(a, 2 * b - 1);
              return {p[1], -p[0]};
          }
      }
    } // namespace disc

    BlockGrid<3> cylinder(const GeneratorCall &call, const MeshRequest &request)
    {
      expect_lengths(call);
      const double radius = call.arguments[0], length = call.arguments[1];
      // Means of the core's side and a quarter of the circle, and over the ring's lines.
      const auto         count = block_counts(call,
                                      request,
                                      {1.2 * radius, 0.47 * radius, length},
                                      // n (n + 4 m) of n m, if n is 2.5 m
                                      7);
      const unsigned int n = count[0], m = count[1];
      const auto   beside = [](const int side) { return std::array<int, 4>{{-1, side, -1, -1}}; };
      const auto   above  = [](const int side) { return std::array<int, 4>{{-1, -1, -1, side}}; };
      BlockGrid<3> grid;
      // Keys: the grid point of the core, or the one on its side and how far out from there.
      grid.patches        = {{{n, n},
                              [](auto a, auto b) {
                         return Key{a, b, 0};
                       },
                              {-1, -1, -1, -1}},
                             {{m, n},
                              [n](auto a, auto b) {
                         return Key{n, b, a};
                       },
                              beside(2)},
                             {{n, m},
                              [](auto a, auto b) {
                         return Key{0, a, b};
                       },
                              above(2)},
                             {{n, m},
                              [n](auto a, auto b) {
                         return Key{a, n, b};
                       },
                              above(2)},
                             {{m, n},
                              [](auto a, auto b) {
                         return Key{b, 0, a};
                       },
                              beside(2)}};
      grid.n_layers       = count[2];
      grid.ends           = {0, 1};
      grid.has_flat_sides = false;
      grid.map            = [=](const unsigned int patch, const Point<3> &p) {
        const auto [y, z] = disc::map(patch, p[0], p[1]);
        return Point<3>(length * p[2], radius * y, radius * z);
      };
      return grid;
    }

    // The three faces of a cube that meet in its corner (1, 1, 1), blown up to the sphere so that
    // their lines stand at equal angles.
    BlockGrid<3> sphere_octant(const GeneratorCall &call, const MeshRequest &request)
    {
      expect_radii(call);
      const double inner = call.arguments[0], outer = call.arguments[1];
      const auto   n = block_counts(call, request, {outer - inner, M_PI / 8 * (inner + outer)}, 3);
      const unsigned int k = n[1];
      BlockGrid<3>       grid;
      for (unsigned int axis = 0; axis < 3; ++axis)
        grid.patches.push_back(
            {{k, k},
             [axis, k](const unsigned int a, const unsigned int b) {
               Key key;
               key[axis]           = k;
               key[(axis + 1) % 3] = a;
               key[(axis + 2) % 3] = b;
               return key;
             },
             {static_cast<int>(axis + 1) % 3, -1, static_cast<int>(axis + 2) % 3, -1}});
      grid.n_layers       = n[0];
      grid.ends           = {3, 4};
      grid.has_flat_sides = false;
      grid.map            = [=](const unsigned int axis, const Point<3> &p) {
        Point<3> cube;
        cube[axis]           = 1;
        cube[(axis + 1) % 3] = tangent(p[0]);
        cube[(axis + 2) % 3] = tangent(p[1]);
        return Point<3>(((1 - p[2]) * inner + p[2] * outer) / cube.norm() * cube);
      };
      return grid;
    }

    BlockGrid<2> quadrilateral(const GeneratorCall &call, const MeshRequest &request)
    {
      std::array<Point<2>, 4> corner;
      if (call.form.name == "rectangle")
        {
          expect_lengths(call);
          const double lx = call.arguments[0], ly = call.arguments[1];
          corner = {Point<2>(0, 0), Point<2>(lx, 0), Point<2>(lx, ly), Point<2>(0, ly)};
        }
      else
        for (unsigned int c = 0; c < 4; ++c)
          corner[c] = {call.arguments[2 * c], call.arguments[2 * c + 1]};
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
      const auto n
          = block_counts(call,
                         request,
                         {(corner[0].distance(corner[1]) + corner[3].distance(corner[2])) / 2,
                          (corner[0].distance(corner[3]) + corner[1].distance(corner[2])) / 2},
                         1);
      BlockGrid<2> grid;
      grid.patches = {rectangular_patch(n[0], n[1])};
      grid.map     = [corner](unsigned int, const Point<2> &p) {
        const double x = p[0], y = p[1];
        return Point<2>((1 - x) * (1 - y) * corner[0] + x * (1 - y) * corner[1] + x * y * corner[2]
                        + (1 - x) * y * corner[3]);
      };
      return grid;
    }

    BlockGrid<2> annulus_quarter(const GeneratorCall &call, const MeshRequest &request)
    {
      expect_radii(call);
      const double inner = call.arguments[0], outer = call.arguments[1];
      const auto   n = block_counts(call, request, {outer - inner, M_PI / 4 * (inner + outer)}, 1);
      BlockGrid<2> grid;
      grid.patches        = {rectangular_patch(n[0], n[1])};
      grid.has_flat_sides = false;
      grid.map            = [=](unsigned int, const Point<2> &p) {
        const auto [c, s]   = direction(p[1]);
        const double radius = (1 - p[0]) * inner + p[0] * outer;
        return Point<2>(radius * c, radius * s);
      };
      return grid;
    }
  } // namespace

  template <>
  BlockGrid<2> blocks_of(const GeneratorCall &call, const MeshRequest &request)
  {
    BlockGrid<2> grid = call.form.name == "annulus_quarter" ? annulus_quarter(call, request)
                                                            : quadrilateral(call, request);
    grid.names        = call.form.boundaries;
    return grid;
  }

  template <>
  BlockGrid<3> blocks_of(const GeneratorCall &call, const MeshRequest &request)
  {
    BlockGrid<3> grid = call.form.name == "box"        ? box(call, request)
                        : call.form.name == "cylinder" ? cylinder(call, request)
                        : call.form.name == "tube"     ? tube(call, request)
                                                       : sphere_octant(call, request);
    grid.names        = call.form.boundaries;
    return grid;
  }
} // namespace isochor
