#pragma once
// Tolerances that many tests of the solver share, each with its reason. All are relative. A tolerance of one test alone
// stands there, argued for beside it. Catch2's Approx is never used bare: by default it lets errors of 1e-5 pass.
// tests/architecture/tolerances.sh checks that.

#include <algorithm>
#include <cmath>

namespace mpfem::test {

/// A closed form against the same number computed otherwise: a few dozen operations on doubles.
inline constexpr double rounding = 1e-13;
/// Sums over many nodes, bonds or steps.
inline constexpr double accumulated_rounding = 1e-10;

/// True where `value` and `expected` differ by no more than `relative` of the larger magnitude.
inline bool within(double value, double expected, double relative) {
  return std::abs(value - expected) <= relative * std::max(std::abs(value), std::abs(expected));
}

} // namespace mpfem::test
