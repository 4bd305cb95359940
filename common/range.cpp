#include "common/range.hpp"

#include <cmath>

#include <fmt/format.h>

namespace mpfem {

bool Range::contains(double value) const {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

std::string Range::text() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  const std::string above = fmt::format("{} {}", low_open ? ">" : "≥", low);
  const std::string below = fmt::format("{} {}", high_open ? "<" : "≤", high);
  if (has_low && has_high)
    return low_open || high_open ? fmt::format("{} and {}", above, below) : fmt::format("{} … {}", low, high);
  return has_low ? above : has_high ? below : "";
}

} // namespace mpfem
