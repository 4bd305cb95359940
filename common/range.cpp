#include "common/range.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/number_text.hpp"

namespace mpfem {

namespace {

/// The shorter of "1e+12" and "1000000000000" if both are the same number.
std::string limit_text(double limit) {
  std::string whole = fmt::format("{}", limit), short_text = fmt::format("{:g}", limit);
  const bool same = finite_number(short_text) == limit;
  return same && short_text.size() < whole.size() ? short_text : whole;
}

} // namespace

bool Range::contains(double value) const {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

std::string Range::text() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  const std::string above = fmt::format("{} {}", low_open ? ">" : "≥", limit_text(low));
  const std::string below = fmt::format("{} {}", high_open ? "<" : "≤", limit_text(high));
  if (has_low && has_high)
    return low_open || high_open ? fmt::format("{} and {}", above, below)
                                 : fmt::format("{} … {}", limit_text(low), limit_text(high));
  return has_low ? above : has_high ? below : "";
}

std::string allowed_number(std::string_view kind, const Range& range, std::string_view unit) {
  const std::string limits = range.text();
  std::string text(kind);
  for (const std::string_view part : {std::string_view(limits), unit})
    if (!part.empty()) text.append(text.empty() ? "" : " ").append(part);
  return text;
}

} // namespace mpfem
