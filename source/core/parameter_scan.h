#pragma once

// First half of reading parameters: which sections and keys there are, and what a file or an
// override sets, with the place it was said, checked for spelling and structure.

#include <isochor/core/parameters.h>

#include <memory>

namespace isochor::parameter_scan
{
  using Path = std::vector<std::string>; ///< sections, outermost first

  /// "Section/Key"
  std::string joined(const Path &sections, const std::string &key = "");

  /// A piece of the user's text in quotes, as far as a message can bear it.
  std::string quoted(std::string text);

  /// One `set`, from the file or an override.
  struct Assignment
  {
    Path        sections;
    std::string key;
    std::string value;
    std::string origin; ///< "FILE, line 7" or "--set ..."
  };

  /// The sections and keys that a ParameterHandler knows.
  class Declared
  {
  public:
    explicit Declared(const dealii::ParameterHandler &prm);

    bool has_section(const Path &path) const;
    bool has_key(const Path &path, const std::string &key) const;
    /// Keys (or else sections) directly in the section @p path.
    std::vector<std::string> names(const Path &path, bool keys) const;
    /// "Section/Key" of every key of that name, anywhere.
    std::vector<std::string> places_of(const std::string &key) const;
    /// What values the key takes, in words.
    std::string allowed(const Path &path, const std::string &key) const;

  private:
    struct Tree; // keeps boost out of this header
    std::shared_ptr<const Tree> root;
  };

  /// What @p file sets, includes followed. Throws UserError.
  std::vector<Assignment> assignments_in(const Declared              &declared,
                                         const std::filesystem::path &file);

  /// What an override "Section/Key=value" sets. Throws UserError.
  Assignment override_of(const Declared &declared, const std::string &text);
} // namespace isochor::parameter_scan
