#include "solver/scenario/stages.hpp"

#include <type_traits>

namespace mpfem {

double driven_speed(const StageType& type) {
  return std::visit(
      [](const auto& stage) {
        using Type = std::decay_t<decltype(stage)>;
        if constexpr (std::is_same_v<Type, GripMotion>)
          return stage.speed;
        else if constexpr (std::is_same_v<Type, Rest> || std::is_same_v<Type, HeldStress>)
          return 0.0;
        else
          return stage.wall_speed;
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

Axes withdrawn_axes(const StageType& type) {
  if (std::holds_alternative<GripMotion>(type)) return {true, true, true};
  if (std::holds_alternative<UnconfinedCompression>(type)) return {true, true, false};
  return {};
}

bool moves_walls(const StageType& type) {
  return !std::holds_alternative<Rest>(type) && !std::holds_alternative<GripMotion>(type);
}

} // namespace mpfem
