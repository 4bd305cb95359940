#pragma once
// Stages that end at a time which is known when they begin: compaction to a density, grips, rest.

#include "solver/run/stages/stage_control.hpp"
#include "solver/run/stages/timed_motion.hpp"

namespace mpfem {

/// What stages of known duration share.
class TimedStage : public StageControl {
public:
  double duration() const override { return motion_.duration; }
  double expected_duration() const override { return motion_.duration; }
  void expect_end(Cell& cell) const override { cell = motion_.at(motion_.duration); }
  void observe(const StageObservation& /*seen*/) override {}
  void move(Cell& cell, double time, double /*clock_step*/, double /*step*/) const override { cell = motion_.at(time); }
  double fraction_done(double time, double mean_stress) const override;

protected:
  explicit TimedStage(const StageStart& start) { motion_.start = start.cell; }
  TimedCell motion_;
};

} // namespace mpfem
