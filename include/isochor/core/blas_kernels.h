#pragma once

// OpenBLAS chooses its kernels by the processor's model when it is loaded. A model that is younger than
// the library is taken for one of 2004: Debian 12's 0.3.21 does so with Intel's fifth generation of
// Xeon, on which factorisations then take 2.5 to 3 times as long.

#include <string>

namespace isochor
{
  /// Kernels that OpenBLAS has chosen, in its own word ("SkylakeX"); empty for any other BLAS.
  std::string blas_kernels();

  /// Run the program anew, with @p argv, where OpenBLAS has chosen kernels without AVX on a processor
  /// that has it and the environment (OPENBLAS_CORETYPE) asks for none. Returns otherwise. To be called
  /// before anything else, MPI above all.
  void choose_blas_kernels(char **argv);
} // namespace isochor
