// VTU files of linear and quadratic cells: order and positions of the points, fields there, names
// of the files, what the PVD and PVTU records list, errors on every rank.
//
// The state is a quadratic displacement and a linear pressure, which P2, P3 and P3-P2 hold
// exactly; J is then det(I + grad u) at every point, and p is known for the mixed elements.

#include <isochor/core/error.h>
#include <isochor/element/element_table.h>
#include <isochor/mesh/mesh.h>
#include <isochor/output/vtu.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <limits>
#include <regex>
#include <sstream>

using namespace isochor;
namespace fs = std::filesystem;

namespace
{
  template <int dim>
  dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &X)
  {
    dealii::Tensor<1, dim> u;
    u[0] = 0.1 * X[0] + 0.2 * X[1] * X[1];
    u[1] = -0.1 * X[0] * X[dim - 1];
    if (dim == 3)
      u[2] = 0.05 * X[2] * X[2];
    return u;
  }

  template <int dim>
  double jacobian(const dealii::Point<dim> &X)
  {
    dealii::Tensor<2, 3> F;
    F[0][0] = 1.1;
    F[0][1] = 0.4 * X[1];
    F[1][0] = -0.1 * X[dim - 1];
    F[1][1] = dim == 2 ? 1 - 0.1 * X[0] : 1;
    F[1][dim - 1] += dim == 3 ? -0.1 * X[0] : 0.;
    F[2][2] = dim == 3 ? 1 + 0.1 * X[dim - 1] : 1;
    return determinant(F);
  }

  template <int dim>
  double pressure(const dealii::Point<dim> &X)
  {
    return 1e5 * (1 + X[0] - 2 * X[1]);
  }

  template <int dim>
  Vector make_state(const Discretisation<dim> &discretisation)
  {
    const auto &cells = discretisation.cells;
    Vector      state = discretisation.make_vector();
    for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
      {
        for (unsigned int a = 0; a < cells.n_x; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            state.begin()[cells.x[cell * cells.n_x + a] + i]
                = displacement(cells.position(cell, discretisation.x_shape.node(a)))[i];
        for (unsigned int j = 0; j < cells.n_p; ++j)
          state.begin()[cells.p[cell * cells.n_p + j]]
              = pressure(cells.position(cell, discretisation.p_shape.node(j)));
      }
    return state;
  }

  /// A NaN is an infinite error.
  void keep_larger(double &worst, const double error)
  {
    worst = error <= worst  ? worst
            : error > worst ? error
                            : std::numeric_limits<double>::infinity();
  }

  /// "right", or the largest relative error over all ranks if single precision cannot explain it.
  std::string verdict(const double error)
  {
    const double largest = dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
    return largest < 2e-6 ? "right" : "wrong by " + std::to_string(largest);
  }

  template <int dim>
  void check_patches(const Discretisation<dim>                               &discretisation,
                     const std::vector<dealii::DataOutBase::Patch<dim, dim>> &patches,
                     std::ostream                                            &out)
  {
    // Edges of VTK_QUADRATIC_TRIANGLE and VTK_QUADRATIC_TETRA (VTK file formats, figure 3).
    static const std::vector<std::array<unsigned int, 2>> edges
        = dim == 2 ? std::vector<std::array<unsigned int, 2>>{{0, 1}, {1, 2}, {2, 0}}
                   : std::vector<std::array<unsigned int, 2>>{
                       {0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

    const bool quadratic      = discretisation.x_shape.degree() > 1;
    double     position_error = 0, u_error = 0, p_error = 0, J_error = 0;
    for (unsigned int cell = 0; cell < patches.size(); ++cell)
      {
        const auto                     &patch = patches[cell];
        std::vector<dealii::Point<dim>> positions(&discretisation.cells.geometry[cell * (dim + 1)],
                                                  &discretisation.cells.geometry[cell * (dim + 1)]
                                                      + dim + 1);
        if (quadratic)
          for (const auto &[v, w] : edges)
            positions.push_back(0.5 * (positions[v] + positions[w]));
        if (patch.data.n_cols() != positions.size() || patch.data.n_rows() != 2 * dim + 3)
          throw std::runtime_error("a patch of a wrong size");

        for (unsigned int i = 0; i < positions.size(); ++i)
          {
            for (unsigned int d = 0; d < dim; ++d)
              {
                keep_larger(position_error, std::abs(patch.data(dim + 3 + d, i) - positions[i][d]));
                keep_larger(u_error, std::abs(patch.data(d, i) - displacement(positions[i])[d]));
              }
            const double p = pressure(positions[i]);
            keep_larger(p_error, std::abs(patch.data(dim, i) - p) / 1e5);
            keep_larger(J_error, std::abs(patch.data(dim + 1, i) - jacobian(positions[i])));
          }
      }
    out << "  positions " << verdict(position_error) << ", displacement " << verdict(u_error);
    if (quadratic)
      out << ", J " << verdict(J_error);
    if (discretisation.element.is_mixed())
      out << ", pressure " << verdict(p_error);
    out << '\n';
  }

  std::string contents(const fs::path &file)
  {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  /// Every match of @p pattern in @p text, whole or its first group.
  std::vector<std::string> matches(const std::string &text, const std::string &pattern)
  {
    const std::regex         regex(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
      found.push_back((*it)[it->size() - 1]);
    return found;
  }

  /// What is on disk, by the text around the compressed arrays.
  void show_folder(const fs::path &folder, std::ostream &out)
  {
    std::vector<fs::path> files(fs::directory_iterator(folder), fs::directory_iterator{});
    std::sort(files.begin(), files.end());
    out << "  files:";
    unsigned long n_points = 0, n_cells = 0, n_bytes = 0;
    for (const auto &file : files)
      {
        out << ' ' << file.filename().string();
        if (file.extension() != ".vtu")
          continue;
        const std::string text = contents(file);
        for (const auto &number : matches(text, "NumberOfPoints=\"(\\d+)\""))
          n_points += std::stoul(number);
        for (const auto &number : matches(text, "NumberOfCells=\"(\\d+)\""))
          n_cells += std::stoul(number);
        n_bytes += text.size();
        if (!text.ends_with("</VTKFile>\n"))
          out << " (cut off)";
        if (n_points == 0
            || matches(text, "Name=\"(.*?)\"")
                   != std::vector<std::string>{"CYCLE",
                                               "TIME",
                                               "connectivity",
                                               "offsets",
                                               "types",
                                               "displacement",
                                               "pressure",
                                               "J",
                                               "von Mises stress [Pa]"})
          out << " (wrong arrays)";
      }
    // 12 bytes of position, 24 of data, some of connectivity; compressed, base64.
    const double bytes_per_point = double(n_bytes) / n_points;
    out << "\n  points " << n_points << ", cells " << n_cells << ", bytes per point "
        << (bytes_per_point > 4 && bytes_per_point < 60 ? "sane" : std::to_string(bytes_per_point))
        << '\n';

    for (const auto &line : matches(contents(folder / "solution.pvd"), "<DataSet.*/>"))
      {
        const std::string file = matches(line, "file=\"(.*?)\"").at(0);
        out << "  load " << matches(line, "timestep=\"(.*?)\"").at(0) << ": " << file
            << (fs::exists(folder / file) ? "" : ", which does not exist");
        for (const auto &piece : matches(contents(folder / file), "<Piece Source=\"(.*?)\""))
          out << ", " << piece << (fs::exists(folder / piece) ? "" : ", which does not exist");
        out << '\n';
      }
  }

  template <int dim>
  void test(const std::string &source, const std::vector<std::string> &elements, std::ostream &out)
  {
    MeshRequest request;
    request.source  = source;
    request.cells   = std::vector<unsigned int>(dim, 4);
    request.split   = dim == 2 ? Split::right_diagonal : Split::six_tets;
    const auto mesh = make_mesh<dim>(request, MPI_COMM_WORLD);
    const bool root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

    for (const std::string &element : elements)
      {
        const Discretisation<dim> discretisation(mesh->triangulation,
                                                 find_element(element, "test"));
        const Vector              state = make_state(discretisation);

        const fs::path folder = std::to_string(dim) + "D_" + element;
        if (root)
          fs::create_directory(folder);
        MPI_Barrier(MPI_COMM_WORLD);

        out << dim << "D " << element << '\n';
        VtuSeries<dim> series(discretisation, Material(), folder);
        check_patches(discretisation, series.fill_patches(state), out);
        series.write(state, 0.25, 1);
        series.write(state, 1., 12);
        if (root)
          show_folder(folder, out);
      }

    const Discretisation<dim> discretisation(mesh->triangulation, find_element("P1", "test"));
    for (const std::string folder : {"nowhere", "/dev/null"})
      {
        std::string message = "nothing";
        try
          {
            VtuSeries<dim>(discretisation, Material(), folder)
                .write(discretisation.make_vector(), 1., 1);
          }
        catch (const UserError &error)
          {
            message = error.what();
          }
        for (const auto &text : dealii::Utilities::MPI::gather(MPI_COMM_WORLD, message))
          out << text << '\n';
      }
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  std::ostringstream out;
  test<2>("rectangle(1, 1)", {"P1", "P2-P1", "P3"}, out);
  test<3>("box(1, 1, 1)", {"P1-P1", "P2", "P3-P2"}, out);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << out.str();
}
