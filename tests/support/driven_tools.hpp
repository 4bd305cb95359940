#pragma once
// Scenes of rigid tools that move.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "solver/scenario/scenario.hpp"

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

} // namespace mpfem::test
