#pragma once
// pack-gen as a user starts it.

#include <string>

#include <fmt/format.h>

#include "tests/support/folder.hpp"

namespace mpfem::test {

inline Outcome pack_gen(const std::string& arguments) {
  return run_command(fmt::format("'{}' {}", MPFEM_PACK_GEN, arguments));
}

} // namespace mpfem::test
