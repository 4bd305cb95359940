#pragma once
// Nothing is driven: free flight, vibration, settling.

#include <fmt/format.h>

#include "solver/run/stages/timed_stages.hpp"

namespace mpfem {

/// Ends after its duration.
class RestControl final : public TimedStage {
public:
  RestControl(const Rest& stage, const StageLabel& /*label*/, const StageStart& start) : TimedStage(start) {
    motion_.duration = stage.duration;
  }
  std::string describe() const override { return fmt::format("walls at rest for {:g} s", motion_.duration); }
  StageResult result(const StageObservation& /*last*/) const override {
    return {.ended_by = fmt::format("duration {:g} s", motion_.duration)};
  }
};

} // namespace mpfem
