#pragma once
// Rigid tools from a run file: their surfaces, and their places in a snapshot.

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "results-schema/file.hpp"

namespace mpfem {

/// Shapes of tools, as in a run file.
enum class ToolKind { plane, cylinder, sphere, cone, triangles };

/// The surface of a rigid tool; each shape uses some of the members.
struct ToolGeometry {
  std::string name;
  ToolKind shape = ToolKind::plane;
  bool inside = false;               ///< grains are inside: a die, a hopper, a container
  std::array<double, 3> point{};     ///< mm: on a plane; middle of a cylinder's axis; centre of a sphere; apex
  std::array<double, 3> direction{}; ///< unit: normal towards the grains; axis; axis towards a cone's opening
  double radius = 0;                 ///< mm, of a cylinder or sphere
  double half_length = std::numeric_limits<double>::infinity(); ///< mm, of a cylinder
  double rounding = 0;                                          ///< mm, of a cylinder's edges
  double half_angle = 0;                                        ///< rad, of a cone
  std::vector<std::array<double, 3>> vertex;                    ///< mm, of triangles
  std::vector<std::array<std::int32_t, 3>> triangle;            ///< counter-clockwise seen from outside

  /// The coordinate axis of a cylinder or cone.
  std::size_t axis() const;
};

/// The tools that are in place in a snapshot, moved to their places. Empty where the run has no tools, or was written
/// before run files had tool geometry. Throws InputError.
std::vector<ToolGeometry> placed_tools(const schema::FileReader& file, const std::string& snapshot);

} // namespace mpfem
