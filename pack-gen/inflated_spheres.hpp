#pragma once
// Spheres inflated to keep a gap, as OverlapMinimiser moves them.

#include <vector>

#include "pack-gen/container.hpp"

namespace mpfem {

/// Soft spheres that repel each other come arbitrarily close to touching, but not in finite time: each is inflated by
/// this margin more than its gap needs, which costs 6e-4 of the relative density. In mean inflated radii.
inline constexpr double inflation_margin = 2e-4;
/// Overlaps up to here keep the gap. Two spheres have a margin each, but sphere and wall together only one: a tenth of
/// it is left there, far above rounding.
inline constexpr double allowed_overlap = 0.9 * inflation_margin;

/// Spheres inflated by half of a gap and the margin, in a container whose walls are moved inwards by half of the gap:
/// together that leaves the whole gap between spheres and to the walls. Lengths in `unit`.
struct InflatedSpheres {
  double unit = 0; ///< mm, mean radius and half of the gap
  std::vector<double> radius;
  PackingContainer container;
};

/// `radius` and `gap` in mm.
inline InflatedSpheres inflated_spheres(const std::vector<double>& radius, double gap,
                                        const PackingContainer& container) {
  double mean = 0;
  for (const double r : radius) mean += r / static_cast<double>(radius.size());
  InflatedSpheres inflated{mean + 0.5 * gap, {}, {}};
  for (const double r : radius) inflated.radius.push_back((r + 0.5 * gap) / inflated.unit + inflation_margin);
  inflated.container = container.shrunk(0.5 * gap, inflated.unit);
  return inflated;
}

} // namespace mpfem
