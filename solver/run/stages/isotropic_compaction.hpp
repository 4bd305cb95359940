#pragma once
// All six walls move inwards until the packing has a relative density.

#include "solver/run/stages/timed_stages.hpp"

namespace mpfem {

/// The lengths of the cell shrink in proportion, in a known time.
class IsotropicCompactionControl final : public TimedStage {
public:
  /// Throws InputError if the packing is already that dense.
  IsotropicCompactionControl(const IsotropicCompaction& stage, const StageLabel& label, const StageStart& start);
  static constexpr const char* description = "all walls inwards, to a relative density";
  std::string describe() const override { return description; }
  StageResult result(const StageObservation& last) const override;

private:
  double relative_density_;
};

} // namespace mpfem
