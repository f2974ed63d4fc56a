#pragma once

// Saved states of a run, from which it goes on after an interruption. What is saved are bytes of
// each rank, its own share; this room does not know what they mean.

#include <mpi.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace isochor
{
  /// What a saved state belongs to, by name: parameters, counts of the mesh. The same names in
  /// every run; values may differ from rank to rank.
  using Identity = std::map<std::string, std::string>;

  /// The states are checkpoint_0007.0, checkpoint_0007.1, ... of load step 7, a piece of each rank;
  /// the last two are kept. A piece is a line that names its format, then length, checksum and
  /// bytes. Each is whole at any moment, and a state counts only if the pieces of all ranks do.
  class Checkpoints
  {
  public:
    /// Nothing is read or written yet.
    Checkpoints(MPI_Comm communicator, std::filesystem::path folder, Identity identity);

    /// Save @p contents of this rank after load step @p number, which has grown since the last call.
    /// Throws UserError naming a file that cannot be written. Collective.
    void save(unsigned int number, const std::string &contents);

    struct Saved
    {
      unsigned int number = 0;
      std::string  contents; ///< of this rank
    };

    /// The newest state that is whole; none if there is none. @p complaints gets a sentence for
    /// each newer one that is not. Throws UserError if it belongs to something else, with the first
    /// difference, or is in the format of another version. Collective.
    std::optional<Saved> load(std::vector<std::string> &complaints);

    /// Remove all states: the run has come to its end. Collective.
    void remove();

    /// Load steps of which there are states, whole or not, descending. Collective.
    std::vector<unsigned int> numbers() const;

  private:
    std::filesystem::path piece(unsigned int number, unsigned int of_rank) const;
    /// Identity and contents; none if the piece is missing or damaged. Throws UserError if its format
    /// is that of another version.
    std::optional<std::pair<Identity, std::string>> read_piece(unsigned int number) const;
    void                                            check(const Identity &theirs) const;

    MPI_Comm                    communicator;
    const unsigned int          rank;
    const std::filesystem::path folder;
    const Identity              identity;
    std::vector<unsigned int>   saved; ///< numbers on disk, ascending
  };
} // namespace isochor
