#pragma once
// Parts of scenes in which rigid tools move.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"

namespace mpfem::test {

inline ToolParameters plane(const std::string& name, const std::array<double, 3>& point,
                            const std::array<double, 3>& normal, double friction = 0) {
  return {.name = name, .shape = PlaneShape{{}, point, normal}, .friction = friction};
}

/// A stage in which tools move for a time, damped at a rate (1/s).
inline Stage driven(std::vector<ToolDrive> drives, double duration, double damping = 0) {
  ToolLoading loading;
  for (const ToolDrive& drive : drives) {
    loading.speed = std::max(loading.speed, std::hypot(drive.velocity[0], drive.velocity[1], drive.velocity[2]));
    loading.servo_speed = std::max(loading.servo_speed, drive.servo_speed);
  }
  loading.drives = std::move(drives);
  loading.ends.duration = duration;
  Stage stage;
  stage.name = "driven";
  stage.type = loading;
  if (damping > 0) stage.damping = {damping, 1e9};
  return stage;
}

/// A block with edges of 0.2 mm about the point 0.5, 0.5, 0.5, of three cells along each.
inline GrainMesh block_in_the_middle() {
  GrainMesh block = cube_mesh(3);
  scale(block, 0.1);
  move(block, {0.5, 0.5, 0.5});
  return block;
}

/// Advances to the end of the stage, and has the forces there.
inline void finish_stage(Simulation& simulation) {
  for (simulation.evaluate_forces(); !simulation.stage_complete(); simulation.evaluate_forces()) simulation.advance();
}

/// A slab in ASCII STL, in metres.
inline std::string slab_stl(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  // Corners by bits: x, y, z; faces counter-clockwise from outside.
  constexpr int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::string text = "solid slab\n";
  const auto corner = [&](int bits) {
    std::string line = "vertex";
    for (std::size_t axis = 0; axis < 3; ++axis)
      line += fmt::format(" {}", 1e-3 * ((bits >> axis & 1) != 0 ? high[axis] : low[axis]));
    return line + "\n";
  };
  for (const auto& quad : quads)
    for (const auto& triangle : {std::array{quad[0], quad[1], quad[2]}, std::array{quad[0], quad[2], quad[3]}})
      text += "facet normal 0 0 0\nouter loop\n" + corner(triangle[0]) + corner(triangle[1]) + corner(triangle[2]) +
              "endloop\nendfacet\n";
  return text + "endsolid slab\n";
}

} // namespace mpfem::test
