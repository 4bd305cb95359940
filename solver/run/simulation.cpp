#include "solver/run/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/index.hpp"
#include "solver/kernels/contact_candidates.hpp"
#include "solver/model/smooth_surface.hpp"
#include "solver/parallel/agree.hpp"
#include "solver/parallel/grain_values.hpp"
#include "solver/parallel/totals.hpp"
#include "solver/physics/smooth_step.hpp"
#include "solver/run/failure_report.hpp"
#include "solver/run/initial_state.hpp"
#include "solver/run/make_tools.hpp"
#include "solver/run/observer.hpp"

namespace mpfem {

namespace {

constexpr double deepest_penetration = 0.5; // of a wall or tool, over the element size

} // namespace

const Communicator& Simulation::alone() {
  static const Communicator itself;
  return itself;
}

Simulation::Simulation(Model model, const Scenario& scenario, ThreadTeam& team, bool branch, const Communicator& ranks)
    : scenario_(&scenario), ranks_(&ranks), team_(&team), profile_(team.size()), model_(std::move(model)),
      box_({model_.box_low, model_.box_high}, scenario.walls ? Axes{} : all_axes),
      wall_friction_(scenario.wall_friction, model_.grains), tools_(make_tools(scenario, model_)),
      step_estimate_(model_, scenario.numerics, ranks), ghosts_(ranks, scenario.contact.has_friction()),
      bounds_(static_cast<std::size_t>(model_.grains)), force_sums_(bounds_.size()), motion_sums_(bounds_.size()) {
  energies_.initial = set_initial_velocities(model_, scenario, ranks);
  if (scenario.container) {
    const ContainerParameters& parts = *scenario.container;
    container_.emplace(Container::Parts{parts.wall, parts.lower, parts.upper}, tools_);
    box_.set_cell(container_->cell(tools_, box_.cell()));
  }
  state_.initial_lengths = box_.cell().lengths();
  if (scenario.bond) {
    contact_.bond_laws = {law_of_bonds(*scenario.bond, scenario.contact)};
    contact_.rebond_on_contact = scenario.bond->rebond_on_contact;
  }
  contact_.friction = friction_of_pairs(scenario.contact, model_.material.size());
  contact_.travel.assign(bounds_.size(), 0.0);
  margin_ = scenario.contact.search_margin * *std::max_element(model_.element_size.begin(), model_.element_size.end());

  order_grains();
  find_bounds();
  find_candidates();
  check_apart(model_, contact_, box_, bounds_, scenario.packing_file, ranks);
  ghosts_.start_forces(contact_);
  ghosts_.finish_forces(contact_);
  for (const std::int32_t grain : model_.own())
    std::fill(model_.force.data() + model_.first_row(grain), model_.force.data() + model_.end_row(grain), 0.0);
  renew_step_estimate(box_, true);
  if (branch) return;
  begin_stage(0);
  if (tools_.present()) check_clear_of_tools(model_, tools_, scenario.packing_file, ranks);
}

/// Own grains in the orders in which loops take them.
void Simulation::order_grains() {
  in_space_ = by_number_ = {};
  const auto put = [&](std::int32_t grain, Order& order) {
    if (model_.ownership.owns(grain)) (ghosts_.is_at_border(grain) ? order.border : order.inside).push_back(grain);
  };
  for (const std::int32_t grain : model_.spatial_order) put(grain, in_space_);
  for (const std::int32_t grain : model_.own()) put(grain, by_number_);
}

void Simulation::find_bounds() {
  team_->for_each(static_cast<int>(model_.own().size()), [&](int item, int) {
    const std::int32_t grain = model_.own()[at(item)];
    bounds_[at(grain)] = surface_bounds(model_, grain);
  });
}

// ---------------------------------------------------------------------------------------------- the step

void Simulation::evaluate_forces() {
  damping_rate_ = damping_rate(); // the same for the grips' forces and the advance that uses them
  if (search_is_due(contact_, travel_since_search_)) search();
  contact_.last_step = state_.last_step;
  add_contact_and_walls();
  check_contact_depth();
  energies_.add_friction(force_total_.contact, force_total_.wall_friction);
  if (scenario_->has_gravity()) add_work_of_gravity();
  check_penetration();
  if (tools_.present()) measure_tools();
  measure_walls(grips_.present() ? add_grips() : std::array<double, 2>{});
  if (stage_run_->loading_rate_is_due(state_.step)) regulate_loading_rate();
  stage_run_->observe(observation());
}

void Simulation::advance() {
  const StepPlan plan = plan_ ? *plan_ : stage_run_->plan(box_.cell(), step_estimate_.stable_step(), state_.last_step);
  plan_.reset();
  const Advance update = velocity_update(plan);
  box_.move_to(plan.cell);
  tools_.move(stage_run_->control().tool_velocities(), plan.step);
  move_and_strain(update);
  const StepEstimate::StrainOfStep strain = add_up_step();
  stage_run_->advance(plan);
  state_.time += plan.step;
  state_.last_step = plan.step;
  ++state_.step;
  if (step_estimate_.is_due_after(strain, plan.step)) renew_step_estimate(box_, false);
}

void Simulation::search() {
  const auto start = Profile::Clock::now();
  find_candidates();
  profile_.add_serial(Part::contact_search, Profile::since(start));
}

/// Searches for candidates among own grains and those of other ranks near them.
void Simulation::find_candidates() {
  share_of_grains(*ranks_, model_.ownership, std::span(bounds_));
  share_of_grains(*ranks_, model_.ownership, std::span(contact_.travel));
  travel_since_search_ = 0;
  const double reach = margin_ + ranks_->largest(max_contact_offset(model_));
  const NearGrains near = find_near_grains(bounds_, reach, model_.own(), *team_);
  if (!ranks_->alone()) {
    leave_own_pairs(model_, contact_);
    std::vector<std::int32_t> ghosts(contact_.candidates.pair_second); // bonded grains may be far apart
    for (const auto& others : near.other) ghosts.insert(ghosts.end(), others.begin(), others.end());
    ghosts_.choose(std::move(ghosts), model_);
  }
  renew_candidates(model_, {margin_, reach, bounds_, near}, *team_, contact_);
  ghosts_.share_pairs(model_, contact_);
  order_grains();
}

void Simulation::add_contact_and_walls() {
  std::exception_ptr failure; // of this rank; the others wait for its messages all the same
  const auto unless_failed = [&failure](auto&& work) {
    if (failure) return;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  unless_failed([&] { add_contact(in_space_.border); });
  ghosts_.start_forces(contact_);
  unless_failed([&] { add_contact(in_space_.inside); });
  ghosts_.finish_forces(contact_);
  unless_failed([&] { add_reactions_and_walls(); });
  add_up_forces(failure);
}

/// `failure` of this rank, or none. Throws on all ranks where one has failed.
void Simulation::add_up_forces(const std::exception_ptr& failure) {
  Totals<ForceSums> totals;
  for (const std::int32_t grain : model_.own()) totals.add(force_sums_[at(grain)]);
  if (totals.combine(*ranks_, failure != nullptr))
    agree(*ranks_, [&] {
      if (failure) std::rethrow_exception(failure);
    });
  force_total_ = totals[0];
}

/// Forces of the contact points of these grains' nodes.
void Simulation::add_contact(std::span<const std::int32_t> grains) {
  team_->for_each_range(static_cast<int>(grains.size()), [&](int begin, int end, int thread) {
    const auto together = grains.subspan(at(begin), at(end - begin));
    if (thread == 0) ghosts_.progress();
    std::array<ContactSums, ThreadTeam::most_together> sums;
    Stopwatch watch(profile_, thread);
    contact_forces(model_, contact_, together, std::span(sums).first(together.size()));
    for (std::size_t i = 0; i < together.size(); ++i) force_sums_[at(together[i])].contact = sums[i];
    watch.mark(Part::contact);
  });
}

/// Reactions of contact, boundaries and weight.
void Simulation::add_reactions_and_walls() {
  const std::array<double, 3> gravity = of_scaled_mass(scenario_->gravity);
  for (const auto* grains : {&in_space_.border, &in_space_.inside})
    team_->for_each_range(static_cast<int>(grains->size()), [&](int begin, int end, int thread) {
      const auto together = std::span(*grains).subspan(at(begin), at(end - begin));
      Stopwatch watch(profile_, thread);
      contact_reactions(model_, contact_, together);
      watch.mark(Part::contact);
      for (const std::int32_t grain : together) {
        ForceSums& sums = force_sums_[at(grain)];
        const Bounds& bounds = bounds_[at(grain)];
        sums.box = box_.add_forces(model_, bounds, grain);
        if (wall_friction_.present())
          sums.wall_friction = wall_friction_.add_forces(model_, box_, bounds, state_.last_step, grain);
        if (tools_.present()) tools_.add_forces(model_, bounds, state_.last_step, grain);
        if (scenario_->has_gravity()) sums.weight_potential = add_weight(model_, gravity, grain);
      }
      watch.mark(Part::integration);
    });
}

/// The message that a node is too deep in something, with what helps.
std::string Simulation::too_deep(const std::string& what) const {
  const double density = relative_density();
  return fmt::format("step {}, relative density {:.4f}: {}; {}", state_.step, density, what,
                     density > 1 ? "the grains fill the space: end the stage at a lower density or stress"
                                 : "raise contact.stiffness_factor or lower the speed");
}

void Simulation::check_contact_depth() const {
  const double allowed = largest_contact_depth(contact_);
  if (force_total_.contact.depth <= allowed) return;
  fail_at_first_grain([&](std::int32_t grain) -> std::string {
    const ContactSums& sums = force_sums_[at(grain)].contact;
    if (sums.depth <= allowed) return {};
    return too_deep(fmt::format("a node of grain {} is {:.3g} mm inside grain {}, allowed: up to {:.3g} mm", grain,
                                sums.depth, sums.deepest_in, allowed));
  });
}

void Simulation::check_penetration() const {
  if (force_total_.box.penetration() <= deepest_penetration) return;
  fail_at_first_grain([&](std::int32_t grain) -> std::string {
    const double penetration = force_sums_[at(grain)].box.penetration();
    if (penetration <= deepest_penetration) return {};
    return too_deep(fmt::format("a node of grain {} is {:.2f} of the element size behind a wall, allowed: up to {:g}",
                                grain, penetration, deepest_penetration));
  });
}

/// Adds the forces that take the gripped nodes to where the grips will be. Returns the push of both grips towards the
/// middle, N.
std::array<double, 2> Simulation::add_grips() {
  plan_ = stage_run_->plan(box_.cell(), step_estimate_.stable_step(), state_.last_step);
  const Advance update = velocity_update(*plan_);
  std::vector<GripSums> sums(force_sums_.size());
  team_->for_each(static_cast<int>(model_.own().size()), [&](int item, int) {
    const std::int32_t grain = model_.own()[at(item)];
    sums[at(grain)] = grip_forces(model_, grips_, plan_->cell, plan_->sliding, update, state_.last_step, grain);
  });
  const auto total = total_of<GripSums>(*ranks_, model_.own(), sums);
  energies_.add_grips(total);
  return total.force;
}

/// mm/s^2, reduced as masses are scaled: weights stay as they are.
std::array<double, 3> Simulation::of_scaled_mass(std::array<double, 3> gravity) const {
  for (double& component : gravity) component /= scenario_->numerics.mass_scaling;
  return gravity;
}

void Simulation::add_work_of_gravity() {
  if (state_.last_step > 0) energies_.add_gravity(force_total_.weight_potential - state_.weight_potential);
  state_.weight_potential = force_total_.weight_potential;
}

/// Loads on the tools, and their work since the previous time level.
void Simulation::measure_tools() {
  const double work = tools_.take_loads(*ranks_, model_.ownership);
  energies_.add_tools(work, tools_.total().friction_dissipation);
  for (std::size_t tool = 0; tool < tools_.size(); ++tool)
    if (const double penetration = tools_.load(tool).penetration; penetration > deepest_penetration)
      throw SimulationError(
          too_deep(fmt::format("a node is {:.2f} of the element size behind the tool '{}', allowed: up to {:g}",
                               penetration, tools_[tool].name, deepest_penetration)));
}

/// Work of the walls, and stresses of the box at this time level, to which grips contribute.
void Simulation::measure_walls(const std::array<double, 2>& grip_force) {
  std::array<double, 6> contact{}, grip{};
  for (std::size_t side = 0; side < 2; ++side) grip[2 * grips_.axis + side] = grip_force[side];
  for (std::size_t side = 0; side < 6; ++side) contact[side] = force_total_.box.wall[side].force;
  if (container_) contact = container_->face_forces(tools_);
  energies_.add_walls(box_.take_loads(contact, grip));
}

void Simulation::regulate_loading_rate() {
  const auto start = Profile::Clock::now();
  stage_run_->regulate(observe_loading_rate(*this, *team_));
  profile_.add_serial(Part::integration, Profile::since(start));
}

StageObservation Simulation::observation() const {
  StageObservation seen{.step = state_.last_step,
                        .cell = box_.cell(),
                        .force = box_.axis_force(),
                        .mean_stress = box_.mean_stress(),
                        .plastic_dissipation = energies_.plastic_dissipation,
                        .damage_dissipation = {},
                        .tools = &tools_};
  if (!stage_complete() && stage_run_->needs_damage(state_.step))
    seen.damage_dissipation = total_bonds(*this, *team_).dissipated + tools_.adhesion_dissipation();
  return seen;
}

double Simulation::damping_rate() const {
  const DampingParameters& damping = stage().damping;
  if (!(damping.rate > 0)) return 0;
  if (damping.fade_stress <= 0) return box_.mean_stress() > 0 ? 0.0 : damping.rate;
  return damping.rate * (1.0 - smooth_step(box_.mean_stress() / damping.fade_stress));
}

Advance Simulation::velocity_update(const StepPlan& plan) const {
  Advance update;
  update.step = plan.step;
  update.step_mean = 0.5 * (state_.last_step + plan.step);
  update.damping_rate = damping_rate_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    update.centre[axis] = box_.cell().centre(axis);
    update.velocity[axis] = (plan.cell.centre(axis) - box_.cell().centre(axis)) / plan.step;
    update.rate[axis] = (plan.cell.length(axis) / box_.cell().length(axis) - 1.0) / plan.step;
  }
  return update;
}

void Simulation::move_and_strain(const Advance& update) {
  move_and_strain(by_number_.border, update);
  ghosts_.start_motion(model_, contact_);
  move_and_strain(by_number_.inside, update);
  ghosts_.finish_motion(model_, contact_);
}

void Simulation::move_and_strain(std::span<const std::int32_t> grains, const Advance& update) {
  team_->for_each(static_cast<int>(grains.size()), [&](int item, int thread) {
    if (thread == 0) ghosts_.progress();
    const std::int32_t grain = grains[at(item)];
    MotionSums& sums = motion_sums_[at(grain)];
    Stopwatch watch(profile_, thread);
    sums.advance = mpfem::advance(model_, grain, update);
    contact_.travel[at(grain)] += travel_in_step(contact_, update, sums.advance.largest_relative_speed);
    sums.travel = travel_since_search(contact_, at(grain));
    watch.mark(Part::integration);
    bounds_[at(grain)] = surface_bounds(model_, grain);
    watch.mark(Part::surface);
    sums.elements = element_forces(model_, grain, update.step);
    sums.strain_since_estimate = step_estimate_.add_strain(grain, sums.elements.largest_strain);
    watch.mark(Part::elements);
  });
}

/// Adds up what the grains did in a step; returns the largest strains of all grains.
StepEstimate::StrainOfStep Simulation::add_up_step() {
  const auto total = total_of<MotionSums>(*ranks_, model_.own(), motion_sums_);
  if (!total.elements.admissible) report_bad_grain();
  energies_.add_step(total.elements, total.advance);
  state_.damping_force = total.advance.damping_force;
  travel_since_search_ = total.travel;
  return {total.elements.largest_strain, total.strain_since_estimate};
}

void Simulation::renew_step_estimate(const Box& box, bool anew) {
  const auto start = Profile::Clock::now();
  step_estimate_.renew(model_, contact_, {box, tools_}, bounds_, *team_, anew);
  profile_.add_serial(Part::step_estimate, Profile::since(start));
  if (anew) return; // check_stages() judges the step of a beginning
  if (const double step = step_estimate_.stable_step(); !(step > 0) || !std::isfinite(step))
    throw SimulationError(
        fmt::format("step {}, time {:.4g} s, relative density {:.4f}: the stable step is {:.3g} s: an "
                    "element has collapsed",
                    state_.step, state_.time, relative_density(), step));
}

void Simulation::report_bad_grain() const {
  fail_at_first_grain([&](std::int32_t grain) -> std::string {
    if (motion_sums_[at(grain)].elements.admissible) return {};
    return fmt::format("step {}, time {:.4g} s, relative density {:.4f}: {}", state_.step, state_.time,
                       relative_density(), failed_grain_text(model_, grain));
  });
  throw std::logic_error("no grain has failed");
}

/// Collective. Throws SimulationError with what `text(grain)` says of the first grain of all ranks for which it is not
/// empty.
void Simulation::fail_at_first_grain(const std::function<std::string(std::int32_t)>& text) const {
  std::int32_t failed = 0;
  const auto fail = [&] {
    for (const std::int32_t grain : model_.own())
      if (const std::string message = text(grain); !message.empty()) {
        failed = grain;
        throw SimulationError(message);
      }
  };
  agree(*ranks_, fail, [&] { return static_cast<double>(failed); });
}

// ---------------------------------------------------------------------------------------------- observation

HistoryRow Simulation::observe() const {
  return observe_row(*this, force_total_, *team_);
}

double Simulation::relative_density() const {
  return model_.total_reference_volume() / box_.cell().volume();
}

void Simulation::reset_energy_balance(HistoryRow& first_row) {
  if (!energy_balance_open_) return;
  energies_.initial -= first_row.energy_residual;
  first_row.energy_residual = 0;
  energy_balance_open_ = false;
}

} // namespace mpfem
