#include <isochor/core/error.h>
#include <isochor/output/atomic_file.h>
#include <isochor/output/checkpoints.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

namespace isochor
{
  namespace
  {
    namespace fs  = std::filesystem;
    namespace MPI = dealii::Utilities::MPI;

    /// To be counted up when what runs save changes.
    constexpr std::string_view format     = "Isochor checkpoint 2\n";
    constexpr std::string_view any_format = format.substr(0, format.rfind(' ') + 1);
    constexpr const char      *prefix     = "checkpoint_";
    constexpr const char      *ranks      = "number of ranks";

    struct Header
    {
      std::uint64_t length, checksum;
    };

    /// FNV-1a of eight bytes at a time.
    std::uint64_t checksum_of(const char *bytes, const std::size_t length)
    {
      std::uint64_t sum = 0xcbf29ce484222325;
      for (std::size_t i = 0; i < length; i += sizeof sum)
        {
          std::uint64_t word = 0;
          std::memcpy(&word, bytes + i, std::min(sizeof word, length - i));
          sum = (sum ^ word) * 0x100000001b3;
          sum ^= sum >> 32; // or a flipped high bit would stay one
        }
      return sum;
    }
  } // namespace

  Checkpoints::Checkpoints(MPI_Comm communicator, fs::path folder, Identity identity)
    : communicator(communicator)
    , rank(MPI::this_mpi_process(communicator))
    , folder(std::move(folder))
    , identity([&]() {
      identity[ranks] = std::to_string(MPI::n_mpi_processes(communicator));
      return std::move(identity);
    }())
  {
  }

  fs::path Checkpoints::piece(const unsigned int number, const unsigned int of_rank) const
  {
    return folder
           / (prefix + dealii::Utilities::int_to_string(number, 4) + "." + std::to_string(of_rank));
  }

  void Checkpoints::save(const unsigned int number, const std::string &contents)
  {
    const std::vector<char> packed
        = dealii::Utilities::pack(std::make_pair(identity, contents), false);
    const Header header{packed.size(), checksum_of(packed.data(), packed.size())};
    std::string  text(format);
    text.append(reinterpret_cast<const char *>(&header), sizeof header);
    text.append(packed.data(), packed.size());
    collectively(communicator, [&]() { write_whole_file(piece(number, rank), text); });

    // All ranks' pieces are on disk now.
    saved.push_back(number);
    if (saved.size() > 2)
      {
        std::error_code ignored;
        fs::remove(piece(saved.front(), rank), ignored);
        saved.erase(saved.begin());
      }
  }

  std::optional<std::pair<Identity, std::string>>
  Checkpoints::read_piece(const unsigned int number) const
  {
    std::ifstream      stream(piece(number, rank), std::ios::binary);
    std::ostringstream all;
    all << stream.rdbuf();
    const std::string text  = all.str();
    const std::size_t begin = format.size() + sizeof(Header);
    Header            header;
    if (text.starts_with(any_format) && !text.starts_with(format))
      throw UserError("--restart: '" + piece(number, rank).string()
                      + "' was saved by another version of Isochor, as '"
                      + text.substr(0, text.find('\n')) + "'; allowed: '"
                      + std::string(format.substr(0, format.size() - 1))
                      + "', or a run from the start with --overwrite");
    if (text.size() < begin || !text.starts_with(format))
      return {};
    std::memcpy(&header, text.data() + format.size(), sizeof header);
    if (header.length != text.size() - begin
        || header.checksum != checksum_of(text.data() + begin, header.length))
      return {};
    return dealii::Utilities::unpack<std::pair<Identity, std::string>>(
        std::vector<char>(text.begin() + begin, text.end()), false);
  }

  std::vector<unsigned int> Checkpoints::numbers() const
  {
    std::vector<unsigned int> found;
    on_root_collectively(communicator, [&]() {
      std::error_code error;
      for (const auto &entry : fs::directory_iterator(folder, error))
        {
          const std::string name = entry.path().filename().string();
          unsigned int      number;
          const char *const begin = name.c_str() + std::min(name.size(), std::strlen(prefix));
          const auto [rest, bad]  = std::from_chars(begin, name.c_str() + name.size(), number);
          if (name.starts_with(prefix) && bad == std::errc() && std::string_view(rest) == ".0")
            found.push_back(number);
        }
    });
    std::sort(found.begin(), found.end(), std::greater<>());
    return MPI::broadcast(communicator, found);
  }

  void Checkpoints::check(const Identity &theirs) const
  {
    for (const auto &[name, value] : identity)
      {
        const auto other = theirs.find(name);
        if (other == theirs.end() || other->second != value)
          throw UserError("--restart: the states in '" + folder.string()
                          + "' belong to another run: " + name + " was '"
                          + (other == theirs.end() ? "" : other->second) + "', is '" + value
                          + "'; allowed: the same scene and element on as many "
                            "ranks, or a run from the start with --overwrite");
      }
  }

  std::optional<Checkpoints::Saved> Checkpoints::load(std::vector<std::string> &complaints)
  {
    saved.clear();
    const std::vector<unsigned int> all = numbers();
    for (const unsigned int number : all)
      {
        std::optional<std::pair<Identity, std::string>> mine;
        // Rank 0 alone first: it says so if there were more or fewer ranks.
        on_root_collectively(communicator, [&]() {
          mine = read_piece(number);
          if (mine)
            check(mine->first);
        });
        collectively(communicator, [&]() {
          if (rank != 0)
            mine = read_piece(number);
          if (mine)
            check(mine->first);
        });
        if (MPI::min(mine ? 1 : 0, communicator) == 1)
          {
            for (const unsigned int older : all)
              if (older <= number)
                saved.insert(saved.begin(), older);
            return Saved{number, std::move(mine->second)};
          }
        complaints.push_back("the state saved after load step " + std::to_string(number)
                             + " is damaged or not whole, and is not used");
      }
    return {};
  }

  void Checkpoints::remove()
  {
    for (const unsigned int number : numbers())
      {
        std::error_code ignored;
        fs::remove(piece(number, rank), ignored);
      }
    saved.clear();
  }
} // namespace isochor
