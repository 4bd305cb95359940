#include "postproc/metrics/love_weber.hpp"

#include <algorithm>

#include <Eigen/Dense>

namespace mpfem {

Region inner_region(const Region& whole, double share) {
  const Eigen::Vector3d centre = 0.5 * (whole.low + whole.high), half = 0.5 * share * (whole.high - whole.low);
  return {centre - half, centre + half};
}

double share_inside(const Region& region, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  double begin = 0, end = 1; // of the line, clipped by the two planes normal to each axis (Liang and Barsky 1984)
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double length = to[axis] - from[axis];
    if (length == 0) {
      if (from[axis] < region.low[axis] || from[axis] >= region.high[axis]) return 0;
      continue;
    }
    const double low = (region.low[axis] - from[axis]) / length, high = (region.high[axis] - from[axis]) / length;
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
  }
  return std::max(0.0, end - begin);
}

Eigen::Matrix3d love_weber_stress(const Region& region, std::span<const ForceLine> lines) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const ForceLine& line : lines)
    sum -= share_inside(region, line.from, line.to) * line.force * (line.to - line.from).transpose();
  return sum / region.volume();
}

double solid_mean_stress(const Region& region, std::span<const PressedVolume> solid) {
  double sum = 0;
  for (const PressedVolume& part : solid)
    if (region.contains(part.centre)) sum += part.volume * part.pressure;
  return sum / region.volume();
}

} // namespace mpfem
