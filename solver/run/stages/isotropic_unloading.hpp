#pragma once
// All six walls move apart until the mean stress has fallen to a target.

#include "solver/run/stages/stage_control.hpp"

namespace mpfem {

/// Part of the wall speed that an unloading keeps to its end (stresses in MPa). A packing under little stress is soft,
/// and takes long to lose it.
double slowest_unloading(double target, double start);

/// MPa above its target at which an unloading by `change` (MPa) has arrived: single grains that still touch a wall keep
/// a little stress for long.
double unloading_tolerance(double target, double change);

/// The walls slow down as the mean stress approaches its target.
class IsotropicUnloadingControl final : public StageControl {
public:
  IsotropicUnloadingControl(const IsotropicUnloading& stage, const StageLabel& label, const StageStart& start);
  std::string describe() const override { return "all walls outwards, to a mean stress"; }
  double expected_duration() const override { return expected_duration_; }
  void expect_end(Cell& /*cell*/) const override {} // the packing grows by a few per cent at most
  void observe(const StageObservation& seen) override;
  void move(Cell& cell, double time, double clock_step, double step) const override;
  bool ended() const override { return ended_; }
  double fraction_done(double time, double mean_stress) const override;
  StageResult result(const StageObservation& last) const override;

private:
  double speed(double time) const;

  IsotropicUnloading stage_;
  std::string name_;
  Cell start_cell_;
  double start_stress_;      ///< MPa
  double expected_duration_; ///< s
  double mean_stress_;       ///< MPa, at the last observation
  bool ended_;
};

} // namespace mpfem
