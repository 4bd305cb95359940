#include "solver/run/stage_run.hpp"

#include <cmath>

namespace mpfem {

StageRun::StageRun(const Stage& stage, const StageStart& start, double plastic_dissipation)
    : stage_(&stage), state_{.start = start.cell, .start_mean_stress = start.mean_stress} {
  rate_state_.dissipation_at_start = plastic_dissipation;
  make_controls(start);
}

StageRun::StageRun(const Stage& stage, const Sample& sample, const State& state) : stage_(&stage), state_(state) {
  make_controls({state.start, state.start_mean_stress, sample});
}

void StageRun::make_controls(const StageStart& start) {
  control_ = make_stage_control(*stage_, start);
  if (stage_->quasi_static)
    rate_control_.emplace(*stage_->quasi_static, driven_speed(stage_->type), wave_transit(start.sample, start.cell));
}

bool StageRun::is_stopping(double mean_stress) const {
  constexpr double near_the_end = 0.85;
  return fraction_done(mean_stress) > near_the_end && !std::holds_alternative<StressCycles>(stage_->type);
}

double StageRun::next_step(double stable_step, double last_step) const {
  if (complete()) return last_step;
  // The last steps of a stage are shortened equally, so that the stage ends at its time without a tiny step.
  const double left = (control_->duration() - state_.time) / rate_state_.factor;
  if (!std::isfinite(left)) return stable_step;
  const double steps = std::ceil(left / stable_step * (1.0 - 1e-12));
  return steps <= 2 ? left / std::max(steps, 1.0) : stable_step;
}

StepPlan StageRun::plan(const Cell& cell, double stable_step, double last_step) const {
  StepPlan plan{.step = next_step(stable_step, last_step), .cell = cell};
  plan.clock_step = rate_state_.factor * plan.step;
  // The last step ends the stage, whatever rounding makes of a step divided by the factor and multiplied by it.
  if (const double left = control_->duration() - state_.time; plan.clock_step > left * (1 - 1e-12))
    plan.clock_step = left;
  const double time = state_.time + plan.clock_step;
  plan.sliding = control_->sliding(time);
  control_->move(plan.cell, time, plan.clock_step, plan.step);
  return plan;
}

void StageRun::observe(StageObservation seen) {
  if (complete()) return;
  seen.time = state_.time;
  seen.rate_factor = rate_state_.factor;
  control_->observe(seen);
}

bool StageRun::loading_rate_is_due(std::int64_t step) const {
  return rate_control_ && step % LoadingRateControl::steps_between_observations == 0 && !complete();
}

void StageRun::regulate(const LoadingRateObservation& seen) {
  regulated_ = rate_state_;
  rate_control_->update(*regulated_, seen);
}

void StageRun::advance(const StepPlan& plan) {
  if (regulated_) rate_state_ = *regulated_;
  regulated_.reset();
  const bool ends = plan.clock_step >= control_->duration() - state_.time;
  state_.time = ends ? control_->duration() : state_.time + plan.clock_step;
  if (control_->ended()) state_.ended = true;
}

StageResult StageRun::result(const StageObservation& last) const {
  StageResult result = control_->result(last);
  result.name = stage_->name;
  if (rate_control_) result.ended_by += "; " + rate_control_->text(rate_state_);
  return result;
}

void StageRun::write(FieldWriter& to) const {
  State::for_each_field(state_, to);
  control_->write(to);
  LoadingRateState::for_each_field(rate_state_, to);
}

void StageRun::read(FieldReader& from) {
  control_->read(from);
  LoadingRateState::for_each_field(rate_state_, from);
}

} // namespace mpfem
