// results.csv: quoting by RFC 4180, digits, each row on disk at once, the columns guarded, and
// errors that name the file on every rank.

#include <isochor/core/error.h>
#include <isochor/output/results_csv.h>

#include <deal.II/base/mpi.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>

using namespace isochor;

namespace
{
  std::string contents(const std::string &file)
  {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  void report(const std::string &title, const std::function<void()> &action)
  {
    std::string message = "nothing";
    try
      {
        action();
      }
    catch (const UserError &error)
      {
        message = std::string("UserError: ") + error.what();
      }
    catch (const std::runtime_error &error)
      {
        message = std::string("runtime_error: ") + error.what();
      }
    const auto all = dealii::Utilities::MPI::gather(MPI_COMM_WORLD, message);
    for (unsigned int rank = 0; rank < all.size(); ++rank)
      std::cout << title << ", rank " << rank << ": " << all[rank] << '\n';
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  if (root)
    for (const double value : {0.1,
                               1. / 3,
                               -2.5e-7 / 3,
                               266e3,
                               12345678901.,
                               -0.,
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()})
      std::cout << csv_number(value) << '\n';

  ResultsCsv csv(MPI_COMM_WORLD, "results.csv");
  if (root)
    std::cout << "--- created\n" << contents("results.csv");
  csv.add(
      {{"Method/Element", "P1"}, {"tip, y [m]", csv_number(-0.25)}, {"say \"why\"", "two\nlines"}});
  if (root)
    std::cout << "--- one row\n" << contents("results.csv");
  csv.add({{"Method/Element", "P1-P1"}, {"tip, y [m]", ""}, {"say \"why\"", "a \"b\", c"}});
  if (root)
    std::cout << "--- two rows\n" << contents("results.csv");
  report("other columns", [&]() { csv.add({{"Method/Element", "P2"}}); });
  if (root)
    std::cout << "--- still two rows\n" << contents("results.csv");

  if (root)
    {
      // A program that was killed while it wrote a row.
      std::ofstream("results.csv", std::ios::app) << "P2,-0.";
      for (const ResultRow &row : read_results("results.csv"))
        {
          std::cout << "--- read";
          for (const auto &[name, value] : row)
            std::cout << " | " << name << " = " << value;
          std::cout << '\n';
        }
    }
  {
    ResultsCsv again(MPI_COMM_WORLD, "again.csv", {read_results("results.csv").at(1)});
    again.add({{"Method/Element", "P3"}, {"tip, y [m]", "1"}, {"say \"why\"", ""}});
  }
  if (root)
    std::cout << "--- one row kept, one new\n" << contents("again.csv");

  report("no folder", []() { ResultsCsv(MPI_COMM_WORLD, "nowhere/results.csv"); });
  report("disk full", []() {
    ResultsCsv full(MPI_COMM_WORLD, "/dev/full");
    full.add({{"a", "1"}});
  });
}
