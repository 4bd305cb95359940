#pragma once
// The stage that a run is in: its clock, its control, and the speed that it chooses.

#include <memory>
#include <optional>

#include "solver/run/loading_rate.hpp"
#include "solver/run/stages/stage_control.hpp"

namespace mpfem {

/// What the next step does.
struct StepPlan {
  double step = 0;                 ///< s
  double clock_step = 0;           ///< s, by which the stage's clock moves on
  Cell cell;                       ///< afterwards
  std::array<double, 3> sliding{}; ///< mm, of the grips
};

/// One stage of a scenario while it runs.
class StageRun {
public:
  /// What a checkpoint keeps beside the states of control and loading rate.
  struct State {
    Cell start;                   ///< when the stage began
    double start_mean_stress = 0; ///< MPa
    double time = 0;              ///< s, since the stage began, by the stage's clock
    bool ended = false;           ///< the stage has reached what ends it

    template <class Self, class Visitor>
    static void for_each_field(Self& s, Visitor&& visit) {
      visit("stage.start_low", s.start.low), visit("stage.start_high", s.start.high);
      visit("stage.start_section_share", s.start.section_share);
      visit("stage.start_mean_stress", s.start_mean_stress), visit("stage.time", s.time), visit("stage.ended", s.ended);
    }
  };

  /// Begins a stage. `plastic_dissipation` in mJ, so far. Throws InputError as make_stage_control().
  StageRun(const Stage& stage, const StageStart& start, double plastic_dissipation);
  /// A stage that goes on from a checkpoint, in which read() found `state`.
  StageRun(const Stage& stage, const Sample& sample, const State& state);

  const Stage& stage() const { return *stage_; }
  const StageControl& control() const { return *control_; }
  const State& state() const { return state_; }
  const LoadingRateState& loading_rate() const { return rate_state_; }

  /// True when the current time level is the stage's last.
  bool complete() const { return state_.ended || state_.time >= control_->duration(); }
  double expected_duration() const { return control_->expected_duration(); }
  double fraction_done(double mean_stress) const { return control_->fraction_done(state_.time, mean_stress); }
  /// True if walls are about to come to rest. Stages that reverse do so gently by themselves.
  bool is_stopping(double mean_stress) const;

  /// s, the next step: `stable_step`, or less at the end of the stage's time. `last_step` if the stage is complete.
  double next_step(double stable_step, double last_step) const;
  StepPlan plan(const Cell& cell, double stable_step, double last_step) const;

  bool needs_damage(std::int64_t step) const { return control_->needs_damage(step); }
  /// Takes in the current time level; time and rate factor are filled in here. Does nothing if the stage is complete.
  void observe(StageObservation seen);
  bool loading_rate_is_due(std::int64_t step) const;
  /// Changes the speed from the step after the next on: the next one may be planned already.
  void regulate(const LoadingRateObservation& seen);
  /// Moves the clock on by a planned step.
  void advance(const StepPlan& plan);

  StageResult result(const StageObservation& last) const;

  void write(FieldWriter& to) const;
  /// Control and loading rate; the rest was given to the constructor.
  void read(FieldReader& from);

private:
  void make_controls(const StageStart& start);

  const Stage* stage_;
  State state_;
  std::unique_ptr<StageControl> control_;
  std::optional<LoadingRateControl> rate_control_;
  LoadingRateState rate_state_;
  std::optional<LoadingRateState> regulated_; ///< takes over after the next step
};

} // namespace mpfem
