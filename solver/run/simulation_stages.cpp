// The beginning of a stage: walls and tools leave or return, grips take hold.

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/parallel/grain_values.hpp"
#include "solver/run/simulation.hpp"
#include "solver/run/stage_forecast.hpp"

namespace mpfem {

Axes Simulation::withdrawn_in(std::int64_t stage) const {
  if (!scenario_->walls) return all_axes;
  return withdrawn_axes(scenario_->stages[static_cast<std::size_t>(stage)].type);
}

void Simulation::begin_stage(std::int64_t stage) {
  change_walls(withdrawn_in(stage));
  state_.stage = stage;
  change_tools();
  if (const std::string reason =
          unreachable_stress(scenario_->stages[static_cast<std::size_t>(stage)], box_.mean_stress());
      !reason.empty())
    throw InputError(reason);
  stage_run_.emplace(scenario_->stages[static_cast<std::size_t>(stage)],
                     StageStart{box_.cell(), box_.mean_stress(), sample_of(model_)}, energies_.plastic_dissipation);
  plan_.reset();
  damping_rate_ = damping_rate();
  grip_faces();
}

/// Withdrawn walls take the energy stored in their penalty and friction with them. Returning walls begin where they
/// touch nothing, so the ledger follows them from the first touch on.
void Simulation::change_walls(const Axes& withdrawn) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (withdrawn[axis] && box_.has_walls(axis))
      for (std::size_t side = 2 * axis; side < 2 * axis + 2; ++side)
        energies_.leave_with(force_total_.box.wall[side].energy + force_total_.wall_friction.energy[side]);
    if (!withdrawn[axis] && !box_.has_walls(axis)) return_walls(axis);
  }
  box_.withdraw(withdrawn);
  wall_friction_.forget(withdrawn);
}

namespace {

/// Unit vector along which a stage drives a tool; 0 where it does not.
std::array<double, 3> way_of(const ToolDrive& drive) {
  const double speed = std::hypot(drive.velocity[0], drive.velocity[1], drive.velocity[2]);
  if (drive.holds_push() || speed == 0) return drive.direction;
  return {drive.velocity[0] / speed, drive.velocity[1] / speed, drive.velocity[2] / speed};
}

} // namespace

/// In stages of other types all tools are in place.
void Simulation::change_tools() {
  const auto* loading = std::get_if<ToolLoading>(&scenario_->stages[static_cast<std::size_t>(state_.stage)].type);
  std::span<const std::size_t> away;
  std::vector<std::array<double, 3>> ways(tools_.size()); // along which tools are driven
  if (loading != nullptr) {
    away = loading->away;
    for (const ToolDrive& drive : loading->drives) ways[drive.tool] = way_of(drive);
  }
  const bool punch_was_away = container_ && container_->punch_is_away(tools_);
  energies_.leave_with(tools_.set_away(away, ways, model_, bounds_, state_.last_step, *ranks_));
  // In other stages the cell may have moved without the tools, as with grips.
  if (container_ && (loading != nullptr || punch_was_away)) box_.set_cell(container_->cell(tools_, box_.cell()));
}

void Simulation::return_walls(std::size_t axis) {
  constexpr double largest_growth = 2;
  const double before = box_.cell().length(axis);
  share_of_grains(*ranks_, model_.ownership, std::span(bounds_));
  box_.move_clear(axis, bounds_);
  if (const double length = box_.cell().length(axis); length > largest_growth * before)
    throw SimulationError(fmt::format("stage '{}': the walls along {} cannot return: the grains extend over {:.4g} mm, "
                                      "the walls were {:.4g} mm apart, allowed: up to twice that",
                                      scenario_->stages[static_cast<std::size_t>(state_.stage)].name, "xyz"[axis],
                                      length, before));
}

void Simulation::grip_faces() {
  grips_ = {};
  const GripMotion* grip = stage_run_->control().grips();
  if (!grip) return;
  grips_ = grip_nodes(model_, box_.cell(), grip->axis, grip->depth, grip->lateral_fixed);
  std::array<double, 2> holds{};
  for (const GrippedNode& node : grips_.node) holds[static_cast<std::size_t>(node.side)] = 1;
  for (double& side : holds) side = ranks_->largest(side);
  if (holds[0] == 0 || holds[1] == 0)
    throw InputError(fmt::format("stage '{}': key 'grip_depth': found {:g} mm, but no node lies so close to the {} "
                                 "face of the box, allowed: a larger value",
                                 stage().name, grip->depth, holds[0] > 0 ? "high" : "low"));
}

StageResult Simulation::stage_result() const {
  return stage_run_->result(observation());
}

} // namespace mpfem
