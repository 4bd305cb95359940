#include "common/version.hpp"

#include <fmt/format.h>

#include "common/commit.hpp"

namespace mpfem {

std::string_view version() {
  return MPFEM_VERSION;
}

std::string version_and_commit() {
  constexpr std::string_view commit = MPFEM_COMMIT;
  return commit.empty() ? std::string(version()) : fmt::format("{} (commit {})", version(), commit);
}

} // namespace mpfem
