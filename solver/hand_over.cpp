#include "solver/hand_over.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "common/errors.hpp"

namespace mpfem {

void hand_over_to_best_build(char** arguments) {
  int newest = 4;
  if (const char* wanted = std::getenv("MPFEM_INSTRUCTION_SET")) {
    const std::string level = wanted;
    if (level != "v2" && level != "v3" && level != "v4")
      throw InputError(fmt::format("MPFEM_INSTRUCTION_SET: found '{}', allowed: v2, v3 or v4", level));
    newest = level[1] - '0';
  }
  if (newest >= 4 && !__builtin_cpu_supports("x86-64-v4")) newest = 3;
  if (newest >= 3 && !__builtin_cpu_supports("x86-64-v3")) newest = 2;
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return;
  // execv returns only if it fails: then there is no such build.
  for (int level = newest; level > 2; --level) execv(fmt::format("{}-v{}", self.string(), level).c_str(), arguments);
}

} // namespace mpfem
