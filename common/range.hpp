#pragma once
// The admissible interval of a number.

#include <limits>
#include <string>
#include <string_view>

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

/// "a number 0 … 1 mm": what a message says is allowed. Each part may be empty.
std::string allowed_number(std::string_view kind, const Range& range, std::string_view unit = "");

} // namespace mpfem
