#include "solver/scenario/tools.hpp"

#include <cmath>

namespace mpfem {

const char* shape_name(const ToolShape& shape) {
  constexpr std::array names{"plane", "cylinder", "sphere", "cone", "stl"}; // in the order of ToolShape
  static_assert(names.size() == std::variant_size_v<ToolShape>);
  return names[shape.index()];
}

std::optional<std::array<double, 3>> direction_of(const ToolShape& shape) {
  std::array<double, 3> direction{};
  if (const auto* plane = std::get_if<PlaneShape>(&shape)) {
    const std::array<double, 3>& n = plane->normal;
    const double length = std::hypot(n[0], n[1], n[2]);
    return std::array{n[0] / length, n[1] / length, n[2] / length};
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&shape))
    direction[cylinder->axis] = 1;
  else if (const auto* cone = std::get_if<ConeShape>(&shape))
    direction[cone->axis] = 1;
  else
    return std::nullopt;
  return direction;
}

} // namespace mpfem
