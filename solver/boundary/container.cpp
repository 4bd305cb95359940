#include "solver/boundary/container.hpp"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

namespace {

/// Position (mm) of a plane across an axis.
double position_of_plane(const Tool& tool, std::size_t axis) {
  return std::get<OrientedPlane>(tool.surface).point[axis] + tool.moved[axis];
}

CrossSection section_of_bore(const CylinderSurface& bore) {
  const double r = bore.radius;
  return {{bore.centre.x - r, bore.centre.y - r},
          {bore.centre.x + r, bore.centre.y + r},
          std::numbers::pi * r * r,
          2 * std::numbers::pi * r};
}

/// Throws InputError where the die leaves so much of the space between the punches open that grains would spread. Some
/// powder may stand above it.
void check_encloses(const CylinderSurface& bore, const std::string& name, double low, double high) {
  constexpr double least = 0.75;
  const double from = bore.centre.z - bore.half_length, to = bore.centre.z + bore.half_length;
  if (std::min(to, high) - std::max(from, low) >= least * (high - low)) return;
  throw InputError(
      fmt::format("container.wall: the tool '{}' reaches from z = {:g} to {:g} mm, but the punches stand at "
                  "z = {:g} and {:g} mm at the start, allowed: an extent with at least {:g} % of the space "
                  "between them",
                  name, from, to, low, high, 100 * least));
}

} // namespace

Container::Container(const Parts& parts, const Tools& tools) : parts_(parts) {
  const Tool& wall = tools[parts.wall[0]];
  const double low = position_of_plane(tools[parts.lower], 2), high = position_of_plane(tools[parts.upper], 2);
  if (const auto* bore = std::get_if<CylinderSurface>(&wall.surface)) {
    check_encloses(*bore, wall.name, low, high);
    die_ = section_of_bore(*bore);
    section_share_ = std::numbers::pi / 4;
    perimeter_over_width_ = {std::numbers::pi, std::numbers::pi};
  } else if (const auto* body = std::get_if<BodySurface>(&wall.surface)) {
    die_ = section_of_prism(*body->mesh, low, high);
    if (!die_)
      throw InputError(fmt::format("container.wall: the cross-section of '{}' changes between the punches (z = {:g} to "
                                   "{:g} mm), allowed: a die with one cross-section over this height; {}",
                                   wall.name, low, high, wall.size));
    const double x = die_->high[0] - die_->low[0], y = die_->high[1] - die_->low[1];
    section_share_ = die_->area / (x * y);
    perimeter_over_width_ = {die_->perimeter / y, die_->perimeter / x};
  }
}

bool Container::punch_is_away(const Tools& tools) const {
  return tools[parts_.lower].away || tools[parts_.upper].away;
}

Cell Container::cell(const Tools& tools, const Cell& last) const {
  Cell cell = last;
  cell.section_share = section_share_;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Tool &low = tools[parts_.wall[2 * axis]], &high = tools[parts_.wall[2 * axis + 1]];
    cell.low[axis] = die_ ? die_->low[axis] + low.moved[axis] : position_of_plane(low, axis);
    cell.high[axis] = die_ ? die_->high[axis] + high.moved[axis] : position_of_plane(high, axis);
  }
  const Tool &lower = tools[parts_.lower], &upper = tools[parts_.upper];
  if (!lower.away) cell.low[2] = position_of_plane(lower, 2);
  if (!upper.away) cell.high[2] = position_of_plane(upper, 2);
  if (upper.away) cell.high[2] = cell.low[2] + last.length(2);
  if (lower.away) cell.low[2] = cell.high[2] - last.length(2);
  return cell;
}

std::array<double, 6> Container::face_forces(const Tools& tools) const {
  std::array<double, 6> force{};
  for (std::size_t side = 0; side < 4; ++side) {
    const ToolLoad& load = tools.load(parts_.wall[side]);
    const double outwards = side % 2 == 0 ? -1 : 1;
    force[side] = die_ ? load.normal_force / perimeter_over_width_[side / 2] : outwards * load.force[side / 2];
  }
  force[4] = -tools.load(parts_.lower).force.z;
  force[5] = tools.load(parts_.upper).force.z;
  return force;
}

} // namespace mpfem
