#include <isochor/core/version.h>

#include <deal.II/base/config.h>

#include <dlfcn.h>
#include <dmumps_c.h>
#include <gmsh.h>
#include <link.h>

#include <filesystem>

#ifdef __clang__ // names itself
#  define COMPILER_NAME ""
#else
#  define COMPILER_NAME "GCC "
#endif

#include <sstream>

namespace isochor
{
  namespace
  {
    std::string resolved(const std::string &path)
    {
      std::error_code error;
      const auto      target = std::filesystem::canonical(path, error);
      return error ? path : target.string();
    }

    /// Path of the first loaded library whose file name begins with @p name; empty if none does.
    std::string loaded_library(const std::string &name)
    {
      std::pair<std::string, std::string> search(name, "");
      dl_iterate_phdr(
          [](dl_phdr_info *library, std::size_t, void *data) {
            auto &[wanted, found] = *static_cast<std::pair<std::string, std::string> *>(data);
            const auto path       = std::filesystem::path(library->dlpi_name);
            if (!path.filename().string().starts_with(wanted))
              return 0;
            found = path.string();
            return 1;
          },
          &search);
      return resolved(search.second);
    }

    /// The BLAS whose dgemm the program calls, be it OpenBLAS or the slow reference one.
    std::string blas()
    {
      Dl_info     info;
      void *const dgemm = dlsym(RTLD_DEFAULT, "dgemm_");
      if (dgemm == nullptr || dladdr(dgemm, &info) == 0 || info.dli_fname == nullptr)
        return "not found";
      std::string text = resolved(info.dli_fname);
      if (void *const config = dlsym(RTLD_DEFAULT, "openblas_get_config"))
        text += std::string(" (") + reinterpret_cast<char *(*)()>(config)() + ")";
      return text;
    }

    std::string dealii_library()
    {
      const std::string path = loaded_library("libdeal");
      if (path.empty())
#ifdef DEBUG
        return "debug";
#else
        return "optimised";
#endif
      const bool debug
          = std::filesystem::path(path).filename().string().find(".g.so") != std::string::npos;
      return (debug ? "debug, " : "optimised, ") + path;
    }
  } // namespace

  std::string version_text()
  {
    std::ostringstream out;
    out << "Isochor " << ISOCHOR_VERSION << ", " << ISOCHOR_BUILD_TYPE << " build"
        << (ISOCHOR_NATIVE ? " for this machine's processor (-march=native)" : "")
        << "\n  compiler: " << COMPILER_NAME << __VERSION__
        << "\n  deal.II:  " << DEAL_II_PACKAGE_VERSION << " (" << dealii_library() << ")"
        << "\n  MUMPS:    " << MUMPS_VERSION << "\n  gmsh:     " << GMSH_API_VERSION
        << "\n  BLAS:     " << blas() << "\n";
    return out.str();
  }
} // namespace isochor
