#pragma once
// All six walls together: to a mean stress, or in cycles between two.

#include "solver/run/stages/driven_speed.hpp"
#include "solver/run/stages/wall_loading.hpp"

namespace mpfem {

/// Walls that keep the box's proportions.
class IsotropicDrive : public WallLoading {
public:
  void write(FieldWriter& to) const override;
  void read(FieldReader& from) override;

protected:
  IsotropicDrive(const StageLabel& label, const StageStart& start, const LoadingEnds& ends, double wall_speed)
      : WallLoading(label, start, ends), wall_speed_(wall_speed), longest_(start.cell.longest()) {}
  /// Drives the mean stress from `leg_start` to `target` (MPa).
  void drive_to(const ObservedSample& seen, double leg_start, double target);

  double wall_speed_; ///< mm/s
  double longest_;    ///< mm, the longest side of the cell at the start
  DrivenSpeed driven_;
};

/// To a mean stress.
class IsotropicLoadingControl final : public IsotropicDrive {
public:
  IsotropicLoadingControl(const IsotropicLoading& stage, const StageLabel& label, const StageStart& start);
  std::string describe() const override { return "all walls inwards, to a mean stress"; }

private:
  void begin(const ObservedSample& seen) override;
  void drive(const ObservedSample& seen) override;
  LoadingEnd find_end(const ObservedSample& seen) const override;
  void check_limits(const ObservedSample& seen) const override;
};

/// Up and down again between two mean stresses.
class StressCyclesControl final : public IsotropicDrive {
public:
  StressCyclesControl(const StressCycles& stage, const StageLabel& label, const StageStart& start);
  std::string describe() const override;
  std::int64_t half_cycles() const { return cycles_.legs; } ///< done so far
  void write(FieldWriter& to) const override;
  void read(FieldReader& from) override;

private:
  void begin(const ObservedSample& seen) override { cycles_.leg_start = seen.mean_stress; }
  void drive(const ObservedSample& seen) override;
  LoadingEnd find_end(const ObservedSample& seen) const override;
  double find_fraction_done(const ObservedSample& seen) const override;
  std::string end_text() const override;
  double overshoot() const override { return cycles_.overshoot; }
  bool upwards() const { return cycles_.legs % 2 == 0; }
  double target() const { return upwards() ? stage_.highest_mean_stress : stage_.lowest_mean_stress; }

  struct State {
    double leg_start = 0;  ///< MPa, mean stress where the current half cycle began
    std::int64_t legs = 0; ///< half cycles done
    bool inside = false;   ///< the mean stress has been in the lower half of the range
    double overshoot = 0;  ///< MPa, largest amount by which the mean stress passed a turning point
  };
  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("cycles.leg_start", s.leg_start), visit("cycles.legs", s.legs);
    visit("cycles.inside", s.inside), visit("cycles.overshoot", s.overshoot);
  }
  StressCycles stage_;
  State cycles_;
};

} // namespace mpfem
