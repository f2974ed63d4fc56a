// Name tables, and errors on one rank that must reach all: rank 1 fails and both ranks catch,
// with the same message.

#include <isochor/core/error.h>
#include <isochor/core/names.h>

#include <deal.II/base/mpi.h>

#include <iostream>

using namespace isochor;

namespace
{
  enum class Fruit
  {
    apple,
    blood_orange
  };
  constexpr auto fruit_names
      = name_table<Fruit>({{Fruit::apple, "apple"}, {Fruit::blood_orange, "blood orange"}});

  std::string caught(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const UserError &error)
      {
        return std::string("UserError: ") + error.what();
      }
    catch (const std::runtime_error &error)
      {
        return std::string("runtime_error: ") + error.what();
      }
    return "nothing";
  }
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);

  if (rank == 0)
    {
      std::cout << fruit_names.name(Fruit::blood_orange) << '\n'
                << fruit_names.selection() << '\n'
                << (fruit_names.value("apple", "Fruit") == Fruit::apple) << '\n'
                << caught([]() { fruit_names.value("pear", "Bowl/Fruit"); }) << '\n'
                << listed({}) << " | " << listed({"a"}) << " | " << listed({"a", "b", "c"}) << '\n';
    }

  const auto report = [&](const std::string &title, const std::string &mine) {
    const auto all = dealii::Utilities::MPI::gather(MPI_COMM_WORLD, mine);
    if (rank == 0)
      for (unsigned int r = 0; r < all.size(); ++r)
        std::cout << title << ", rank " << r << ": " << all[r] << '\n';
  };
  report("none fails", caught([]() { collectively(MPI_COMM_WORLD, []() {}); }));
  report("rank 1 fails", caught([&]() {
           collectively(MPI_COMM_WORLD, [&]() {
             if (rank == 1)
               throw UserError("rank 1 says no");
           });
         }));
  report("both fail", caught([&]() {
           collectively(MPI_COMM_WORLD, [&]() {
             if (rank == 0)
               throw std::runtime_error("internal trouble");
             throw UserError("rank 1 says no");
           });
         }));
  report("root fails", caught([&]() {
           on_root_collectively(MPI_COMM_WORLD, [&]() {
             throw UserError("root says no, it is rank " + std::to_string(rank));
           });
         }));
}
