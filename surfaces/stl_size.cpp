#include "surfaces/stl_size.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/one_line.hpp"

namespace mpfem {

std::array<double, 3> lengths_of(const Bounds& bounds) {
  return {bounds.high[0] - bounds.low[0], bounds.high[1] - bounds.low[1], bounds.high[2] - bounds.low[2]};
}

std::string edges_text(const std::array<double, 3>& length) {
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", length[0], length[1], length[2]);
}

std::string size_beside(const StlSize& body, const std::string& what, const std::array<double, 3>& length) {
  return fmt::format("{} spans {} with {} = {:g}, {} {} (STL files state no unit: {} is the mm in one)",
                     shown_path(body.file), edges_text(body.length), body.key, body.scale, what, edges_text(length),
                     body.key);
}

double mean_ratio(const StlSize& body, const std::array<double, 3>& length) {
  return std::cbrt(body.length[0] / length[0] * (body.length[1] / length[1]) * (body.length[2] / length[2]));
}

} // namespace mpfem
