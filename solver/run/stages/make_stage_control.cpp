// The list of all types of stages.

#include "solver/run/stages/axial_loading.hpp"
#include "solver/run/stages/grip_motion.hpp"
#include "solver/run/stages/held_stress.hpp"
#include "solver/run/stages/isotropic_compaction.hpp"
#include "solver/run/stages/isotropic_loading.hpp"
#include "solver/run/stages/isotropic_unloading.hpp"
#include "solver/run/stages/rest.hpp"

namespace mpfem {

namespace {

/// Which control runs which type of stage.
template <class Type>
struct ControlOf;
template <>
struct ControlOf<IsotropicCompaction> {
  using type = IsotropicCompactionControl;
};
template <>
struct ControlOf<IsotropicLoading> {
  using type = IsotropicLoadingControl;
};
template <>
struct ControlOf<IsotropicUnloading> {
  using type = IsotropicUnloadingControl;
};
template <>
struct ControlOf<StressCycles> {
  using type = StressCyclesControl;
};
template <>
struct ControlOf<UnconfinedCompression> {
  using type = UnconfinedCompressionControl;
};
template <>
struct ControlOf<DieCompression> {
  using type = DieCompressionControl;
};
template <>
struct ControlOf<TriaxialCompression> {
  using type = TriaxialCompressionControl;
};
template <>
struct ControlOf<StressProbe> {
  using type = StressProbeControl;
};
template <>
struct ControlOf<HeldStress> {
  using type = HeldStressControl;
};
template <>
struct ControlOf<Rest> {
  using type = RestControl;
};
template <>
struct ControlOf<GripMotion> {
  using type = GripMotionControl;
};

} // namespace

std::unique_ptr<StageControl> make_stage_control(const Stage& stage, const StageStart& start) {
  return std::visit(
      [&](const auto& type) -> std::unique_ptr<StageControl> {
        using Control = typename ControlOf<std::decay_t<decltype(type)>>::type;
        return std::make_unique<Control>(type, StageLabel{stage.name, stage.places}, start);
      },
      stage.type);
}

} // namespace mpfem
