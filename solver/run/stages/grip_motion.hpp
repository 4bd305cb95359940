#pragma once
// Nodes near two opposite faces of the box are gripped and moved along the box's axis.

#include "solver/run/stages/timed_stages.hpp"

namespace mpfem {

/// The cell's two faces along the axis, and the grips with them, move to the displacement in a known time.
class GripMotionControl final : public TimedStage {
public:
  /// Throws InputError where the grips would meet.
  GripMotionControl(const GripMotion& stage, const StageLabel& label, const StageStart& start);
  std::string describe() const override { return "grips moved to a displacement"; }
  const GripMotion* grips() const override { return &stage_; }
  std::array<double, 3> sliding(double time) const override;
  StageResult result(const StageObservation& last) const override;

private:
  GripMotion stage_;
};

} // namespace mpfem
