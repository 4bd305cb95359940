#include "solver/run/loading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/physics/smooth_step.hpp"

namespace mpfem {

namespace {

/// A compact's modulus over that of its grains, as the servo takes it. Softer ones are followed a little less well
/// damped, stiffer ones a little more slowly; compacts of Table 1 lie between 0.05 (barely jammed) and 0.5.
constexpr double compact_modulus = 0.1;
/// A held wall's admittance P over that of the packing's waves. At 1 it swallows waves and lags behind a packing that
/// strains: stresses were off by 7.5 % at worst in triaxial tests at 2 m/s; at 8, with the mass below, by 0.5 %.
constexpr double servo_admittance = 8.0;
/// The free mass of a held wall over that of the packing behind it. On a packing of that modulus the damping ratio is
/// servo_admittance sqrt(servo_mass / 2) = 1.3, on one a tenth as stiff 0.4.
constexpr double servo_mass = 0.05;
/// tau over the transit time, and over the time step: the waves of single elements are not answered.
constexpr double servo_delay = 0.02, servo_delay_steps = 20;

/// Strain in which a loading is expected to end where its ends do not tell, and over which isotropic stresses change.
constexpr double expected_strain = 0.05, expected_isotropic_strain = 0.03;
/// No axis may strain further, no packing become denser, and no loading last longer (over what is expected).
constexpr double largest_strain = 0.5, largest_density = 1.2, longest_time = 50;
/// Part of the wall speed with which a target is met.
constexpr double slowest = 0.05;
/// Probes slow down where stresses are off the path by more than this part of the largest.
constexpr double path_tolerance = 0.005;
/// The slowest that they become, over the rate at which they begin.
constexpr double slowest_path = 0.2;
/// Strain and density are met when they are so near: walls arrive but for rounding.
constexpr double arrived = 1e-9;
constexpr std::int64_t steps_between_damages = 20; // all bonds are visited
/// A stage may begin beyond its end by this part of it: the stage before has arrived there.
constexpr double already_there = 0.01;
/// Part of a held stress by which a hold may miss it at its end.
constexpr double hold_tolerance = 0.1;

} // namespace

double slowest_unloading(double target, double start) {
  constexpr double stiff = 0.1, soft_part = 0.25; // of the stress at the start, of the wall speed
  return target > stiff * start ? slowest : soft_part;
}

double unloading_tolerance(double target, double way) {
  constexpr double of_way = 1e-3, of_target = 0.01;
  return target > 0 ? std::min(of_way * way, of_target * target) : of_way * way;
}

Sample sample_of(const Model& model) {
  Sample sample;
  for (const double mass : model.mass) sample.mass += mass;
  sample.solid_volume = model.total_reference_volume();
  for (int grain = 0; grain < model.grains; ++grain)
    sample.constrained_modulus += model.material_of(grain).moduli.dilatational() *
                                  model.reference_volume[static_cast<std::size_t>(grain)] / sample.solid_volume;
  for (const double stiffness : model.penalty_stiffness)
    sample.contact_stiffness = std::max(sample.contact_stiffness, stiffness);
  return sample;
}

double wave_transit(const Sample& sample, const std::array<double, 3>& low, const std::array<double, 3>& high) {
  double volume = 1, longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    volume *= high[axis] - low[axis];
    longest = std::max(longest, high[axis] - low[axis]);
  }
  return longest * std::sqrt(sample.mass / (volume * compact_modulus * sample.constrained_modulus));
}

int absent_axes(const Scenario& scenario, const Stage& stage) {
  if (!scenario.walls || stage.grip) return 7;
  return stage.loading && stage.loading->path == LoadingPath::unconfined ? 3 : 0;
}

/// Stresses in MPa, strains since the stage began.
struct LoadingControl::Seen {
  double time, step;
  double pace;
  double wall_speed; ///< mm/s, the largest at this pace
  std::array<double, 3> length, area, force, stress, strain;
  double mean_stress, deviatoric_stress, relative_density, plastic_dissipation;
};

LoadingControl::Seen LoadingControl::see(const LoadingObservation& o) const {
  Seen s{};
  s.time = o.time, s.step = o.step, s.pace = o.pace, s.wall_speed = o.pace * loading_.wall_speed;
  s.plastic_dissipation = o.plastic_dissipation;
  double volume = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    s.length[axis] = o.high[axis] - o.low[axis];
    volume *= s.length[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    s.area[axis] = volume / s.length[axis];
    s.force[axis] = o.force[axis];
    s.stress[axis] = o.force[axis] / s.area[axis];
    s.strain[axis] = std::log(length_[axis] / s.length[axis]);
    s.mean_stress += s.stress[axis] / 3;
  }
  s.deviatoric_stress = s.stress[2] - 0.5 * (s.stress[0] + s.stress[1]);
  s.relative_density = solid_volume_ / volume;
  return s;
}

LoadingControl::LoadingControl(const Stage& stage, const std::array<double, 3>& low, const std::array<double, 3>& high,
                               const Sample& sample)
    : name_(stage.name), loading_(*stage.loading), solid_volume_(sample.solid_volume) {
  double volume = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    length_[axis] = high[axis] - low[axis];
    longest_ = std::max(longest_, length_[axis]);
    volume *= length_[axis];
  }
  const double density = sample.mass / volume, modulus = compact_modulus * sample.constrained_modulus;
  transit_ = wave_transit(sample, low, high);
  gain_ = servo_admittance / std::sqrt(density * modulus);
  contact_stiffness_ = sample.contact_stiffness;
  slow_gain_ = 1.0 / (servo_mass * density * longest_);

  const LoadingEnds& ends = loading_.ends;
  const double speed = loading_.wall_speed;
  double way = 0; // mm, of each wall
  switch (loading_.path) {
  case LoadingPath::isotropic: {
    // Where the stress will be reached is not known; powders have been pressed to 0.9 then.
    const double scale = std::min(1 - expected_isotropic_strain, std::cbrt(solid_volume_ / volume / 0.9));
    expected_scale_.fill(scale);
    way = 0.5 * longest_ * (1 - scale);
    expected_duration_ = way / speed;
    break;
  }
  case LoadingPath::cycles:
    way = 0.5 * longest_ * expected_isotropic_strain;
    expected_duration_ = 2 * static_cast<double>(loading_.cycles) * way / speed;
    break;
  case LoadingPath::probe: {
    const auto [dp, dq] = loading_.direction;
    path_stress_ = {dp - dq / 3, dp - dq / 3, dp + 2 * dq / 3};
    const double leading = std::max(std::abs(path_stress_[0]), std::abs(path_stress_[2]));
    for (double& stress : path_stress_) stress /= leading;
    way = 0.5 * longest_ * expected_isotropic_strain;
    expected_duration_ = way / speed;
    path_rate_ = 0.1 * speed * 2 * modulus / longest_;
    break;
  }
  case LoadingPath::held:
    expected_duration_ = *ends.duration;
    break;
  case LoadingPath::unconfined:
  case LoadingPath::triaxial:
  case LoadingPath::die: {
    double scale = 1 - expected_strain;
    if (ends.axial_strain)
      scale = std::exp(-*ends.axial_strain);
    else if (ends.relative_density)
      scale = solid_volume_ / volume / *ends.relative_density;
    way = 0.5 * length_[2] * std::abs(1 - scale);
    if (ends.axial_strain || ends.relative_density) expected_scale_[2] = scale;
    // A fraction of the way is travelled at half of the speed, at both ends.
    expected_duration_ = way / speed * (1 + 1.5 * loading_.ramp_fraction);
    break;
  }
  }
  ramp_ = loading_.path == LoadingPath::held ? 0.5 * expected_duration_ : loading_.ramp_fraction * way / speed;
  if (ends.duration) expected_duration_ = std::min(expected_duration_, *ends.duration);
}

bool LoadingControl::needs_damage(const LoadingState& state, std::int64_t step) const {
  return loading_.ends.dissipation_ratio && (state.begun == 0 || step % steps_between_damages == 0);
}

void LoadingControl::begin(LoadingState& s, const Seen& seen, double damage) const {
  s = {};
  s.begun = 1;
  s.start_stress = seen.stress;
  s.start_force = seen.force;
  s.damage_dissipation = damage;
  s.start_dissipation = s.dissipation = seen.plastic_dissipation + damage;
  s.leg_start = seen.mean_stress;
  s.path_rate = path_rate_;
  const LoadingEnds& ends = loading_.ends;
  const double way = ends.axial_strain        ? *ends.axial_strain
                     : ends.relative_density  ? *ends.relative_density - seen.relative_density
                     : ends.axial_stress      ? *ends.axial_stress - seen.stress[2]
                     : ends.deviatoric_stress ? *ends.deviatoric_stress - seen.deviatoric_stress
                                              : 1.0;
  s.sign = way < 0 ? -1.0 : 1.0;
  if (loading_.path == LoadingPath::isotropic && seen.mean_stress >= *ends.mean_stress)
    throw SimulationError(
        fmt::format("stage '{}': mean_stress: {:g} MPa is to be reached by compaction, but {:.4g} MPa "
                    "act when the stage begins",
                    name_, *ends.mean_stress, seen.mean_stress));
  if (ends.dissipation_ratio && !(s.start_dissipation > 0))
    throw SimulationError(
        fmt::format("stage '{}': dissipation_ratio: nothing was dissipated before the stage, so that there is nothing "
                    "to compare with",
                    name_));
}

void LoadingControl::update(LoadingState& s, const LoadingObservation& observation) const {
  const Seen seen = see(observation);
  const bool begins = s.begun == 0;
  if (begins) begin(s, seen, observation.damage_dissipation.value_or(0));
  // Damage is a small part and looked at now and then, plastic dissipation every time.
  s.damage_dissipation = observation.damage_dissipation.value_or(s.damage_dissipation);
  s.dissipation = seen.plastic_dissipation + s.damage_dissipation;
  switch (loading_.path) {
  case LoadingPath::isotropic:
  case LoadingPath::cycles:
    drive_isotropic(s, seen);
    break;
  case LoadingPath::triaxial:
    hold_lateral(s, seen);
    [[fallthrough]];
  case LoadingPath::unconfined:
  case LoadingPath::die:
    drive_axial(s, seen);
    break;
  case LoadingPath::probe:
    follow_path(s, seen);
    break;
  case LoadingPath::held:
    hold_all(s, seen);
    break;
  }
  watch_peak(s, seen);
  s.fraction_done = std::max(s.fraction_done, fraction_done(s, seen));
  const LoadingEnd end = ended(s, seen);
  if (begins) refuse_end_behind(end, seen);
  s.ended_by = static_cast<double>(end);
  if (end == LoadingEnd::none) check_limits(s, seen);
  if (end == LoadingEnd::duration && loading_.path == LoadingPath::held) refuse_missed_hold(s, seen);
}

/// A stage that begins beyond what is to end it would end at once, having done nothing.
void LoadingControl::refuse_end_behind(LoadingEnd end, const Seen& seen) const {
  const LoadingEnds& ends = loading_.ends;
  const auto refuse = [&](const char* key, double target, double now, const char* unit) {
    // What has been reached by the stage before, but for what its last steps add, may end the stage at once.
    if (std::abs(now - target) <= already_there * std::max(std::abs(target), std::abs(now))) return;
    throw SimulationError(fmt::format("stage '{}': key '{}': found {:g}{}, but it begins at {:.4g}{}, beyond that end",
                                      name_, key, target, unit, now, unit));
  };
  if (end == LoadingEnd::axial_strain) refuse("axial_strain", *ends.axial_strain, seen.strain[2], "");
  if (end == LoadingEnd::relative_density)
    refuse("relative_density", *ends.relative_density, seen.relative_density, "");
  if (end == LoadingEnd::axial_stress) refuse("axial_stress", *ends.axial_stress, seen.stress[2], " MPa");
  if (end == LoadingEnd::mean_stress) refuse("mean_stress", *ends.mean_stress, seen.mean_stress, " MPa");
  if (end == LoadingEnd::deviatoric_stress)
    refuse("deviatoric_stress", *ends.deviatoric_stress, seen.deviatoric_stress, " MPa");
}

/// A hold is to arrive at its stress.
void LoadingControl::refuse_missed_hold(const LoadingState& s, const Seen& seen) const {
  // The mean over the last transit began at nothing.
  const double weight = 1 - std::exp(-seen.time / transit_);
  double missed = 0;
  for (const double error : s.error)
    if (std::abs(error) > std::abs(missed)) missed = error;
  missed /= weight;
  if (std::abs(missed) <= hold_tolerance * loading_.held_stress) return;
  throw SimulationError(
      fmt::format("stage '{}': a stress is {:.3g} MPa {} the {:g} MPa to be held at its end ({:.0f} %), allowed {:g} "
                  "%: give it a longer duration or a larger servo_speed",
                  name_, std::abs(missed), missed > 0 ? "below" : "above", loading_.held_stress,
                  100 * std::abs(missed) / loading_.held_stress, 100 * hold_tolerance));
}

/// Part of the wall speed at a part `left` of a leg of stress: the last fifth is left ever more slowly.
double LoadingControl::approach(double left) const {
  return std::clamp(5 * left, slowest, 1.0);
}

/// Speed of the driven walls a step later: nearer to the wanted one, as far as the ramp's acceleration allows.
double LoadingControl::drive_towards(LoadingState& s, const Seen& seen, double wanted) const {
  const double change = ramp_ > 0 ? seen.wall_speed * seen.step / ramp_ : 2 * seen.wall_speed;
  s.drive += std::clamp(wanted - s.drive, -change, change);
  return s.drive;
}

void LoadingControl::drive_isotropic(LoadingState& s, const Seen& seen) const {
  const double p = seen.mean_stress;
  double target = loading_.ends.mean_stress.value_or(0);
  if (loading_.path == LoadingPath::cycles) {
    const double range = loading_.highest_mean_stress - loading_.lowest_mean_stress;
    const auto up = [&] { return std::fmod(s.legs, 2.0) == 0; };
    const double lowest = loading_.lowest_mean_stress + unloading_tolerance(loading_.lowest_mean_stress, range);
    if (up() ? p >= loading_.highest_mean_stress : p <= lowest) {
      s.legs += 1;
      s.leg_start = p;
    }
    // Where the stage before ended beyond the range is no overshoot of this one.
    constexpr double well_within = 0.5;
    if (p < loading_.highest_mean_stress - well_within * range && p > loading_.lowest_mean_stress) s.inside = 1;
    if (s.inside != 0)
      s.overshoot = std::max(
          {s.overshoot, p - loading_.highest_mean_stress, s.legs >= 2 ? loading_.lowest_mean_stress - p : 0.0});
    target = up() ? loading_.highest_mean_stress : loading_.lowest_mean_stress;
  }
  const double leg = target - s.leg_start;
  double part = leg != 0 ? approach((target - p) / leg) : 0.0;
  if (leg < 0) part = std::max(part, slowest_unloading(target, s.leg_start));
  const double wanted = std::copysign(seen.wall_speed, leg) * part;
  const double speed = drive_towards(s, seen, wanted);
  for (std::size_t axis = 0; axis < 3; ++axis) s.speed[axis] = speed * seen.length[axis] / longest_;
}

void LoadingControl::drive_axial(LoadingState& s, const Seen& seen) const {
  const LoadingEnds& ends = loading_.ends;
  double part = 1;
  // A way that is known ends at rest, by constant deceleration.
  double left = std::numeric_limits<double>::infinity(); // mm, of each wall's way
  const auto stop_at = [&](double length) {
    const double stopping = 0.5 * seen.wall_speed * ramp_;
    left = std::min(left, std::max(0.5 * s.sign * (seen.length[2] - length), 0.0));
    if (stopping > 0) part = std::min(part, std::clamp(std::sqrt(left / stopping), slowest, 1.0));
  };
  if (ends.axial_strain) stop_at(length_[2] * std::exp(-*ends.axial_strain));
  if (ends.relative_density) stop_at(solid_volume_ / (seen.area[2] * *ends.relative_density));
  const auto slow_near = [&](const std::optional<double>& target, double start, double stress) {
    if (target && *target != start) part = std::min(part, approach((*target - stress) / (*target - start)));
  };
  slow_near(ends.axial_stress, s.start_stress[2], seen.stress[2]);
  const double q = s.start_stress[2] - 0.5 * (s.start_stress[0] + s.start_stress[1]);
  slow_near(ends.deviatoric_stress, q, seen.deviatoric_stress);
  // The last step goes to the target and not past it.
  const double most = seen.step > 0 ? left / seen.step : left;
  s.speed[2] = std::clamp(drive_towards(s, seen, s.sign * seen.wall_speed * part), -most, most);
}

void LoadingControl::hold(LoadingState& s, const Seen& seen, std::size_t axis, double wanted) const {
  const double error = wanted - seen.stress[axis], limit = loading_.servo_speed * std::max(1.0, seen.pace);
  // Both masses of the wall, tau/P and 1/I, must be such that steps resolve them on the spring of a wall in full contact, whose
  // nodes at edges count twice: explicit steps are stable up to spring dt^2/mass = 4, and at these bounds the sum is 3.
  const double spring = contact_stiffness_ * seen.step * seen.step;
  const double delay = std::max({servo_delay * transit_, servo_delay_steps * seen.step, gain_ * spring});
  const double slow_gain = spring > 0 ? std::min(slow_gain_, 0.5 / spring) : slow_gain_;
  s.fast[axis] += (gain_ * error - s.fast[axis]) * seen.step / (delay + seen.step);
  // At its limit the wall cannot do more; what it has not done is not to be made up for later.
  const double before = s.fast[axis] + s.slow[axis];
  if (std::abs(before) < limit || before * error < 0)
    s.slow[axis] = std::clamp(s.slow[axis] + slow_gain * error * seen.step, -limit, limit);
  s.speed[axis] = std::clamp(s.fast[axis] + s.slow[axis], -limit, limit);
  s.error[axis] += (error - s.error[axis]) * seen.step / (transit_ + seen.step);
  s.hold_error = std::max(s.hold_error, std::abs(s.error[axis]));
  s.hold_square += error * error * seen.step;
  s.hold_time += seen.step;
  s.hold_stress = std::max(s.hold_stress, std::abs(wanted));
}

/// A stress or force between that at the start and a given one, which is brought on as driven walls are brought to speed.
double LoadingControl::brought_on(const Seen& seen, double start, double given) const {
  return start + (given - start) * (ramp_ > 0 ? smooth_step(seen.time / ramp_) : 1.0);
}

void LoadingControl::hold_all(LoadingState& s, const Seen& seen) const {
  for (std::size_t axis = 0; axis < 3; ++axis)
    hold(s, seen, axis, brought_on(seen, s.start_stress[axis], loading_.held_stress));
}

void LoadingControl::hold_lateral(LoadingState& s, const Seen& seen) const {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double start_area = length_[1 - axis] * length_[2];
    const double given = loading_.lateral_stress.value_or(s.start_stress[axis]);
    hold(s, seen, axis,
         loading_.hold_force ? brought_on(seen, s.start_force[axis], given * start_area) / seen.area[axis]
                             : brought_on(seen, s.start_stress[axis], given));
  }
}

void LoadingControl::follow_path(LoadingState& s, const Seen& seen) const {
  s.path += s.path_rate * seen.step;
  double fastest = 0, off = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hold(s, seen, axis, s.start_stress[axis] + s.path * path_stress_[axis]);
    fastest = std::max(fastest, std::abs(s.slow[axis]));
    off = std::max(off, std::abs(s.error[axis]));
  }
  // As fast as the walls may go, and as the stresses follow.
  const double load = std::max(fastest / seen.wall_speed, off / (path_tolerance * s.hold_stress));
  if (ramp_ > 0) s.path_rate *= std::exp(std::clamp(1 - load, -5.0, 1.0) * seen.step / ramp_);
  // Vibration must not bring it to a halt.
  s.path_rate = std::max(s.path_rate, slowest_path * path_rate_);
}

void LoadingControl::watch_peak(LoadingState& s, const Seen& seen) const {
  if (!loading_.ends.stress_drop) return;
  const double stress = loading_.path == LoadingPath::unconfined ? seen.stress[2] : std::abs(seen.deviatoric_stress);
  s.watched += (stress - s.watched) * seen.step / (transit_ + seen.step);
  // While the walls start, the sample settles: no peak yet.
  if (seen.time > ramp_) s.peak = std::max(s.peak, s.watched);
}

LoadingEnd LoadingControl::ended(const LoadingState& s, const Seen& seen) const {
  const LoadingEnds& ends = loading_.ends;
  if (loading_.path == LoadingPath::cycles)
    return s.legs >= 2 * static_cast<double>(loading_.cycles) ? LoadingEnd::cycles : LoadingEnd::none;
  if (loading_.path == LoadingPath::isotropic)
    return (*ends.mean_stress - s.leg_start) * (seen.mean_stress - *ends.mean_stress) >= 0 ? LoadingEnd::mean_stress
                                                                                           : LoadingEnd::none;
  const auto [dp, dq] = loading_.direction;
  const bool probe = loading_.path == LoadingPath::probe;
  const double side = probe ? (dq < 0 ? -1.0 : 1.0) : s.sign;
  if (ends.axial_strain && (probe ? std::abs(seen.strain[2]) >= std::abs(*ends.axial_strain)
                                  : s.sign * (seen.strain[2] - *ends.axial_strain) >= -arrived))
    return LoadingEnd::axial_strain;
  if (ends.relative_density && s.sign * (seen.relative_density - *ends.relative_density) >= -arrived)
    return LoadingEnd::relative_density;
  if (ends.axial_stress && s.sign * (seen.stress[2] - *ends.axial_stress) >= 0) return LoadingEnd::axial_stress;
  if (ends.mean_stress && dp * (seen.mean_stress - *ends.mean_stress) >= 0 && dp != 0) return LoadingEnd::mean_stress;
  if (ends.deviatoric_stress && side * (seen.deviatoric_stress - *ends.deviatoric_stress) >= 0 && (!probe || dq != 0))
    return LoadingEnd::deviatoric_stress;
  if (ends.stress_drop && s.peak > 0 && s.watched <= (1 - *ends.stress_drop) * s.peak) return LoadingEnd::stress_drop;
  if (ends.dissipation_ratio && s.dissipation >= *ends.dissipation_ratio * s.start_dissipation)
    return LoadingEnd::dissipation_ratio;
  if (ends.duration && seen.time >= *ends.duration) return LoadingEnd::duration;
  return LoadingEnd::none;
}

void LoadingControl::check_limits(const LoadingState& s, const Seen& seen) const {
  const auto fail = [&](const std::string& what) {
    throw SimulationError(
        fmt::format("stage '{}': its end was not reached: p = {:.4g} MPa, q = {:.4g} MPa, axial strain {:.4g}, "
                    "D_r = {:.4f} {}",
                    name_, seen.mean_stress, seen.deviatoric_stress, seen.strain[2], seen.relative_density, what));
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(seen.strain[axis]) > largest_strain && loading_.path != LoadingPath::isotropic)
      fail(fmt::format("after the box strained by {:g} along {}", largest_strain, "xyz"[axis]));
  if (loading_.path == LoadingPath::isotropic && seen.relative_density > largest_density)
    fail(fmt::format("is denser than {:g}", largest_density));
  if (seen.time > longest_time * expected_duration_)
    fail(fmt::format("after {:g} times the time expected", longest_time));
  if (loading_.path == LoadingPath::probe)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (path_stress_[axis] < 0 && s.start_stress[axis] + s.path * path_stress_[axis] < 0)
        fail(fmt::format("where the path asks the walls along {} to pull", "xyz"[axis]));
}

double LoadingControl::fraction_done(const LoadingState& s, const Seen& seen) const {
  const auto part = [](double start, double now, double end) {
    return end != start ? std::clamp((now - start) / (end - start), 0.0, 1.0) : 1.0;
  };
  const LoadingEnds& ends = loading_.ends;
  if (loading_.path == LoadingPath::cycles) {
    const bool up = std::fmod(s.legs, 2.0) == 0;
    const double leg =
        part(s.leg_start, seen.mean_stress, up ? loading_.highest_mean_stress : loading_.lowest_mean_stress);
    return (s.legs + leg) / (2 * static_cast<double>(loading_.cycles));
  }
  double done = 0;
  if (ends.axial_strain) done = std::max(done, std::abs(seen.strain[2] / *ends.axial_strain));
  if (ends.mean_stress) done = std::max(done, part(s.leg_start, seen.mean_stress, *ends.mean_stress));
  if (ends.axial_stress) done = std::max(done, part(s.start_stress[2], seen.stress[2], *ends.axial_stress));
  if (ends.dissipation_ratio)
    done = std::max(done, part(1, s.dissipation / s.start_dissipation, *ends.dissipation_ratio));
  if (ends.duration) done = std::max(done, seen.time / *ends.duration);
  if (done == 0) done = seen.time / expected_duration_;
  return std::clamp(done, 0.0, 1.0);
}

void LoadingControl::move(Walls& walls, const LoadingState& s, double step) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    walls.low[axis] += s.speed[axis] * step;
    walls.high[axis] -= s.speed[axis] * step;
  }
}

std::string LoadingControl::end_text(const LoadingState& s) const {
  const LoadingEnds& ends = loading_.ends;
  switch (static_cast<LoadingEnd>(static_cast<int>(s.ended_by))) {
  case LoadingEnd::none:
    return "not ended";
  case LoadingEnd::axial_strain:
    return fmt::format("axial strain {:g}", *ends.axial_strain);
  case LoadingEnd::relative_density:
    return fmt::format("relative density {:g}", *ends.relative_density);
  case LoadingEnd::axial_stress:
    return fmt::format("axial stress {:g} MPa", *ends.axial_stress);
  case LoadingEnd::mean_stress:
    return fmt::format("mean stress {:g} MPa", *ends.mean_stress);
  case LoadingEnd::deviatoric_stress:
    return fmt::format("deviatoric stress {:g} MPa", *ends.deviatoric_stress);
  case LoadingEnd::stress_drop:
    return fmt::format("stress drop of {:g} from a peak of {:.4g} MPa", *ends.stress_drop, s.peak);
  case LoadingEnd::dissipation_ratio:
    return fmt::format("dissipation {:.6g} times that at the start of the stage", s.dissipation / s.start_dissipation);
  case LoadingEnd::duration:
    return fmt::format("duration {:g} s", *ends.duration);
  case LoadingEnd::cycles:
    return fmt::format("{} cycle{}", loading_.cycles, loading_.cycles == 1 ? "" : "s");
  }
  return {};
}

double LoadingControl::overshoot(const LoadingState& s, const LoadingObservation& last) const {
  const Seen seen = see(last);
  const LoadingEnds& ends = loading_.ends;
  switch (static_cast<LoadingEnd>(static_cast<int>(s.ended_by))) {
  case LoadingEnd::mean_stress:
    return std::abs(seen.mean_stress - *ends.mean_stress);
  case LoadingEnd::axial_stress:
    return std::abs(seen.stress[2] - *ends.axial_stress);
  case LoadingEnd::deviatoric_stress:
    return std::abs(seen.deviatoric_stress - *ends.deviatoric_stress);
  default:
    return s.overshoot;
  }
}

} // namespace mpfem
