#pragma once
// Places on a Morton curve, along which neighbours in space are mostly neighbours on the curve.

#include <algorithm>
#include <array>
#include <cstdint>

namespace mpfem {

/// Key of a point on a Morton curve through a cube. `fraction`: the point's coordinates over the edge length of the
/// cube, seen from its lowest corner; a point outside takes the key of the nearest cell. 30 bits: 1024 cells along each
/// axis.
inline std::uint64_t morton_key(const std::array<double, 3>& fraction) {
  std::uint64_t key = 0;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::uint64_t>(std::clamp(fraction[axis], 0.0, 1.0) * 1023.0);
    for (unsigned bit = 0; bit < 10; ++bit) key |= ((cell >> bit) & 1U) << (3 * bit + axis);
  }
  return key;
}

} // namespace mpfem
