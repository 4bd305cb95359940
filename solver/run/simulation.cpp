#include "solver/run/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/kernels/largest_frequency.hpp"
#include "solver/physics/smooth_step.hpp"

namespace mpfem {

namespace {

// The estimate of the stable step is renewed when tets may have strained by this much since, or after so many steps. A
// strain e changes a tet's gradients by e and its volume by up to 1.7 e, so its frequency, which goes with the gradients
// and the root of the volume, by less than 2 e = 4 %: well within the 10 % that time_step_factor leaves.
constexpr double strain_between_estimates = 0.02;
constexpr int steps_between_estimates = 50;
/// The frequencies of all whole grains are found at every so many estimates: some twenty products with the stiffness each. In between
/// a grain's frequency squared is taken to grow as that of the tet which grows most, and by what contact has come to its
/// nodes; and where that would shorten the packing's step, it is found anew, unless it has grown by less than this.
constexpr int estimates_between_spectra = 10;
constexpr double growth_worth_a_spectrum = 1.01;

/// A packing may start with nodes inside a neighbour by rounding, not by more.
constexpr double overlap_tolerance = 1e-6; // of h

/// Share of the critical damping that quadratic bulk viscosity may reach in a volume change at `rate` (1/s).
double largest_quadratic_damping(const Model& model, double rate) {
  const double size = *std::max_element(model.element_size.begin(), model.element_size.end());
  double slowest = std::numeric_limits<double>::infinity();
  for (const Material& material : model.material) slowest = std::min(slowest, material.wave_speed);
  return model.viscosity.quadratic * model.viscosity.quadratic * rate * size / slowest;
}

double smooth_fade(double value, double full) {
  if (full <= 0) return value > 0 ? 0.0 : 1.0;
  return 1.0 - smooth_step(value / full);
}

} // namespace

Simulation::Simulation(Model model, const Scenario& scenario, ThreadTeam& team, bool branch)
    : model_(std::move(model)), scenario_(scenario), team_(team), profile_(team.size()) {
  const auto grains = static_cast<std::size_t>(model_.grains);
  for (const auto* list : {&scenario.grain_velocity, &scenario.grain_angular_velocity})
    if (!list->empty() && list->size() != grains)
      throw InputError(fmt::format("{}: key 'initial': found {} rows for {} grains, allowed one row a grain",
                                   scenario.packing_file, list->size(), grains));
  bounds_.resize(grains);
  contact_sums_.resize(grains);
  wall_sums_.resize(grains);
  grip_sums_.resize(grains);
  advance_sums_.resize(grains);
  element_sums_.resize(grains);
  stable_steps_.resize(grains);
  grain_steps_ = {std::vector<double>(grains), std::vector<double>(grains),
                  std::vector<double>(static_cast<std::size_t>(model_.nodes()))};
  stiffness_rate_.resize(static_cast<std::size_t>(model_.nodes()));
  walls_.present = scenario.walls;
  state_.absent_axes = scenario.walls ? 0 : 7;
  if (scenario.bond) {
    contact_.bond_laws = {law_of_bonds(*scenario.bond)};
    contact_.rebond_on_contact = scenario.bond->rebond_on_contact;
  }
  margin_ = scenario.contact.search_margin * *std::max_element(model_.element_size.begin(), model_.element_size.end());
  state_.low = state_.stage_low = walls_.low = model_.box_low;
  state_.high = state_.stage_high = walls_.high = model_.box_high;
  for (std::size_t axis = 0; axis < 3; ++axis) state_.initial_lengths[axis] = state_.high[axis] - state_.low[axis];

  for (std::size_t g = 0; g < grains; ++g) {
    const auto first = static_cast<std::size_t>(model_.node_offset[g]),
               end = static_cast<std::size_t>(model_.node_offset[g + 1]);
    const auto& linear = scenario.grain_velocity.empty() ? scenario.initial_velocity : scenario.grain_velocity[g];
    const std::array<double, 3> spin =
        scenario.grain_angular_velocity.empty() ? std::array<double, 3>{} : scenario.grain_angular_velocity[g];
    std::array<double, 3> centre{};
    for (std::size_t n = first; n < end; ++n)
      for (std::size_t axis = 0; axis < 3; ++axis)
        centre[axis] += model_.position[4 * n + axis] / (model_.inverse_mass[n] * model_.mass[g]);
    for (std::size_t n = first; n < end; ++n) {
      const double* x = &model_.position[4 * n];
      const double r[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]};
      double* v = &model_.velocity[4 * n];
      v[0] = linear[0] + spin[1] * r[2] - spin[2] * r[1];
      v[1] = linear[1] + spin[2] * r[0] - spin[0] * r[2];
      v[2] = linear[2] + spin[0] * r[1] - spin[1] * r[0];
      for (int axis = 0; axis < 3; ++axis) state_.initial_energy += 0.5 * v[axis] * v[axis] / model_.inverse_mass[n];
    }
  }

  team_.for_each(model_.grains,
                 [&](int grain, int) { bounds_[static_cast<std::size_t>(grain)] = update_surface(model_, grain); });
  renew_candidates(model_, margin_, team_, contact_);
  for (int grain = 0; grain < model_.grains; ++grain) {
    refuse_overlap(grain);
    const auto& b = bounds_[static_cast<std::size_t>(grain)];
    for (std::size_t axis = 0; walls_.present && axis < 3; ++axis)
      if (b.low[axis] < walls_.low[axis] - 1e-9 || b.high[axis] > walls_.high[axis] + 1e-9)
        throw InputError(fmt::format(
            "{}: grain {} spans {:.6g} … {:.6g} mm along axis {}, allowed within the box {:.6g} … {:.6g}",
            scenario.packing_file, grain, b.low[axis], b.high[axis], axis, walls_.low[axis], walls_.high[axis]));
  }
  std::fill(model_.force.begin(), model_.force.end(), 0.0);
  estimate_stable_step(true);
  if (!branch) begin_stage();
}

void Simulation::refuse_overlap(int grain) {
  const ContactCandidates& c = contact_.candidates;
  const auto g = static_cast<std::size_t>(grain);
  const auto refuse = [&](const std::string& what) {
    throw InputError(
        fmt::format("{}: {}, allowed no overlap: pack with a larger smallest_gap", scenario_.packing_file, what));
  };
  try {
    contact_forces(model_, contact_, grain);
  } catch (const SimulationError&) { // deeper than a contact can ever be
    refuse(fmt::format("grain {} overlaps another deeply at the start", grain));
  }
  for (std::int32_t pair = c.outgoing_offset[g]; pair < c.outgoing_offset[g + 1]; ++pair) {
    double deepest = 0;
    // What an unbroken bond holds of a point it holds itself: then the push is nothing and its pull tells the depth.
    for (const auto points : {contact_.active_points(pair), contact_.pulling_bonds(pair)})
      for (const ContactForce& point : points)
        if (point.stiffness > 0)
          deepest = std::max(deepest, std::hypot(point.force[0], point.force[1], point.force[2]) /
                                          (point.stiffness * model_.element_size[g]));
    if (deepest > overlap_tolerance)
      refuse(fmt::format("grains {} and {} overlap at the start by {:.3g} of the element size", grain,
                         c.pair_second[static_cast<std::size_t>(pair)], deepest));
  }
}

void Simulation::restored(Grips grips) {
  walls_.low = state_.low;
  walls_.high = state_.high;
  make_motion();
  grips_ = std::move(grips);
  team_.for_each(model_.grains,
                 [&](int grain, int) { bounds_[static_cast<std::size_t>(grain)] = update_surface(model_, grain); });
}

void Simulation::make_motion() {
  motion_.emplace(stage(), state_.stage_low, state_.stage_high, model_.total_reference_volume(),
                  state_.stage_mean_stress);
  loading_.reset();
  if (stage().loading) loading_.emplace(stage(), state_.stage_low, state_.stage_high, sample_of(model_));
  pace_.reset();
  if (stage().quasi_static)
    pace_.emplace(*stage().quasi_static, stage().speed(),
                  wave_transit(sample_of(model_), state_.stage_low, state_.stage_high));
  const int absent = absent_axes(scenario_, stage());
  walls_.present = absent != 7;
  for (std::size_t axis = 0; axis < 3; ++axis) walls_.withdrawn[axis] = (absent >> axis & 1) != 0;
}

/// Walls that are taken away take what is stored in their penalty with them; walls that return stand where they touch
/// nothing, so that the ledger knows of them from the first touch on.
void Simulation::change_walls() {
  const int absent = absent_axes(scenario_, stage());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool was_absent = (state_.absent_axes >> axis & 1) != 0, is_absent = (absent >> axis & 1) != 0;
    if (is_absent && !was_absent)
      for (const WallSums& sums : wall_sums_) state_.external_work -= sums.axis_energy[axis];
    if (was_absent && !is_absent) return_walls(axis);
  }
  state_.absent_axes = absent;
}

void Simulation::return_walls(std::size_t axis) {
  constexpr double largest_growth = 2;
  const double length = walls_.high[axis] - walls_.low[axis];
  for (const Bounds& bounds : bounds_) {
    walls_.low[axis] = std::min(walls_.low[axis], bounds.low[axis]);
    walls_.high[axis] = std::max(walls_.high[axis], bounds.high[axis]);
  }
  if (walls_.high[axis] - walls_.low[axis] > largest_growth * length)
    throw SimulationError(fmt::format("stage '{}': the walls along {} cannot return: grains lie {:.4g} mm apart, the "
                                      "walls stood {:.4g} mm apart",
                                      stage().name, "xyz"[axis], walls_.high[axis] - walls_.low[axis], length));
  state_.low[axis] = walls_.low[axis], state_.high[axis] = walls_.high[axis];
  for (std::size_t side = 2 * axis; side < 2 * axis + 2; ++side)
    state_.last_wall_force[side] = state_.last_wall_move[side] = 0;
}

void Simulation::begin_stage() {
  change_walls();
  if (const std::string reason = unreachable_stress(stage(), state_.mean_stress); !reason.empty())
    throw InputError(reason);
  state_.stage_time = 0;
  state_.stage_ended = 0;
  state_.rows_in_stage = 0;
  state_.stage_low = walls_.low;
  state_.stage_high = walls_.high;
  state_.stage_mean_stress = state_.mean_stress;
  state_.loading = {};
  state_.pace = {.dissipation_at_start = state_.plastic_dissipation};
  make_motion();
  grips_ = {};
  damping_rate_ = damping_rate();
  if (const auto& grip = stage().grip) {
    grips_ = grip_nodes(model_, walls_, static_cast<std::size_t>(grip->axis), grip->depth, grip->lateral_fixed);
    std::array<bool, 2> holds{};
    for (const GrippedNode& node : grips_.node) holds[static_cast<std::size_t>(node.side)] = true;
    if (!holds[0] || !holds[1])
      throw InputError(fmt::format("stage '{}': no node lies within grip_depth = {:g} mm of the {} face of the box",
                                   stage().name, grip->depth, holds[0] ? "high" : "low"));
  }
}

void Simulation::begin_branch() {
  walls_.low = state_.low;
  walls_.high = state_.high;
  state_.stage = 0;
  state_.snapshots_passed = 0;
  state_.checkpoints_passed = 0;
  renew_candidates(model_, margin_, team_, contact_);
  estimate_stable_step(true);
  state_.steps_since_estimate = steps_between_estimates - 1; // nothing touches yet: once more after the first step
  begin_stage();
  rebase_ledger_ = true;
}

double Simulation::relative_density() const {
  double volume = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) volume *= walls_.high[axis] - walls_.low[axis];
  return model_.total_reference_volume() / volume;
}

double Simulation::next_step() const {
  if (stage_complete()) return state_.last_step;
  // The last steps of a stage are shortened equally, so that the stage ends at its time without a tiny step.
  const double left = (motion_->duration() - state_.stage_time) / state_.pace.pace;
  if (!std::isfinite(left)) return state_.stable_step;
  const double steps = std::ceil(left / state_.stable_step * (1.0 - 1e-12));
  return steps <= 2 ? left / std::max(steps, 1.0) : state_.stable_step;
}

double Simulation::damping_rate() const {
  const DampingParameters& damping = stage().damping;
  return damping.rate > 0 ? damping.rate * smooth_fade(state_.mean_stress, damping.fade_stress) : 0.0;
}

Simulation::Plan Simulation::plan_step() const {
  Plan plan{.step = next_step(), .stage_time = 0, .walls = walls_, .sliding = {}, .advance = {}};
  plan.stage_time = state_.pace.pace * plan.step;
  // The last step ends the stage, whatever rounding makes of a step divided by the pace and multiplied by it.
  if (const double left = motion_->duration() - state_.stage_time; plan.stage_time > left * (1 - 1e-12))
    plan.stage_time = left;
  plan.sliding = motion_->sliding(state_.stage_time + plan.stage_time);
  if (loading_)
    loading_->move(plan.walls, state_.loading, plan.step);
  else
    motion_->move(plan.walls, state_.stage_time + plan.stage_time, plan.stage_time, state_.mean_stress);
  plan.advance.step = plan.step;
  plan.advance.step_mean = 0.5 * (state_.last_step + plan.step);
  plan.advance.damping_rate = damping_rate_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = walls_.high[axis] - walls_.low[axis];
    plan.advance.centre[axis] = 0.5 * (walls_.high[axis] + walls_.low[axis]);
    plan.advance.rate[axis] = ((plan.walls.high[axis] - plan.walls.low[axis]) / length - 1.0) / plan.step;
  }
  return plan;
}

void Simulation::estimate_stable_step(bool anew) {
  const auto start = Profile::Clock::now();
  const bool whole_grains = scenario_.numerics.step_estimate == StepEstimate::grain;
  anew = anew || ++state_.estimates_since_spectrum >= estimates_between_spectra;
  // |tr e| <= sqrt(3) |e|
  const double rate = std::sqrt(3.0) * state_.strain_rate;
  // In an impact quadratic viscosity grows within one estimate.
  anew = anew || (rate > 2 * state_.spectrum_rate && largest_quadratic_damping(model_, rate) > 0.01);
  if (anew) state_.estimates_since_spectrum = 0, state_.spectrum_rate = rate;
  const auto find_whole = [&](int grain) {
    const auto g = static_cast<std::size_t>(grain);
    const StableStep& of_tets = stable_steps_[g];
    const double squared = largest_frequency(model_, grain, stiffness_rate_, of_tets.step, rate).squared;
    grain_steps_.whole[g] = 2.0 / std::sqrt(squared);
    std::copy(stiffness_rate_.begin() + model_.node_offset[g], stiffness_rate_.begin() + model_.node_offset[g + 1],
              grain_steps_.contact.begin() + model_.node_offset[g]);
    grain_steps_.growth[g] = 1;
    return std::max(of_tets.step, grain_steps_.whole[g]);
  };
  std::vector<double> steps(stable_steps_.size());
  std::vector<char> fresh(steps.size(), whole_grains && !anew ? 0 : 1);
  team_.for_each(model_.grains, [&](int grain, int) {
    const auto g = static_cast<std::size_t>(grain);
    contact_stiffness_rate(model_, contact_, grain, stiffness_rate_);
    wall_stiffness_rate(model_, walls_, bounds_[g], grain, stiffness_rate_);
    raise_to_expected_rate(model_, contact_, grain, stiffness_rate_);
    const StableStep of_tets = stable_steps_[g] = mpfem::stable_step(model_, grain, stiffness_rate_, rate);
    steps[g] = of_tets.step;
    if (!whole_grains) return;
    if (anew) {
      steps[g] = find_whole(grain);
      return;
    }
    const double then = 4.0 / (grain_steps_.whole[g] * grain_steps_.whole[g]);
    grain_steps_.growth[g] *= of_tets.growth;
    double contact = 0;
    for (auto n = static_cast<std::size_t>(model_.node_offset[g]);
         n < static_cast<std::size_t>(model_.node_offset[g + 1]); ++n)
      contact = std::max(contact, stiffness_rate_[n] - grain_steps_.contact[n]);
    const double now = then * grain_steps_.growth[g] + contact;
    steps[g] = std::max(of_tets.step, 2.0 / std::sqrt(now));
    fresh[g] = now < growth_worth_a_spectrum * then ? 1 : 0;
  });
  // The grain that sets the step is to have set it by its frequency, not by a bound of what that has become.
  std::size_t shortest = 0;
  while (true) {
    shortest = static_cast<std::size_t>(std::min_element(steps.begin(), steps.end()) - steps.begin());
    if (fresh[shortest]) break;
    steps[shortest] = find_whole(static_cast<int>(shortest));
    fresh[shortest] = 1;
  }
  const double step = steps[shortest];
  const StableStep& of_tets = stable_steps_[shortest];
  state_.stable_step = scenario_.numerics.time_step_factor * step;
  state_.controlled_by_contact = of_tets.step < 0.95 * of_tets.step_no_contact ? 1 : 0;
  state_.steps_since_estimate = 0;
  state_.strain_since_estimate = 0;
  profile_.add_serial(Part::step_estimate, Profile::since(start));
}

void Simulation::evaluate_forces() {
  damping_rate_ = damping_rate(); // one for the grips' forces and the advance that they are for
  if (search_is_due(contact_)) {
    const auto start = Profile::Clock::now();
    renew_candidates(model_, margin_, team_, contact_);
    ++state_.searches;
    profile_.add_serial(Part::contact_search, Profile::since(start));
  }
  team_.for_each(model_.grains, [&](int item, int thread) {
    const int grain = model_.spatial_order[static_cast<std::size_t>(item)];
    Stopwatch watch(profile_, thread);
    contact_sums_[static_cast<std::size_t>(grain)] = contact_forces(model_, contact_, grain);
    watch.mark(Part::contact);
  });
  team_.for_each(model_.grains, [&](int item, int thread) {
    const int grain = model_.spatial_order[static_cast<std::size_t>(item)];
    const auto g = static_cast<std::size_t>(grain);
    Stopwatch watch(profile_, thread);
    contact_reactions(model_, contact_, grain);
    watch.mark(Part::contact);
    wall_sums_[g] = wall_forces(model_, walls_, bounds_[g], grain);
    watch.mark(Part::integration);
  });

  for (std::size_t g = 0; g < wall_sums_.size(); ++g)
    if (wall_sums_[g].penetration > 0.5)
      throw SimulationError(fmt::format(
          "step {}, D_r = {:.4f}: a node of grain {} is {:.2f} of the element size behind a wall, allowed up to "
          "0.5: raise contact.stiffness_factor or lower the speed",
          state_.step, relative_density(), g, wall_sums_[g].penetration));

  std::array<double, 6> force{};
  if (grips_.present()) {
    const Plan plan = plan_step();
    team_.for_each(model_.grains, [&](int grain, int) {
      grip_sums_[static_cast<std::size_t>(grain)] =
          grip_forces(model_, grips_, plan.walls, plan.sliding, plan.advance, state_.last_step, grain);
    });
    state_.external_work += state_.grip_work_ahead;
    state_.grip_work_ahead = 0;
    for (const GripSums& sums : grip_sums_) {
      force[2 * grips_.axis] += sums.force[0];
      force[2 * grips_.axis + 1] += sums.force[1];
      state_.external_work += sums.work_behind;
      state_.grip_work_ahead += sums.work_ahead;
    }
  }

  // Work of the walls since the time level before, by the trapezoidal rule, which central differences conserve.
  std::array<double, 6> wall_force{};
  for (const WallSums& sums : wall_sums_)
    for (std::size_t side = 0; side < 6; ++side) wall_force[side] += sums.force[side];
  for (std::size_t side = 0; side < 6; ++side) {
    state_.external_work += 0.5 * (wall_force[side] + state_.last_wall_force[side]) * state_.last_wall_move[side];
    force[side] += wall_force[side];
  }
  state_.last_wall_force = force;
  state_.last_wall_move = {};
  state_.mean_stress = 0;
  for (const double stress : wall_stress()) state_.mean_stress += stress / 6.0;
  if (pace_ && state_.step % PaceControl::steps_between_looks == 0 && !stage_complete()) regulate_pace();
  if (loading_ && !stage_complete()) loading_->update(state_.loading, observe_loading());
}

/// MPa, of all six walls at the last evaluation.
std::array<double, 6> Simulation::wall_stress() const {
  std::array<double, 6> stress{};
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t b = (side / 2 + 1) % 3, c = (side / 2 + 2) % 3;
    stress[side] = state_.last_wall_force[side] / ((walls_.high[b] - walls_.low[b]) * (walls_.high[c] - walls_.low[c]));
  }
  return stress;
}

void Simulation::regulate_pace() {
  const auto start = Profile::Clock::now();
  std::array<double, 3> centre{}, length{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre[axis] = 0.5 * (walls_.low[axis] + walls_.high[axis]);
    length[axis] = walls_.high[axis] - walls_.low[axis];
  }
  std::vector<double> kinetic(static_cast<std::size_t>(model_.grains)), elastic(kinetic.size());
  std::vector<ForceMoments> moments(kinetic.size());
  team_.for_each(model_.grains, [&](int grain, int) {
    const auto g = static_cast<std::size_t>(grain);
    kinetic[g] = kinetic_energy(model_, grain, state_.last_step);
    elastic[g] = elastic_energy(model_, grain);
    moments[g] = force_moments(model_, centre, grain);
  });
  PaceObservation seen;
  seen.elapsed = PaceControl::steps_between_looks * state_.last_step;
  seen.plastic_dissipation = state_.plastic_dissipation;
  const double volume = length[0] * length[1] * length[2];
  const std::array<double, 6> stress = wall_stress();
  for (std::size_t g = 0; g < kinetic.size(); ++g) {
    seen.kinetic_energy += kinetic[g];
    seen.elastic_energy += elastic[g];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      seen.imbalance[axis] += moments[g].force[axis] * length[axis] / volume;
      seen.dynamic[axis] += moments[g].moment[axis] / volume;
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) seen.wall_stress[axis] = 0.5 * (stress[2 * axis] + stress[2 * axis + 1]);
  constexpr double near_the_end = 0.85; // cycles have an end only after all of them, and turn gently by themselves
  seen.stopping = stage_fraction_done() > near_the_end && !(stage().loading && stage().loading->cycles > 0);
  regulated_ = state_.pace;
  pace_->update(*regulated_, seen);
  profile_.add_serial(Part::integration, Profile::since(start));
}

LoadingObservation Simulation::observe_loading() {
  LoadingObservation seen{.time = state_.stage_time,
                          .step = state_.last_step,
                          .pace = state_.pace.pace,
                          .low = walls_.low,
                          .high = walls_.high,
                          .force = {},
                          .plastic_dissipation = state_.plastic_dissipation,
                          .damage_dissipation = {}};
  for (std::size_t axis = 0; axis < 3; ++axis)
    seen.force[axis] = 0.5 * (state_.last_wall_force[2 * axis] + state_.last_wall_force[2 * axis + 1]);
  if (loading_->needs_damage(state_.loading, state_.step)) seen.damage_dissipation = total_bonds().dissipated;
  return seen;
}

StageResult Simulation::stage_result() {
  StageResult result{.name = stage().name, .ended_by = motion_->end_text()};
  if (loading_) {
    result.ended_by = loading_->end_text(state_.loading);
    result.overshoot = loading_->overshoot(state_.loading, observe_loading());
    result.hold_error = state_.loading.hold_error;
    result.hold_stress = state_.loading.hold_stress;
    if (state_.loading.hold_time > 0)
      result.hold_rms = std::sqrt(state_.loading.hold_square / state_.loading.hold_time);
  } else if (stage().isotropic_unloading) {
    result.overshoot = std::max(stage().isotropic_unloading->mean_stress - state_.mean_stress, 0.0);
  }
  if (pace_) result.ended_by += "; " + pace_->text(state_.pace);
  return result;
}

void Simulation::advance() {
  const Plan plan = plan_step(); // as the grips' forces were made for
  if (regulated_) state_.pace = *regulated_;
  regulated_.reset();
  const double step = plan.step;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    state_.last_wall_move[2 * axis] = walls_.present ? plan.walls.low[axis] - walls_.low[axis] : 0.0;
    state_.last_wall_move[2 * axis + 1] = walls_.present ? walls_.high[axis] - plan.walls.high[axis] : 0.0;
  }
  walls_.low = plan.walls.low;
  walls_.high = plan.walls.high;

  team_.for_each(model_.grains, [&](int grain, int thread) {
    const auto g = static_cast<std::size_t>(grain);
    Stopwatch watch(profile_, thread);
    advance_sums_[g] = mpfem::advance(model_, grain, plan.advance);
    watch.mark(Part::integration);
    bounds_[g] = update_surface(model_, grain);
    watch.mark(Part::surface);
    element_sums_[g] = element_forces(model_, grain, step);
    watch.mark(Part::elements);
  });

  double strain = 0;
  state_.damping_force = 0;
  for (std::size_t g = 0; g < element_sums_.size(); ++g) {
    if (!element_sums_[g].admissible) report_bad_grain(static_cast<int>(g));
    state_.plastic_dissipation += element_sums_[g].plastic_work;
    state_.viscous_dissipation += element_sums_[g].viscous_work;
    state_.damping_dissipation += advance_sums_[g].damping_work;
    state_.damping_force += advance_sums_[g].damping_force;
    contact_.travel[g] += advance_sums_[g].largest_speed * step;
    strain = std::max(strain, element_sums_[g].largest_strain);
  }
  state_.low = walls_.low;
  state_.high = walls_.high;
  state_.time += step;
  const bool ends = plan.stage_time >= motion_->duration() - state_.stage_time;
  state_.stage_time = ends ? motion_->duration() : state_.stage_time + plan.stage_time;
  if (loading_ ? state_.loading.ended_by != 0 : motion_->reached(walls_, state_.mean_stress)) state_.stage_ended = 1;
  state_.last_step = step;
  state_.strain_rate = strain / step;
  state_.strain_since_estimate += strain;
  ++state_.step;
  if (++state_.steps_since_estimate >= steps_between_estimates ||
      state_.strain_since_estimate > strain_between_estimates)
    estimate_stable_step();
}

namespace {

/// " at (0.1, 0.2, 0.3) mm", of the mean of some nodes; " at no finite position" where they have flown away.
std::string place_text(const Model& model, std::span<const std::int32_t> nodes) {
  std::array<double, 3> centre{};
  for (const std::int32_t node : nodes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      centre[axis] += model.position[4 * static_cast<std::size_t>(node) + axis] / static_cast<double>(nodes.size());
  if (!std::isfinite(centre[0] + centre[1] + centre[2])) return " at no finite position";
  return fmt::format(" at ({:.4g}, {:.4g}, {:.4g}) mm", centre[0], centre[1], centre[2]);
}

/// Nodes of the tet of a grain that has this number in the packing file; all of the grain's where there is no such tet.
std::vector<std::int32_t> nodes_of_file_tet(const Model& model, int grain, std::int32_t file_tet) {
  const auto g = static_cast<std::size_t>(grain);
  std::vector<std::int32_t> nodes;
  for (std::int32_t tet = model.tet_offset[g]; tet < model.tet_offset[g + 1]; ++tet)
    if (model.file_tet[static_cast<std::size_t>(tet)] == file_tet)
      for (const auto corner : model.nodes_of_tet(grain, tet - model.tet_offset[g]))
        nodes.push_back(model.node_offset[g] + static_cast<std::int32_t>(corner));
  if (nodes.empty())
    for (std::int32_t n = model.node_offset[g]; n < model.node_offset[g + 1]; ++n) nodes.push_back(n);
  return nodes;
}

} // namespace

void Simulation::report_bad_grain(int grain) const {
  const BadTet bad = find_bad_tet(model_, grain);
  const std::string when =
      fmt::format("step {}, t = {:.4g} s, D_r = {:.4f}", state_.step, state_.time, relative_density());
  const std::string place = place_text(model_, nodes_of_file_tet(model_, grain, bad.file_tet));
  const char* cause = "likely causes: too fast a motion, too large a numerics.time_step_factor, or a poor mesh there";
  if (bad.file_tet >= 0)
    throw SimulationError(fmt::format("{}: tet {} of grain {}{} is inverted (volume ratio {:.3g}); {}", when,
                                      bad.file_tet, grain, place, bad.volume_ratio, cause));
  throw SimulationError(fmt::format("{}: a stress of grain {}{} is not finite; {}", when, grain, place, cause));
}

BondSums Simulation::total_bonds() {
  const auto pairs = static_cast<int>(contact_.candidates.pair_first.size());
  std::vector<BondSums> sums(static_cast<std::size_t>(pairs));
  if (!contact_.bonding()) return {};
  team_.for_each(pairs,
                 [&](int pair, int) { sums[static_cast<std::size_t>(pair)] = bond_sums(model_, contact_, pair); });
  BondSums total;
  for (const BondSums& pair : sums) total.add(pair);
  return total;
}

HistoryRow Simulation::observe() {
  const auto grains = static_cast<std::size_t>(model_.grains);
  const double step_mean = 0.5 * (state_.last_step + (stage_complete() ? state_.last_step : next_step()));
  std::vector<double> kinetic(grains), elastic(grains), volume(grains), surface(grains), touching_area(grains);
  team_.for_each(model_.grains, [&](int grain, int) {
    const auto g = static_cast<std::size_t>(grain);
    // At the very first time level the velocity is that of the level itself.
    kinetic[g] = kinetic_energy(model_, grain, state_.last_step > 0 ? step_mean : 0.0);
    elastic[g] = elastic_energy(model_, grain);
    volume[g] = current_volume(model_, grain);
    surface[g] = surface_area(model_, grain);
    touching_area[g] = contact_area(model_, contact_, grain);
  });

  HistoryRow row{};
  double total_volume = 0, penetration = 0, box_volume = 1, wall_force = 0;
  for (std::size_t g = 0; g < grains; ++g) {
    row.kinetic_energy += kinetic[g];
    row.elastic_energy += elastic[g];
    total_volume += volume[g];
    row.surface_area += surface[g];
    row.contact_area += touching_area[g];
    row.contact_energy += contact_sums_[g].energy + wall_sums_[g].energy;
    penetration = std::max({penetration, contact_sums_[g].penetration, wall_sums_[g].penetration});
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row.box_lengths[axis] = walls_.high[axis] - walls_.low[axis];
    box_volume *= row.box_lengths[axis];
  }
  row.wall_stress = wall_stress();
  for (const double force : state_.last_wall_force) wall_force += force;
  row.time = state_.time;
  row.step = static_cast<double>(state_.step);
  row.stage = static_cast<double>(state_.stage);
  row.relative_density = model_.total_reference_volume() / box_volume;
  row.relative_density_current = total_volume / box_volume;
  row.mean_stress = state_.mean_stress;
  const auto& s = row.wall_stress;
  row.deviatoric_stress = 0.5 * (s[4] + s[5]) - 0.25 * (s[0] + s[1] + s[2] + s[3]);
  row.axial_strain = std::log(state_.initial_lengths[2] / row.box_lengths[2]);
  for (std::size_t axis = 0; axis < 3; ++axis)
    row.volumetric_strain += std::log(state_.initial_lengths[axis] / row.box_lengths[axis]);
  row.plastic_dissipation = state_.plastic_dissipation;
  row.viscous_dissipation = state_.viscous_dissipation;
  row.damping_dissipation = state_.damping_dissipation;
  row.external_work = state_.external_work;
  const BondSums bonds = total_bonds();
  row.bond_energy = bonds.stored;
  row.damage_dissipation = bonds.dissipated;
  row.bonded_area = bonds.bonded_area;
  row.bonds = static_cast<double>(bonds.bonds);
  row.mean_damage = bonds.formed_area > 0 ? bonds.damaged_area / bonds.formed_area : 0.0;
  row.energy_residual = state_.external_work + state_.initial_energy - row.kinetic_energy - row.elastic_energy -
                        row.plastic_dissipation - row.contact_energy - row.viscous_dissipation -
                        row.damping_dissipation - row.bond_energy - row.damage_dissipation;
  if (rebase_ledger_) {
    state_.initial_energy -= row.energy_residual;
    row.energy_residual = 0;
    rebase_ledger_ = false;
  }
  std::set<std::pair<std::int32_t, std::int32_t>> touching;
  const ContactCandidates& c = contact_.candidates;
  for (std::size_t p = 0; p < c.pair_first.size(); ++p)
    if (contact_.active[p] > 0) touching.insert(std::minmax(c.pair_first[p], c.pair_second[p]));
  row.coordination_number = 2.0 * static_cast<double>(touching.size()) / static_cast<double>(grains);
  row.max_penetration = penetration;
  row.damping_drag_ratio = wall_force > 0 ? state_.damping_force / wall_force : 0.0;
  row.time_step = state_.last_step;
  return row;
}

} // namespace mpfem
