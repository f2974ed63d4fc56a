#pragma once

// What `isochor --version` says: which code, built how, on which libraries.

#include <string>

namespace isochor
{
  /// Several lines: Isochor's version, build type and compiler; versions of deal.II (and whether
  /// the loaded library is the optimised one), MUMPS and gmsh; the BLAS that is loaded.
  std::string version_text();
} // namespace isochor
