#include "postproc/drawing/field_display.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "postproc/fits/statistics.hpp"

namespace mpfem {

std::string field_label(const std::string& field) {
  return field == "von_mises"  ? "von Mises stress"
         : field == "pressure" ? "Pressure"
         : field == "damage"   ? "Damage of bonds"
                               : "Equivalent plastic strain";
}

std::string with_unit(const std::string& label, const std::string& unit) {
  return unit == "1" ? label : fmt::format("{} ({})", label, unit);
}

std::pair<double, double> colour_range(std::vector<std::pair<double, double>> value_and_area) {
  std::erase_if(value_and_area, [](const auto& part) { return !std::isfinite(part.first); });
  const WeightedPercentiles percentiles(std::move(value_and_area));
  std::pair<double, double> range{std::min(0.0, percentiles.at(0.005)), percentiles.at(0.995)};
  if (!(range.second > range.first)) range.second = range.first + 1;
  return range;
}

} // namespace mpfem
