#pragma once
// Base of the stages whose walls are driven or held until something happens.

#include <array>
#include <string>

#include "solver/run/stages/observed_sample.hpp"
#include "solver/run/stages/stage_control.hpp"

namespace mpfem {

/// Why a loading ended.
enum class LoadingEnd {
  none,
  axial_strain,
  relative_density,
  axial_stress,
  mean_stress,
  deviatoric_stress,
  stress_drop,
  dissipation_ratio,
  duration,
  cycles,
};

/// State of a loading, whatever its path.
struct LoadingState {
  bool begun = false; ///< the values at the start are known
  LoadingEnd ended_by = LoadingEnd::none;
  double fraction_done = 0;             ///< [0, 1]
  std::array<double, 3> speed{};        ///< mm/s inwards, of both walls across each axis
  std::array<double, 3> start_stress{}; ///< MPa, of each axis
  std::array<double, 3> start_force{};  ///< N
  double start_mean_stress = 0;         ///< MPa
  double start_dissipation = 0;         ///< mJ
  double dissipation = 0;               ///< mJ, plastic and damage; the damage as last observed
  double damage_dissipation = 0;        ///< mJ, when it was last observed

  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("loading.begun", s.begun), visit("loading.ended_by", s.ended_by);
    visit("loading.fraction_done", s.fraction_done), visit("loading.speed", s.speed);
    visit("loading.start_stress", s.start_stress), visit("loading.start_force", s.start_force);
    visit("loading.start_mean_stress", s.start_mean_stress);
    visit("loading.start_dissipation", s.start_dissipation), visit("loading.dissipation", s.dissipation);
    visit("loading.damage_dissipation", s.damage_dissipation);
  }
};

/// Derived classes set the walls' speeds in drive() and say in find_end() what has ended the stage.
class WallLoading : public StageControl {
public:
  double expected_duration() const override { return expected_duration_; }
  void expect_end(Cell& cell) const override;
  bool needs_damage(std::int64_t step) const override;
  void observe(const StageObservation& seen) override;
  void move(Cell& cell, double time, double clock_step, double step) const override;
  bool ended() const override { return state_.ended_by != LoadingEnd::none; }
  double fraction_done(double /*time*/, double /*mean_stress*/) const override { return state_.fraction_done; }
  StageResult result(const StageObservation& last) const override;
  void write(FieldWriter& to) const override { LoadingState::for_each_field(state_, to); }
  void read(FieldReader& from) override { LoadingState::for_each_field(state_, from); }

protected:
  WallLoading(const StageLabel& label, const StageStart& start, const LoadingEnds& ends);

  /// First observation. Throws SimulationError if the end cannot be reached from there.
  virtual void begin(const ObservedSample& /*seen*/) {}
  /// Sets state_.speed.
  virtual void drive(const ObservedSample& seen) = 0;
  virtual LoadingEnd find_end(const ObservedSample& seen) const = 0;
  virtual double find_fraction_done(const ObservedSample& seen) const;
  /// Throws SimulationError if the stage does not end as requested.
  virtual void check_end(const ObservedSample& /*seen*/) const {}
  /// Throws SimulationError if the packing went far without reaching the end.
  virtual void check_limits(const ObservedSample& seen) const;
  virtual std::string end_text() const;
  /// MPa by which a turning point was passed, for ends that are no stress.
  virtual double overshoot() const { return 0; }

  /// Throws SimulationError if the stage takes far longer than expected.
  void check_time(const ObservedSample& seen) const;
  /// The ends that all paths share: dissipation and time.
  LoadingEnd common_end(const ObservedSample& seen) const;
  /// Throws SimulationError: "stage 'x': its end was not reached: p = … " + what.
  [[noreturn]] void fail(const ObservedSample& seen, const std::string& what) const;
  ObservedSample sample(const StageObservation& seen) const {
    return observe_sample(seen, start_length_, start_.sample.solid_volume);
  }
  /// s to full speed, for a ramp that is a part of the time in which the walls travel `travel` (mm) at `speed` (mm/s).
  static double ramp_time(double ramp_fraction, double travel, double speed) { return ramp_fraction * travel / speed; }

private:
  void refuse_end_behind(const ObservedSample& seen) const;

protected:
  std::string name_;
  StageStart start_;
  LoadingEnds ends_;
  std::array<double, 3> start_length_; ///< mm
  double ramp_ = 0;                    ///< s, to full speed
  double expected_duration_ = 0;       ///< s
  std::array<double, 3> expected_scale_{1, 1, 1};
  LoadingState state_;
};

} // namespace mpfem
