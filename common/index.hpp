#pragma once
// Node, tet, facet and grain numbers are 32-bit, as in the packing file; containers are indexed by std::size_t.

#include <cstddef>
#include <cstdint>

namespace mpfem {

/// A number that is not negative, as the index of a container.
constexpr std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

} // namespace mpfem
