#pragma once
// The container of a packing's grains.

#include <array>
#include <numbers>
#include <span>
#include <string_view>

namespace mpfem {

/// A box; a cylinder with the axis z through the middle of its bounding box [D, D, H]; or the inside of a closed
/// surface of triangles with the box as its bounding box.
enum class ContainerShape { box, cylinder, surface };

/// Names in files, in the order of ContainerShape.
inline constexpr std::array<std::string_view, 3> container_names = {"box", "cylinder", "surface"};

/// Name of a shape in files.
constexpr std::string_view name_of(ContainerShape shape) {
  return container_names[static_cast<std::size_t>(shape)];
}

/// Volume (mm^3) of a box, or of a cylinder (pi/4 D^2 H), with these three edge lengths (mm) of the bounding box. Not
/// for surfaces.
constexpr double container_volume(ContainerShape shape, std::span<const double> edges) {
  const double box = edges[0] * edges[1] * edges[2];
  return shape == ContainerShape::box ? box : 0.25 * std::numbers::pi * box;
}

} // namespace mpfem
