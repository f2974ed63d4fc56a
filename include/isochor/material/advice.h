#pragma once

// What can be said of a material before anything is computed.

#include <isochor/material/moduli.h>

#include <vector>

namespace isochor
{
  /// Sentences in plain words, each naming section/key, about what the material does that its user
  /// may not expect: another E and nu than those given, a stress at rest, strains that rotations
  /// change, no energy. None for an ordinary material. Throws UserError where moduli() does.
  std::vector<std::string> advice(const MaterialParameters &material);
} // namespace isochor
