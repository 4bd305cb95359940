#pragma once
// The admissible interval of a number.

#include <limits>
#include <string>

namespace mpfem {

/// Admissible closed or half-open interval of a number; the message prints it.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  static constexpr Range any() { return {}; }
  static constexpr Range positive() { return {.low = 0, .low_open = true}; }
  static constexpr Range non_negative() { return {.low = 0}; }
  static constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
  bool contains(double value) const;
  std::string text() const; ///< "> 0", "0 … 1", …; empty if every number is allowed
};

} // namespace mpfem
