// The unknowns: how many, who owns them, which node a row lives on, who couples with whom, and
// what supports do to them.
//
// Counts for n blocks per direction, by hand: 2D has V = (n + 1)^2 vertices, E = 3 n^2 + 2 n edges
// and C = 2 n^2 cells; Kuhn's cut in 3D has E = 3 n (n + 1)^2 + 3 n^2 (n + 1) + n^3 edges (along the
// axes, in the squares, through the cubes), C = 6 n^3 cells and, by Euler, F = E + C - V + 1 faces.
// Held below, on P3 with (3 n + 1)^(dim - 1) nodes on a side: all components of one side and one of
// its neighbour, which share (3 n + 1)^(dim - 2) nodes: 20 + 9 = 29 and 147 + 42 = 189.
// Nodes: P1 V; P2 V + E; P3 V + 2 E + C in 2D, V + 2 E + F in 3D.

#include "../common/meshes.h"
#include "../common/report.h"
#include "../common/supports.h"

#include <isochor/space/matrix_pattern.h>
#include <isochor/space/prescribed_displacements.h>

using namespace isochor;
using namespace isochor::testing;
namespace MPI = dealii::Utilities::MPI;

namespace
{
  template <int dim>
  GlobalIndex n_nodes(const GlobalIndex n, const unsigned int degree)
  {
    const GlobalIndex V = dim == 2 ? (n + 1) * (n + 1) : (n + 1) * (n + 1) * (n + 1);
    const GlobalIndex E = dim == 2 ? 3 * n * n + 2 * n
                                   : 3 * n * (n + 1) * (n + 1) + 3 * n * n * (n + 1) + n * n * n;
    const GlobalIndex C = dim == 2 ? 2 * n * n : 6 * n * n * n;
    const GlobalIndex F = E + C - V + 1;
    return degree == 1 ? V : degree == 2 ? V + E : V + 2 * E + (dim == 2 ? C : F);
  }

  std::string equal(const GlobalIndex found, const GlobalIndex expected)
  {
    return std::to_string(found)
           + (found == expected ? "" : " (EXPECTED " + std::to_string(expected) + ")");
  }

  /// A symmetric function of two unknowns.
  double entry(const GlobalIndex i, const GlobalIndex j)
  {
    return std::cos(0.1 * (i + j)) + std::sin(0.3 * i) * std::sin(0.3 * j) + (i == j ? 50. : 0.);
  }

  void fill(SparseMatrix &matrix)
  {
    const auto &partitioner = *matrix.partitioner();
    for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
      for (std::size_t k = matrix.row_start()[row]; k < matrix.row_start()[row + 1]; ++k)
        matrix.values()[k] = entry(partitioner.local_to_global(row),
                                   partitioner.local_to_global(matrix.columns()[k]));
  }

  /// Entries that depend on the unknown only, not on who owns it.
  Vector some_vector(const SparseMatrix &matrix, const unsigned int seed)
  {
    Vector vector(matrix.partitioner());
    for (LocalIndex i = 0; i < matrix.n_rows(); ++i)
      vector.local_element(i)
          = std::sin(1. + (seed + 1.7) * (matrix.partitioner()->local_to_global(i) + 1));
    vector.update_ghost_values();
    return vector;
  }

  /// |x . A y - y . A x| / (|x| |y|): zero if values and pattern are symmetric, across ranks too.
  double asymmetry(const SparseMatrix &matrix)
  {
    const Vector x = some_vector(matrix, 0), y = some_vector(matrix, 1);
    Vector       Ax(matrix.partitioner()), Ay(matrix.partitioner());
    matrix.vmult(Ax, x);
    matrix.vmult(Ay, y);
    return std::abs(x * Ay - y * Ax) / (x.l2_norm() * y.l2_norm());
  }

  /// Largest distance from a pressure node to the displacement node that its row is said to live
  /// on, against the shortest edge of the cell: 0 where all pressure nodes are displacement nodes,
  /// a sixth of an edge for the middle of a P3-P2 edge.
  template <int dim>
  double host_distance(const Discretisation<dim> &discretisation)
  {
    const auto &cells   = discretisation.cells;
    double      largest = 0;
    for (std::size_t cell = 0; cell < cells.n_cells; ++cell)
      for (unsigned int j = 0; j < cells.n_p; ++j)
        {
          const LocalIndex row = cells.p[cell * cells.n_p + j];
          if (row >= cells.n_owned_unknowns)
            continue;
          const auto place = cells.position(cell, discretisation.p_shape.node(j));
          double     best  = 1e300;
          for (unsigned int a = 0; a < cells.n_x; ++a)
            {
              const LocalIndex head = cells.x[cell * cells.n_x + a];
              if (head < cells.n_owned_unknowns
                  && discretisation.node_of_row[head] == discretisation.node_of_row[row])
                best = place.distance(cells.position(cell, discretisation.x_shape.node(a)));
            }
          raise(largest, best);
        }
    return MPI::max(largest, MPI_COMM_WORLD);
  }

  template <int dim>
  void count(const Mesh<dim> &mesh, const unsigned int n)
  {
    for (const Element &element : element_table())
      if (element.kind == CellKind::simplex && !element.has_bubble()
          && !element.has_discontinuous_pressure() && !element.is_stabilised)
        {
          const Discretisation<dim> discretisation(mesh.triangulation, element);
          const auto               &d = discretisation;
          const GlobalIndex         x = n_nodes<dim>(n, element.displacement.degree);
          const GlobalIndex p = element.is_mixed() ? n_nodes<dim>(n, element.pressure->degree) : 0;
          out() << element.name << " in " << dim << "D: nodes " << equal(d.n_displacement_nodes, x)
                << ", pressures " << equal(d.n_pressures, p) << ", unknowns "
                << equal(d.n_unknowns(), dim * x + p) << ", cells "
                << equal(d.n_cells, dim == 2 ? 2 * n * n : 6 * n * n * n) << '\n';

          // Rows of a node follow each other, nodes ascend, and all ranks together have all.
          bool        in_order = d.node_of_row.size() == d.partitioner->locally_owned_size();
          GlobalIndex owned    = 0;
          for (LocalIndex i = 0; i < d.n_owned_displacements; ++i)
            {
              in_order = in_order && d.node_of_row[i] == d.node_of_row[0] + i / dim;
              owned += i % dim == 0;
            }
          for (const GlobalIndex node : d.node_of_row)
            in_order = in_order && node < d.n_displacement_nodes;
          out() << "  nodes in order: " << yes(MPI::min(int(in_order), MPI_COMM_WORLD))
                << ", all owned: " << yes(MPI::sum(owned, MPI_COMM_WORLD) == x);
          if (element.is_mixed())
            out() << ", pressure to its node "
                  << (element.displacement.degree < 3 ? below(host_distance(d), 1e-13)
                                                      : below(host_distance(d) * n, 0.5));

          SparseMatrix matrix;
          make_pattern(d, matrix);
          bool sorted = true;
          for (LocalIndex row = 0; row < matrix.n_rows(); ++row)
            for (std::size_t k = matrix.row_start()[row] + 1; k < matrix.row_start()[row + 1]; ++k)
              sorted = sorted && matrix.columns()[k - 1] < matrix.columns()[k];
          fill(matrix);
          out() << "\n  pattern sorted: " << yes(MPI::min(int(sorted), MPI_COMM_WORLD))
                << ", asymmetry " << below(asymmetry(matrix), 1e-12);
          if (element.name == "P1") // a node couples with itself and along each edge both ways
            out() << ", entries "
                  << equal(MPI::sum(GlobalIndex(matrix.columns().size()), MPI_COMM_WORLD),
                           dim * dim * (2 * n_nodes<dim>(n, 2) - n_nodes<dim>(n, 1)));
          out() << '\n';
        }
  }

  template <int dim>
  void support(const Mesh<dim> &mesh)
  {
    const Discretisation<dim> discretisation(mesh.triangulation, find_element("P3-P2", ""));
    const auto                boundary_id = [&](const std::string &name, const std::string &what) {
      return mesh.boundary_id(name, what);
    };
    const auto message = [&](const std::vector<Support<dim>> &supports) {
      return message_of<UserError>(
          [&]() { PrescribedDisplacements<dim>(discretisation, supports, boundary_id); });
    };
    const std::string all = all_components<dim>;

    out() << "supports in " << dim << "D\n  none: " << message({})
          << "\n  one roller: " << message({held<dim>("left", "x")})
          << "\n  two rollers: " << message({held<dim>("left", "x"), held<dim>("bottom", "y")})
          << "\n  sliding along x: " << message({held<dim>("left", all.substr(1))})
          << "\n  one side fixed: " << message({held<dim>("left", all)}) << '\n';
    if constexpr (dim == 3)
      out() << "  three rollers: "
            << message({held<3>("left", "x"), held<3>("bottom", "y"), held<3>("back", "z")})
            << '\n';
    const auto lifted = [](const dealii::Point<dim> &, const double load) {
      return 0.5 * load * dealii::Point<dim>::unit_vector(1);
    };
    // Such as 0.1 * (x - 1) where a mesh has 0.9999999999999999 for 1.
    const auto nearly_at_rest = [](const dealii::Point<dim> &, double) {
      return 1e-17 * dealii::Point<dim>::unit_vector(0);
    };
    // Where they meet first depends on the numbering; that both are named does not.
    const std::string text = message({held<dim>("left", all), held<dim>("top", all, lifted)});
    const auto says = [&](const std::string &word) { return text.find(word) != std::string::npos; };
    out() << "  contradiction: " << text.substr(0, text.find(':'))
          << ", names both: " << yes(says("support of 'left'") && says("support of 'top'"))
          << ", the component: " << yes(says(" m in y")) << ", both values: "
          << yes(says(" 0 m") && says(" 0.185 m") && says("(load factor 0.37)"))
          << "\n  agreement: "
          << message({held<dim>("left", all, lifted), held<dim>("top", all, lifted)})
          << "\n  agreement up to rounding: "
          << message({held<dim>("left", all), held<dim>("top", all, nearly_at_rest)})
          << "\n  no such boundary: " << message({held<dim>("inside", all)}) << '\n';

    // A symmetric matrix, before and after.
    const auto sheared = [](const dealii::Point<dim> &x, const double load) {
      return load * (0.3 * x[1] + 0.1) * dealii::Point<dim>::unit_vector(0);
    };
    const PrescribedDisplacements<dim> prescribed(
        discretisation,
        {held<dim>("left", all, sheared), held<dim>("top", "x", sheared)},
        boundary_id);
    SparseMatrix before;
    make_pattern(discretisation, before);
    fill(before);
    SparseMatrix after = before;

    const Vector state = some_vector(before, 2), rhs_before = some_vector(before, 3);
    Vector       gap(state), rhs(rhs_before), step = some_vector(before, 4);
    const double largest = prescribed.gap(state, 0.5, gap);
    out() << "  largest gap against its vector "
          << below(std::abs(largest - gap.linfty_norm()), 1e-15);
    prescribed.apply(after, rhs, gap);

    // With a step that closes the gap, free rows ask the same as before and held rows nothing.
    for (const LocalIndex i : prescribed.unknowns())
      step.local_element(i) = gap.local_element(i);
    step.update_ghost_values();
    Vector residual_before(rhs), residual(rhs);
    before.vmult(residual_before, step);
    residual_before.sadd(-1., 1., rhs_before);
    prescribed.set_zero(residual_before);
    after.vmult(residual, step);
    residual.sadd(-1., 1., rhs);
    residual -= residual_before;

    // Held displacements are those of the support, whatever the state was.
    Vector closed(state);
    closed += gap;
    GlobalIndex n_held = prescribed.unknowns().size();
    out() << ", after closing it " << below(prescribed.gap(closed, 0.5, gap), 1e-15)
          << "\n  asymmetry before " << below(asymmetry(before), 1e-12) << ", after "
          << below(asymmetry(after), 1e-12) << ", free rows changed "
          << below(residual.l2_norm(), 1e-12) << ", held unknowns "
          << MPI::sum(n_held, MPI_COMM_WORLD) << '\n';
  }
} // namespace

int main(int argc, char **argv)
{
  const MPI::MPI_InitFinalize mpi(argc, argv, 1);
  count<2>(*distorted_box<2>(3), 3);
  count<3>(*distorted_box<3>(2), 2);
  support<2>(*distorted_box<2>(3));
  support<3>(*distorted_box<3>(2));
}
