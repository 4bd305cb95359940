// The state of a simulation in checkpoints, and branches that begin from it.

#include "solver/parallel/totals.hpp"
#include "solver/run/simulation.hpp"

namespace mpfem {

void Simulation::write(FieldWriter& to) const {
  RunState::for_each_field(state_, to);
  Box::for_each_field(box_, to);
  tools_.write(to);
  EnergyLedger::for_each_field(energies_, to);
  StepEstimate::State::for_each_field(step_estimate_.state(), to);
  stage_run_->write(to);
}

void Simulation::read(FieldReader& from, std::optional<std::size_t> tools_of_branch) {
  RunState::for_each_field(state_, from);
  Box::for_each_field(box_, from);
  tools_.read(from, tools_of_branch.value_or(tools_.size()));
  EnergyLedger::for_each_field(energies_, from);
  StepEstimate::State step = step_estimate_.state();
  StepEstimate::State::for_each_field(step, from);
  step_estimate_.restore(step);
  stage_run_.reset();
  if (tools_of_branch) { // a branch begins its own stage: begin_branch()
    state_.stage = 0;
    return;
  }
  StageRun::State stage_state;
  StageRun::State::for_each_field(stage_state, from);
  stage_run_.emplace(scenario_->stages[static_cast<std::size_t>(state_.stage)], sample_of(model_), stage_state);
  stage_run_->read(from);
}

/// The grips of the stage without their nodes; nullptr if it has no grips.
Grips* Simulation::prepare_grips() {
  grips_ = {};
  const GripMotion* grip = stage_run_ ? stage_run_->control().grips() : nullptr;
  if (!grip) return nullptr;
  grips_.axis = grip->axis;
  grips_.lateral_fixed = grip->lateral_fixed;
  return &grips_;
}

void Simulation::set_grain_steps(GrainSteps grain_steps) {
  step_estimate_.restore(std::move(grain_steps));
  travel_since_search_ = largest_travel_since_search(contact_); // a checkpoint has that of all grains
  find_bounds();
  ghosts_.share_pairs(model_, contact_);
  order_grains();
}

/// Before the gravity of this scenario acts, the one before has done its work up to here.
void Simulation::take_over_from_gravity(const std::array<double, 3>& before) {
  const auto potential = [this](const std::array<double, 3>& acceleration) {
    const std::array<double, 3> gravity = of_scaled_mass(acceleration);
    return sum_over_grains(*ranks_, model_.own(),
                           [&](std::int32_t grain) { return weight_potential(model_, gravity, grain); });
  };
  energies_.add_gravity(potential(before) - state_.weight_potential);
  state_.weight_potential = potential(scenario_->gravity);
}

void Simulation::begin_branch(const std::array<double, 3>& gravity_before) {
  if (gravity_before != scenario_->gravity) take_over_from_gravity(gravity_before);
  Box coming = box_;
  coming.withdraw(withdrawn_in(0));
  find_candidates();
  renew_step_estimate(coming, true);
  step_estimate_.renew_after_next_step(); // nothing touches yet
  begin_stage(0);
  energy_balance_open_ = true;
}

} // namespace mpfem
