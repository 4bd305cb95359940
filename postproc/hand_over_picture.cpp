#include "postproc/hand_over_picture.hpp"

#include <filesystem>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <unistd.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

/// How to get postproc-picture where it is missing beside a postproc in this folder, of a build or an installation.
std::string remedy(const std::filesystem::path& folder) {
  std::error_code ignored;
  const std::filesystem::path above = folder.parent_path();
  if (std::filesystem::exists(above / "CMakeCache.txt", ignored))
    return "is not built: ./bootstrap pictures builds it, and installs VTK 9 on Debian";
  return fmt::format("is not installed: run ./bootstrap pictures and cmake --install build --component "
                     "pictures --prefix {} in the sources of mpfem (it needs VTK 9, so the Debian package lacks it)",
                     one_line(above.string()));
}

} // namespace

void hand_over_picture(int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "picture") return;
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string program = self.string() + "-picture";
  execv(program.c_str(), argv); // returns only on failure
  for (int i = 2; i < argc; ++i)
    if (std::string_view(argv[i]) == "--help" || std::string_view(argv[i]) == "-h") return;
  throw SimulationError(fmt::format("{} {}", one_line(program), remedy(self.parent_path())));
}

} // namespace mpfem
