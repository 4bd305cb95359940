#include "solver/run/stages/wall_loading.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/run/stages/driven_speed.hpp"

namespace mpfem {

namespace {

constexpr double largest_strain = 0.5;             // no axis may strain further
constexpr std::int64_t steps_between_damages = 20; // all bonds are visited

} // namespace

WallLoading::WallLoading(const StageLabel& label, const StageStart& start, const LoadingEnds& ends)
    : name_(label.name), start_(start), ends_(ends), start_length_(start.cell.lengths()) {}

void WallLoading::expect_end(Cell& cell) const {
  for (std::size_t axis = 0; axis < 3; ++axis) cell.stretch(axis, expected_scale_[axis]);
}

bool WallLoading::needs_damage(std::int64_t step) const {
  return ends_.dissipation_ratio && (!state_.begun || step % steps_between_damages == 0);
}

void WallLoading::observe(const StageObservation& observation) {
  const ObservedSample seen = sample(observation);
  LoadingState& s = state_;
  const bool begins = !s.begun;
  if (begins) {
    s.begun = true;
    s.start_stress = seen.stress;
    s.start_force = seen.force;
    s.start_mean_stress = seen.mean_stress;
    s.damage_dissipation = observation.damage_dissipation.value_or(0);
    s.start_dissipation = s.dissipation = seen.plastic_dissipation + s.damage_dissipation;
    begin(seen);
    if (ends_.dissipation_ratio && !(s.start_dissipation > 0))
      throw SimulationError(
          fmt::format("stage '{}': dissipation_ratio: nothing was dissipated before the stage, so there is nothing "
                      "to compare with",
                      name_));
  }
  // Damage is a small part and observed now and then, plastic dissipation every time.
  s.damage_dissipation = observation.damage_dissipation.value_or(s.damage_dissipation);
  s.dissipation = seen.plastic_dissipation + s.damage_dissipation;
  drive(seen);
  s.fraction_done = std::max(s.fraction_done, find_fraction_done(seen));
  s.ended_by = find_end(seen);
  if (begins) refuse_end_behind(seen);
  if (s.ended_by == LoadingEnd::none)
    check_limits(seen);
  else
    check_end(seen);
}

/// A stage that begins beyond what is to end it would end at once, having done nothing.
void WallLoading::refuse_end_behind(const ObservedSample& seen) const {
  const auto refuse = [&](LoadingEnd end, const char* key, const std::optional<double>& target, double now,
                          const char* unit) {
    // A target that the stage before has reached, up to what its last steps add, may end the stage at once.
    if (state_.ended_by != end || std::abs(now - *target) <= already_there * std::max(std::abs(*target), std::abs(now)))
      return;
    throw SimulationError(
        fmt::format("stage '{}': key '{}': found {:g}{}, already passed: the stage begins at {:.4g}{}", name_, key,
                    *target, unit, now, unit));
  };
  refuse(LoadingEnd::axial_strain, "axial_strain", ends_.axial_strain, seen.strain[2], "");
  refuse(LoadingEnd::relative_density, "relative_density", ends_.relative_density, seen.relative_density, "");
  refuse(LoadingEnd::axial_stress, "axial_stress", ends_.axial_stress, seen.stress[2], " MPa");
  refuse(LoadingEnd::mean_stress, "mean_stress", ends_.mean_stress, seen.mean_stress, " MPa");
  refuse(LoadingEnd::deviatoric_stress, "deviatoric_stress", ends_.deviatoric_stress, seen.deviatoric_stress, " MPa");
}

void WallLoading::move(Cell& cell, double /*time*/, double /*clock_step*/, double step) const {
  for (std::size_t axis = 0; axis < 3; ++axis) cell.move_inwards(axis, state_.speed[axis] * step);
}

LoadingEnd WallLoading::common_end(const ObservedSample& seen) const {
  if (ends_.dissipation_ratio && state_.dissipation >= *ends_.dissipation_ratio * state_.start_dissipation)
    return LoadingEnd::dissipation_ratio;
  if (ends_.duration && seen.time >= *ends_.duration) return LoadingEnd::duration;
  return LoadingEnd::none;
}

double WallLoading::find_fraction_done(const ObservedSample& seen) const {
  const LoadingState& s = state_;
  double done = 0;
  if (ends_.axial_strain) done = std::max(done, std::abs(seen.strain[2] / *ends_.axial_strain));
  const auto consider = [&](double start, double now, double end) {
    done = std::max(done, fraction_of_way(start, now, end));
  };
  if (ends_.mean_stress) consider(s.start_mean_stress, seen.mean_stress, *ends_.mean_stress);
  if (ends_.axial_stress) consider(s.start_stress[2], seen.stress[2], *ends_.axial_stress);
  if (ends_.dissipation_ratio) consider(1, s.dissipation / s.start_dissipation, *ends_.dissipation_ratio);
  if (ends_.duration) done = std::max(done, seen.time / *ends_.duration);
  if (done == 0) done = seen.time / expected_duration_;
  return std::clamp(done, 0.0, 1.0);
}

void WallLoading::fail(const ObservedSample& seen, const std::string& what) const {
  throw SimulationError(
      fmt::format("stage '{}': its end was not reached: p = {:.4g} MPa, q = {:.4g} MPa, axial strain {:.4g}, "
                  "relative density {:.4f}, {}",
                  name_, seen.mean_stress, seen.deviatoric_stress, seen.strain[2], seen.relative_density, what));
}

void WallLoading::check_limits(const ObservedSample& seen) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(seen.strain[axis]) > largest_strain)
      fail(seen, fmt::format("after a strain of the box of more than {:g} along {}", largest_strain, "xyz"[axis]));
  check_time(seen);
}

void WallLoading::check_time(const ObservedSample& seen) const {
  if (seen.time > longest_time * std::max(expected_duration_, fewest_steps * seen.step))
    fail(seen, fmt::format("after {:g} times the expected time", longest_time));
}

std::string WallLoading::end_text() const {
  switch (state_.ended_by) {
  case LoadingEnd::none:
    return "not ended";
  case LoadingEnd::axial_strain:
    return fmt::format("axial strain {:g}", *ends_.axial_strain);
  case LoadingEnd::relative_density:
    return fmt::format("relative density {:g}", *ends_.relative_density);
  case LoadingEnd::axial_stress:
    return fmt::format("axial stress {:g} MPa", *ends_.axial_stress);
  case LoadingEnd::mean_stress:
    return fmt::format("mean stress {:g} MPa", *ends_.mean_stress);
  case LoadingEnd::deviatoric_stress:
    return fmt::format("deviatoric stress {:g} MPa", *ends_.deviatoric_stress);
  case LoadingEnd::dissipation_ratio:
    return fmt::format("dissipation {:.6g} times that at the start of the stage",
                       state_.dissipation / state_.start_dissipation);
  case LoadingEnd::duration:
    return fmt::format("duration {:g} s", *ends_.duration);
  case LoadingEnd::stress_drop:
  case LoadingEnd::cycles:
    break; // the paths that end so have their own text
  }
  return {};
}

StageResult WallLoading::result(const StageObservation& last) const {
  const ObservedSample seen = sample(last);
  StageResult result{.ended_by = end_text(), .overshoot = overshoot()};
  if (state_.ended_by == LoadingEnd::mean_stress)
    result.overshoot = std::abs(seen.mean_stress - *ends_.mean_stress);
  else if (state_.ended_by == LoadingEnd::axial_stress)
    result.overshoot = std::abs(seen.stress[2] - *ends_.axial_stress);
  else if (state_.ended_by == LoadingEnd::deviatoric_stress)
    result.overshoot = std::abs(seen.deviatoric_stress - *ends_.deviatoric_stress);
  return result;
}

} // namespace mpfem
