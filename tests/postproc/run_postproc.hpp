#pragma once
// postproc as users start it.

#include <fmt/format.h>

#include "tests/support/folder.hpp"

namespace mpfem::test {

/// Runs postproc with these arguments, written as in a shell.
inline Outcome postproc(const std::string& arguments) {
  return run_command(fmt::format("'{}' {}", MPFEM_POSTPROC, arguments));
}

} // namespace mpfem::test
