#pragma once
// Every tolerance of the solver's tests, with its reason.

#include <cmath>

namespace mpfem::test {

/// Sums of a few dozen operations on doubles.
inline constexpr double rounding = 1e-13;
/// Sums over many nodes or steps.
inline constexpr double accumulated_rounding = 1e-10;

inline bool within(double value, double expected, double relative) {
  return std::abs(value - expected) <= relative * std::max(std::abs(value), std::abs(expected));
}

} // namespace mpfem::test
