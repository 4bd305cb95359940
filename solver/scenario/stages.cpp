#include "solver/scenario/stages.hpp"

namespace mpfem {

double driven_speed(const StageType& type) {
  return std::visit(
      [](const auto& stage) {
        if constexpr (requires { stage.wall_speed; })
          return stage.wall_speed;
        else if constexpr (requires { stage.speed; }) // of grips and tools
          return stage.speed;
        else
          return 0.0;
      },
      type);
}

std::optional<double> servo_speed(const StageType& type) {
  return std::visit(
      [](const auto& stage) -> std::optional<double> {
        if constexpr (requires { stage.servo_speed; })
          return stage.servo_speed;
        else
          return std::nullopt;
      },
      type);
}

const LoadingEnds* loading_ends(const StageType& type) {
  return std::visit(
      [](const auto& stage) -> const LoadingEnds* {
        if constexpr (requires { stage.ends.axial_strain; })
          return &stage.ends;
        else
          return nullptr;
      },
      type);
}

Axes withdrawn_axes(const StageType& type) {
  if (std::holds_alternative<GripMotion>(type)) return {true, true, true};
  if (std::holds_alternative<UnconfinedCompression>(type)) return {true, true, false};
  return {};
}

bool moves_walls(const StageType& type) {
  return !std::holds_alternative<Rest>(type) && !std::holds_alternative<GripMotion>(type) &&
         !std::holds_alternative<ToolLoading>(type);
}

} // namespace mpfem
