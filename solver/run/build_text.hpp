#pragma once
// The text by which ranks see whether they are of one build.

#include <string>

#include <fmt/format.h>

#include "common/version.hpp"
#include "solver/physics/pack.hpp"

namespace mpfem {

/// This build as far as ranks must agree on it: "mpfem 0.2.0 (…) with 8 numbers a vector".
inline std::string build_text() {
  return fmt::format("mpfem {} with {} numbers a vector", version_and_commit(), native_lanes);
}

} // namespace mpfem
