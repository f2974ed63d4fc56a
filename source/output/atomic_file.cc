#include <isochor/core/error.h>
#include <isochor/output/atomic_file.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace isochor
{
  void write_whole_file(const std::filesystem::path &file, const std::string &contents)
  {
    const std::string temporary = file.string() + ".part";

    int reason = 0;
    errno      = 0;
    if (std::FILE *const stream = std::fopen(temporary.c_str(), "wb"))
      {
        if (std::fwrite(contents.data(), 1, contents.size(), stream) != contents.size())
          reason = errno;
        // What was buffered may fail only now.
        if (std::fclose(stream) != 0 && reason == 0)
          reason = errno;
        if (reason == 0 && std::rename(temporary.c_str(), file.c_str()) != 0)
          reason = errno;
        if (reason != 0)
          std::remove(temporary.c_str());
      }
    else
      reason = errno;

    if (reason != 0)
      throw UserError(file.string() + ": cannot be written: " + std::strerror(reason));
  }
} // namespace isochor
