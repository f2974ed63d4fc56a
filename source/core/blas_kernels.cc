#include <isochor/core/blas_kernels.h>

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

namespace isochor
{
  namespace
  {
    constexpr const char *variable = "OPENBLAS_CORETYPE";

    /// OpenBLAS' names of kernels without AVX, of those that it takes for an unknown processor.
    constexpr const char *outdated[] = {"Prescott", "Core2", "Nehalem", "Barcelona"};

    /// What OpenBLAS should be asked for; null if that is not known.
    const char *suitable()
    {
#ifdef __x86_64__
      // Newer ones, as for AVX-512 of Sapphire Rapids, were slower in MUMPS.
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw")
          && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return "SkylakeX";
      if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return "Haswell";
#endif
      return nullptr;
    }
  } // namespace

  std::string blas_kernels()
  {
    void *const name = dlsym(RTLD_DEFAULT, "openblas_get_corename");
    return name == nullptr ? "" : reinterpret_cast<char *(*)()>(name)();
  }

  void choose_blas_kernels(char **argv)
  {
    const std::string chosen = blas_kernels();
    const char *const better = suitable();
    if (better == nullptr || std::getenv(variable) != nullptr
        || std::find(std::begin(outdated), std::end(outdated), chosen) == std::end(outdated))
      return;
    setenv(variable, better, 1);
    execv("/proc/self/exe", argv);
    // Slow kernels compute the same.
    unsetenv(variable);
  }
} // namespace isochor
