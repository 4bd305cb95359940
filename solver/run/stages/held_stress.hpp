#pragma once
// All walls are held at stresses: at one stress for a time, or on a straight path of mean and deviatoric stress.

#include "solver/run/stages/stress_servo.hpp"
#include "solver/run/stages/wall_loading.hpp"

namespace mpfem {

/// A value that changes smoothly from that at the start to a given one within `ramp` s.
double ramped(double time, double ramp, double start, double given);

/// Adds to the result how well stresses were held.
StageResult with_hold_quality(StageResult result, const HoldQuality& quality);

/// Base of the stages in which all three axes are held.
class HeldWalls : public WallLoading {
public:
  StageResult result(const StageObservation& last) const override;
  void write(FieldWriter& to) const override;
  void read(FieldReader& from) override;

protected:
  HeldWalls(const StageLabel& label, const StageStart& start, const LoadingEnds& ends, double servo_speed)
      : WallLoading(label, start, ends), servo_(start, servo_speed) {}
  void hold(const ObservedSample& seen, std::size_t axis, double wanted) {
    state_.speed[axis] = servo_.hold(axes_[axis], quality_, wanted, seen.stress[axis], seen.step, seen.rate_factor);
  }

  StressServo servo_;
  std::array<ServoState, 3> axes_;
  HoldQuality quality_;
};

/// At one stress, for a time.
class HeldStressControl final : public HeldWalls {
public:
  HeldStressControl(const HeldStress& stage, const StageLabel& label, const StageStart& start);
  std::string describe() const override;

private:
  void drive(const ObservedSample& seen) override;
  LoadingEnd find_end(const ObservedSample& seen) const override { return common_end(seen); }
  void check_end(const ObservedSample& seen) const override;

  double mean_stress_; ///< MPa
};

/// On a straight path of mean and deviatoric stress.
class StressProbeControl final : public HeldWalls {
public:
  StressProbeControl(const StressProbe& stage, const StageLabel& label, const StageStart& start);
  std::string describe() const override { return "all walls held on a straight path of p and q"; }
  void write(FieldWriter& to) const override;
  void read(FieldReader& from) override;

private:
  void begin(const ObservedSample& seen) override;
  void drive(const ObservedSample& seen) override;
  LoadingEnd find_end(const ObservedSample& seen) const override;
  void check_limits(const ObservedSample& seen) const override;

  struct State {
    double change = 0; ///< MPa of the path's leading axis
    double rate = 0;   ///< MPa/s
  };
  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("path.change", s.change), visit("path.rate", s.rate);
  }
  StressProbe stage_;
  std::array<double, 3> path_stress_{}; ///< change of each axis's stress along the path, the largest 1
  double start_rate_;                   ///< MPa/s
  State path_;
};

} // namespace mpfem
