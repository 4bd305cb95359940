#include "solver/run/stages/tool_loading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/run/stages/held_stress.hpp"
#include "solver/scenario/ranges.hpp"

namespace mpfem {

namespace {

/// N, push of a tool on the grains along a unit direction: the reverse of the grains' force on it.
double push_along(const std::array<double, 3>& direction, const ToolLoad& load) {
  return -(load.force.x * direction[0] + load.force.y * direction[1] + load.force.z * direction[2]);
}

/// Whether a quantity that began at `start` has come to its target, from either side.
bool has_passed(double target, double start, double now) {
  return start < target ? now >= target : now <= target;
}

} // namespace

ToolLoadingControl::ToolLoadingControl(const ToolLoading& stage, const StageLabel& label, const StageStart& start)
    : stage_(stage), label_(label), start_(start), transit_(wave_transit(start.sample, start.cell)),
      held_(stage.drives.size()) {
  ToolEnds& ends = stage_.ends;
  if (ends.height) ends.relative_density = start.sample.solid_volume / (start.cell.area(2) * *ends.height);
  double travel = expected_strain * start.cell.length(2);
  if (ends.travel) travel = *ends.travel;
  if (ends.relative_density && closing_speed() != 0) {
    const double height = height_at(*ends.relative_density, start.cell.area(2));
    travel = stage.speed * std::abs((start.cell.length(2) - height) / closing_speed());
  }
  constexpr double instant = 1e-12; // s
  if (stage.speed > 0) ramp_ = stage.ramp_fraction * travel / stage.speed;
  // A fraction of the travel is done at half of the speed, at both ends.
  if (const double pace = stage.speed > 0 ? stage.speed : stage.servo_speed; pace > 0)
    expected_duration_ = std::max(travel / pace * (1 + 1.5 * stage.ramp_fraction), instant);
  const bool ends_otherwise = ends.travel || ends.relative_density;
  if (ends.duration)
    expected_duration_ = ends_otherwise ? std::min(expected_duration_, *ends.duration) : *ends.duration;
  std::size_t moved = 0;
  for (const ToolDrive& drive : stage.drives) moved = std::max(moved, drive.tool + 1);
  velocity_.resize(moved);
}

std::string ToolLoadingControl::describe() const {
  if (stage_.drives.empty()) return "tools at rest";
  return fmt::format("{} {} driven", stage_.drives.size(), stage_.drives.size() == 1 ? "tool" : "tools");
}

const ToolDrive* ToolLoadingControl::drive_of(std::size_t tool) const {
  const auto found = std::find_if(stage_.drives.begin(), stage_.drives.end(),
                                  [&](const ToolDrive& drive) { return drive.tool == tool; });
  return found != stage_.drives.end() ? &*found : nullptr;
}

bool ToolLoadingControl::is_away(std::size_t tool) const {
  return std::find(stage_.away.begin(), stage_.away.end(), tool) != stage_.away.end();
}

/// mm, of the container or cell at a relative density, with its section (mm^2) along z.
double ToolLoadingControl::height_at(double density, double area) const {
  return start_.sample.solid_volume / (area * density);
}

/// mm/s, by which the container's height shrinks at full speed. It keeps its height while a punch is away.
double ToolLoadingControl::closing_speed() const {
  if (!stage_.container || is_away(stage_.container->lower) || is_away(stage_.container->upper)) return 0;
  const auto upwards = [&](std::size_t tool) {
    const ToolDrive* drive = drive_of(tool);
    return drive != nullptr ? drive->velocity[2] : 0.0;
  };
  return upwards(stage_.container->lower) - upwards(stage_.container->upper);
}

/// Whether the density follows from the speeds of both punches: no push is held at them, and no lateral plane is
/// driven. (A die that encloses the container stands for all four lateral walls.)
bool ToolLoadingControl::only_punches_change_density() const {
  const ContainerParameters& parts = *stage_.container;
  const auto holds_push = [&](std::size_t tool) {
    const ToolDrive* drive = drive_of(tool);
    return drive != nullptr && drive->holds_push();
  };
  const bool planes = parts.wall[0] != parts.wall[1];
  return !holds_push(parts.lower) && !holds_push(parts.upper) &&
         !(planes && std::any_of(parts.wall.begin(), parts.wall.end(),
                                 [&](std::size_t wall) { return drive_of(wall) != nullptr; }));
}

std::string ToolLoadingControl::unreachable_end() const {
  const ToolEnds& ends = stage_.ends;
  if (!ends.relative_density) return {};
  if (*ends.relative_density > largest_relative_density) // of a height
    return fmt::format("{}stage '{}': key 'height': found {:g} mm, a relative density of {:.4g}, allowed: up to {:g}",
                       label_.places.prefix("height"), label_.name,
                       height_at(*ends.relative_density, start_.cell.area(2)), *ends.relative_density,
                       largest_relative_density);
  if (!only_punches_change_density()) return {};
  const double now = start_.sample.solid_volume / start_.cell.volume(), change = *ends.relative_density / now - 1,
               closing = closing_speed();
  if (std::abs(change) <= already_there || change * closing > 0) return {};
  const bool ends_otherwise =
      ends.axial_stress || ends.travel || ends.force || ends.force_drop || ends.forces_reached || ends.duration;
  if (closing == 0 && ends_otherwise) return {};
  const char* key = ends.height ? "height" : "relative_density";
  const std::string values = ends.height
                                 ? fmt::format("{:g} mm at a start of {:.4g}", *ends.height, start_.cell.length(2))
                                 : fmt::format("{:g} at a start of {:.4g}", *ends.relative_density, now);
  const std::string found =
      fmt::format("{}stage '{}': key '{}': found {}", label_.places.prefix(key), label_.name, key, values);
  if (closing == 0) return found + ", but the punches keep their distance, allowed: with drives that change it";
  return fmt::format("{}, but the punches move {}, allowed: {} than at the start", found,
                     closing > 0 ? "together" : "apart", (closing > 0) == !ends.height ? "more" : "less");
}

void ToolLoadingControl::expect_end(Cell& cell) const {
  if (!stage_.ends.relative_density) return;
  cell.high[2] = cell.low[2] + height_at(*stage_.ends.relative_density, cell.area(2));
}

ToolLoadingControl::Seen ToolLoadingControl::see(const StageObservation& observation) const {
  Seen seen{.time = observation.time, .step = observation.step};
  seen.height = observation.cell.length(2);
  seen.area = observation.cell.area(2);
  seen.density = start_.sample.solid_volume / observation.cell.volume();
  seen.axial_stress = observation.force[2] / seen.area;
  const ToolEnds& ends = stage_.ends;
  if (ends.force || ends.force_drop)
    seen.push = push_along(ends.watched_direction, observation.tools->load(ends.watched));
  return seen;
}

void ToolLoadingControl::begin(const Seen& seen) {
  state_.begun = true;
  state_.start_stress = seen.axial_stress;
  state_.start_push = seen.push;
  state_.start_density = seen.density;
  if (const std::string why = unreachable_end(); !why.empty()) throw SimulationError(why);
}

/// Part of the full speed that is wanted now; `left` (mm) to travel, of the fastest tool.
double ToolLoadingControl::wanted_speed(const Seen& seen, double& left) const {
  const ToolEnds& ends = stage_.ends;
  left = std::numeric_limits<double>::infinity();
  if (ends.travel) left = std::min(left, std::max(*ends.travel - state_.travelled, 0.0));
  if (ends.relative_density && closing_speed() != 0) {
    const double height = height_at(*ends.relative_density, seen.area);
    left = std::min(left, std::max((seen.height - height) / closing_speed(), 0.0) * stage_.speed);
  }
  // A travel that is known ends at rest, by constant deceleration.
  double part = slowed_to_rest(left, stage_.speed, ramp_);
  const auto slow_near = [&](const std::optional<double>& target, double start, double now) {
    if (target && *target != start) part = std::min(part, slowed_near_target((*target - now) / (*target - start)));
  };
  slow_near(ends.axial_stress, state_.start_stress, seen.axial_stress);
  slow_near(ends.force, state_.start_push, seen.push);
  return part;
}

/// MPa over the section at the beginning of the stage.
double ToolLoadingControl::wanted_stress(const ToolDrive& drive) const {
  return drive.stress ? *drive.stress : *drive.force / start_.cell.area(2);
}

/// Whether a drive holds a push and has never reached it.
bool ToolLoadingControl::misses_push(std::size_t drive) const {
  return stage_.drives[drive].holds_push() && !held_[drive].reached;
}

/// A push that was never reached is missing as its servo says.
HoldQuality ToolLoadingControl::hold_quality() const {
  HoldQuality quality = quality_;
  for (std::size_t i = 0; i < stage_.drives.size(); ++i) {
    if (!misses_push(i)) continue;
    quality.largest_error = std::max(quality.largest_error, std::abs(held_[i].servo.error));
    quality.largest_stress = std::max(quality.largest_stress, std::abs(wanted_stress(stage_.drives[i])));
  }
  return quality;
}

/// "'upper' 12 N instead of 40 N", for the drives that have never reached their push; empty if all have.
std::string ToolLoadingControl::missed_pushes(const Tools& tools) const {
  std::string text;
  for (std::size_t i = 0; i < stage_.drives.size(); ++i) {
    const ToolDrive& drive = stage_.drives[i];
    if (!misses_push(i)) continue;
    const double push = push_along(drive.direction, tools.load(drive.tool));
    const double per = drive.stress ? start_.cell.area(2) : 1.0;
    text += fmt::format("{}'{}' {:.3g} {unit} instead of {:g} {unit}", text.empty() ? "" : ", ", tools[drive.tool].name,
                        push / per, drive.stress ? *drive.stress : *drive.force,
                        fmt::arg("unit", drive.stress ? "MPa" : "N"));
  }
  return text;
}

void ToolLoadingControl::set_velocities(const StageObservation& observation, double part) {
  for (std::size_t i = 0; i < stage_.drives.size(); ++i) {
    const ToolDrive& drive = stage_.drives[i];
    for (std::size_t axis = 0; axis < 3; ++axis) velocity_[drive.tool][axis] = part * drive.velocity[axis];
    if (!drive.holds_push()) continue;
    // The law of held walls, whose stress is a force over the section.
    HeldTool& held = held_[i];
    const double wanted = wanted_stress(drive);
    const double stress = push_along(drive.direction, observation.tools->load(drive.tool)) / start_.cell.area(2);
    if (!held.reached && std::abs(stress) >= std::abs(wanted)) held = {{held.servo.fast, held.servo.slow, 0}, true};
    HoldQuality of_approach;
    const double speed =
        StressServo(start_, drive.servo_speed)
            .hold(held.servo, held.reached ? quality_ : of_approach, wanted, stress, observation.step, 1);
    for (std::size_t axis = 0; axis < 3; ++axis) velocity_[drive.tool][axis] = speed * drive.direction[axis];
  }
}

void ToolLoadingControl::observe(const StageObservation& observation) {
  const Seen seen = see(observation);
  if (!state_.begun) begin(seen);
  state_.travelled += part_.speed * stage_.speed * seen.step;
  state_.watched += (seen.push - state_.watched) * seen.step / (transit_ + seen.step);
  if (seen.time > ramp_) state_.peak = std::max(state_.peak, state_.watched);
  double left = 0;
  const double wanted = wanted_speed(seen, left);
  double part = part_.approach(wanted, 1.0, ramp_, seen.step);
  // The last step goes to the target and not past it.
  if (seen.step > 0 && stage_.speed > 0) part = std::min(part, left / (stage_.speed * seen.step));
  part_.speed = part;
  set_velocities(observation, part);
  state_.fraction_done = std::max(state_.fraction_done, find_fraction_done(seen));
  state_.ended_by = find_end(seen);
  if (stage_.container && seen.density > largest_relative_density)
    throw SimulationError(fmt::format("stage '{}': relative density {:.4f}, which is above the largest allowed, {:g}",
                                      label_.name, seen.density, largest_relative_density));
  if (state_.ended_by == ToolEnd::none &&
      seen.time > longest_time * std::max(expected_duration_, fewest_steps * seen.step))
    throw SimulationError(
        fmt::format("stage '{}': its end was not reached after {:g} times the expected time: travel {:.4g} mm, "
                    "relative density {:.4f}, axial stress {:.4g} MPa, force on the watched tool {:.4g} N",
                    label_.name, longest_time, state_.travelled, seen.density, seen.axial_stress, seen.push));
}

void ToolLoadingControl::move(Cell& cell, double /*time*/, double /*clock_step*/, double step) const {
  if (!stage_.container) return;
  const auto velocity_of = [&](std::size_t tool, std::size_t axis) {
    return tool < velocity_.size() ? velocity_[tool][axis] : 0.0;
  };
  const ContainerParameters& parts = *stage_.container;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    cell.low[axis] += velocity_of(parts.wall[2 * axis], axis) * step;
    cell.high[axis] += velocity_of(parts.wall[2 * axis + 1], axis) * step;
  }
  // If one punch is away, the cell keeps its height and moves with the other.
  const std::size_t lower = is_away(parts.lower) ? parts.upper : parts.lower;
  const std::size_t upper = is_away(parts.upper) ? parts.lower : parts.upper;
  if (is_away(lower)) return;
  cell.low[2] += velocity_of(lower, 2) * step;
  cell.high[2] += velocity_of(upper, 2) * step;
}

ToolEnd ToolLoadingControl::find_end(const Seen& seen) const {
  const ToolEnds& ends = stage_.ends;
  if (ends.travel && state_.travelled >= *ends.travel * (1 - arrived)) return ToolEnd::travel;
  if (ends.relative_density) {
    // A stage that begins a little beyond its end is there.
    const double closing = closing_speed(),
                 denser = closing != 0 ? closing : *ends.relative_density - state_.start_density;
    if ((denser < 0 ? -1 : 1) * (seen.density - *ends.relative_density) >= -arrived) return ToolEnd::relative_density;
  }
  if (ends.axial_stress && has_passed(*ends.axial_stress, state_.start_stress, seen.axial_stress))
    return ToolEnd::axial_stress;
  if (ends.force && has_passed(*ends.force, state_.start_push, seen.push)) return ToolEnd::force;
  if (ends.force_drop && state_.peak > ends.smallest_peak && state_.watched <= (1 - *ends.force_drop) * state_.peak)
    return ToolEnd::force_drop;
  const auto drives = std::views::iota(std::size_t{0}, held_.size());
  if (ends.forces_reached && std::ranges::none_of(drives, [&](std::size_t i) { return misses_push(i); }))
    return ToolEnd::forces_reached;
  if (ends.duration && seen.time >= *ends.duration) return ToolEnd::duration;
  return ToolEnd::none;
}

double ToolLoadingControl::find_fraction_done(const Seen& seen) const {
  const ToolEnds& ends = stage_.ends;
  double done = 0;
  const auto consider = [&](double start, double now, double end) {
    done = std::max(done, fraction_of_way(start, now, end));
  };
  if (ends.travel) done = std::max(done, state_.travelled / *ends.travel);
  if (ends.relative_density) consider(state_.start_density, seen.density, *ends.relative_density);
  if (ends.axial_stress) consider(state_.start_stress, seen.axial_stress, *ends.axial_stress);
  if (ends.force) consider(state_.start_push, seen.push, *ends.force);
  if (ends.duration) done = std::max(done, seen.time / *ends.duration);
  if (done == 0) done = seen.time / expected_duration_;
  return std::clamp(done, 0.0, 1.0);
}

double ToolLoadingControl::fraction_done(double /*time*/, double /*mean_stress*/) const {
  return state_.fraction_done;
}

StageResult ToolLoadingControl::result(const StageObservation& last) const {
  const ToolEnds& ends = stage_.ends;
  StageResult result = with_hold_quality({}, hold_quality());
  result.missed = missed_pushes(*last.tools);
  switch (state_.ended_by) {
  case ToolEnd::none:
    result.ended_by = "not ended";
    break;
  case ToolEnd::relative_density:
    result.ended_by = ends.height ? fmt::format("height {:g} mm", *ends.height)
                                  : fmt::format("relative density {:g}", *ends.relative_density);
    break;
  case ToolEnd::axial_stress:
    result.ended_by = fmt::format("axial stress {:g} MPa", *ends.axial_stress);
    result.overshoot = std::abs(see(last).axial_stress - *ends.axial_stress);
    break;
  case ToolEnd::travel:
    result.ended_by = fmt::format("travel {:g} mm", *ends.travel);
    break;
  case ToolEnd::force:
    result.ended_by = fmt::format("force {:g} N", *ends.force);
    break;
  case ToolEnd::force_drop:
    result.ended_by = fmt::format("force drop of {:g} from a peak of {:.4g} N", *ends.force_drop, state_.peak);
    break;
  case ToolEnd::forces_reached:
    result.ended_by = "all forces reached";
    break;
  case ToolEnd::duration:
    result.ended_by = fmt::format("duration {:g} s", *ends.duration);
    break;
  }
  return result;
}

void ToolLoadingControl::write(FieldWriter& to) const {
  State::for_each_field(state_, to);
  to("tools.part", part_.speed);
  for (const HeldTool& held : held_) HeldTool::for_each_field(held, to);
  HoldQuality::for_each_field(quality_, to);
}

void ToolLoadingControl::read(FieldReader& from) {
  State::for_each_field(state_, from);
  from("tools.part", part_.speed);
  for (HeldTool& held : held_) HeldTool::for_each_field(held, from);
  HoldQuality::for_each_field(quality_, from);
}

} // namespace mpfem
