// The list of all types of stages.

#include "solver/run/stages/axial_loading.hpp"
#include "solver/run/stages/grip_motion.hpp"
#include "solver/run/stages/held_stress.hpp"
#include "solver/run/stages/isotropic_compaction.hpp"
#include "solver/run/stages/isotropic_loading.hpp"
#include "solver/run/stages/isotropic_unloading.hpp"
#include "solver/run/stages/rest.hpp"
#include "solver/run/stages/tool_loading.hpp"

namespace mpfem {

namespace {

template <class Control>
struct RunBy {
  using type = Control;
};

/// Which control runs which type of stage.
template <class Type>
struct ControlOf;
template <>
struct ControlOf<IsotropicCompaction> : RunBy<IsotropicCompactionControl> {};
template <>
struct ControlOf<IsotropicLoading> : RunBy<IsotropicLoadingControl> {};
template <>
struct ControlOf<IsotropicUnloading> : RunBy<IsotropicUnloadingControl> {};
template <>
struct ControlOf<StressCycles> : RunBy<StressCyclesControl> {};
template <>
struct ControlOf<UnconfinedCompression> : RunBy<UnconfinedCompressionControl> {};
template <>
struct ControlOf<DieCompression> : RunBy<DieCompressionControl> {};
template <>
struct ControlOf<TriaxialCompression> : RunBy<TriaxialCompressionControl> {};
template <>
struct ControlOf<StressProbe> : RunBy<StressProbeControl> {};
template <>
struct ControlOf<HeldStress> : RunBy<HeldStressControl> {};
template <>
struct ControlOf<Rest> : RunBy<RestControl> {};
template <>
struct ControlOf<GripMotion> : RunBy<GripMotionControl> {};
template <>
struct ControlOf<ToolLoading> : RunBy<ToolLoadingControl> {};

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
