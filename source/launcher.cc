// What a user starts: sets what libraries read from the environment when they are loaded, then becomes
// the program, libexec/isochor beside this file. Links none of them: loading all takes the program a
// third of a second.

#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>

namespace
{
  /// OpenBLAS' names of kernels without AVX.
  constexpr const char *outdated[] = {"Prescott", "Core2", "Nehalem", "Barcelona"};

  /// Kernels that the BLAS will choose, in OpenBLAS' own word; empty for any other BLAS.
  std::string chosen_kernels()
  {
    void *const blas = dlopen("libblas.so.3", RTLD_LAZY);
    void *const name = blas == nullptr ? nullptr : dlsym(blas, "openblas_get_corename");
    return name == nullptr ? "" : reinterpret_cast<char *(*)()>(name)();
  }

  /// What OpenBLAS should be asked for; null if that is not known.
  const char *suitable_kernels()
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

  /// OpenBLAS chooses its kernels by the processor's model. A model that is younger than the library is
  /// taken for one of 2004: Debian 12's 0.3.21 does so with Intel's fifth generation of Xeon, on which
  /// factorisations then take 2.5 to 3 times as long.
  void choose_blas_kernels()
  {
    const char *const better = suitable_kernels();
    if (better == nullptr || std::getenv("OPENBLAS_CORETYPE") != nullptr)
      return;
    const std::string chosen = chosen_kernels();
    if (std::find(std::begin(outdated), std::end(outdated), chosen) != std::end(outdated))
      setenv("OPENBLAS_CORETYPE", better, 1);
  }

  /// Without mpirun Open MPI 4 starts a daemon, which only programs that spawn others need; it takes
  /// 0.15 s.
  void start_no_daemon()
  {
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  }

  /// Path of the program; empty if this file's own cannot be found.
  std::string program()
  {
    char          path[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", path, sizeof path);
    if (length < 0)
      return {};
    const std::string own(path, length);
    return own.substr(0, own.rfind('/')) + "/libexec/isochor";
  }
} // namespace

int main(int, char **argv)
{
  choose_blas_kernels();
  start_no_daemon();
  const std::string path = program();
  execv(path.c_str(), argv);
  std::fprintf(stderr,
               "internal error: cannot start '%s', which belongs beside this program: %s\n",
               path.c_str(),
               std::strerror(errno));
  return 3;
}
