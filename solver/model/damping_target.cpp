#include "solver/model/damping_target.hpp"

namespace mpfem {

std::array<double, 4> damping_target(const Model& model, int grain, const Advance& p) {
  std::array<double, 4> target{};
  if (!(p.damping_rate > 0)) return target;
  const auto g = static_cast<std::size_t>(grain);
  std::array<double, 3> centre{};
  for (std::size_t n = model.first_node(grain); n < model.end_node(grain); ++n)
    for (std::size_t axis = 0; axis < 3; ++axis) centre[axis] += model.position[4 * n + axis] / model.inverse_mass[n];
  for (std::size_t axis = 0; axis < 3; ++axis) target[axis] = affine_velocity(p, axis, centre[axis] / model.mass[g]);
  return target;
}

} // namespace mpfem
