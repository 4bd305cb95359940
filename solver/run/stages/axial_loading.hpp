#pragma once
// The z walls are driven; the x and y walls are away (unconfined), at rest (die) or held at a force or stress
// (triaxial).

#include "solver/run/stages/driven_speed.hpp"
#include "solver/run/stages/stress_servo.hpp"
#include "solver/run/stages/wall_loading.hpp"

namespace mpfem {

/// What drives and ends axial loadings of all three types.
class AxialLoading : public WallLoading {
public:
  void write(FieldWriter& to) const override;
  void read(FieldReader& from) override;

protected:
  AxialLoading(const AxialDrive& stage, const StageLabel& label, const StageStart& start);
  void begin(const ObservedSample& seen) override;
  void drive(const ObservedSample& seen) override;
  LoadingEnd find_end(const ObservedSample& seen) const override;
  std::string end_text() const override;
  /// MPa, the stress whose fall from its peak may end the stage.
  virtual double watched_stress(const ObservedSample& seen) const { return std::abs(seen.deviatoric_stress); }

private:
  void watch_peak(const ObservedSample& seen);

  struct State {
    double sign = 1;    ///< 1: the walls move inwards, -1 outwards
    double watched = 0; ///< MPa, the watched stress, averaged over a transit
    double peak = 0;    ///< MPa, of `watched`
  };
  template <class Self, class Visitor>
  static void for_each_field(Self& s, Visitor&& visit) {
    visit("axial.sign", s.sign), visit("axial.watched", s.watched), visit("axial.peak", s.peak);
  }
  double wall_speed_; ///< mm/s
  double transit_;    ///< s
  DrivenSpeed driven_;
  State axial_;
};

/// The x and y walls are away; the axial stress is watched for a fall.
class UnconfinedCompressionControl final : public AxialLoading {
public:
  UnconfinedCompressionControl(const UnconfinedCompression& stage, const StageLabel& label, const StageStart& start)
      : AxialLoading(stage, label, start) {}
  std::string describe() const override { return "z walls driven, x and y walls withdrawn"; }

private:
  double watched_stress(const ObservedSample& seen) const override { return seen.stress[2]; }
};

/// The x and y walls are at rest.
class DieCompressionControl final : public AxialLoading {
public:
  DieCompressionControl(const DieCompression& stage, const StageLabel& label, const StageStart& start)
      : AxialLoading(stage, label, start) {}
  std::string describe() const override { return "z walls driven, x and y walls at rest"; }
};

/// The x and y walls are held at a force or stress by servos.
class TriaxialCompressionControl final : public AxialLoading {
public:
  TriaxialCompressionControl(const TriaxialCompression& stage, const StageLabel& label, const StageStart& start);
  std::string describe() const override;
  StageResult result(const StageObservation& last) const override;
  void write(FieldWriter& to) const override;
  void read(FieldReader& from) override;

private:
  void drive(const ObservedSample& seen) override;
  /// MPa, to be held now on an axis.
  double wanted_stress(const ObservedSample& seen, std::size_t axis) const;

  TriaxialCompression stage_;
  StressServo servo_;
  std::array<ServoState, 2> lateral_;
  HoldQuality quality_;
};

} // namespace mpfem
