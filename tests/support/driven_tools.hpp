#pragma once
// Parts of scenes in which rigid tools move.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

} // namespace mpfem::test
