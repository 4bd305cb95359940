#include "solver/run/failure_report.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "solver/kernels/element_forces.hpp"
#include "solver/kernels/element_step.hpp"
#include "solver/kernels/grain_state.hpp"

namespace mpfem {

namespace {

/// " at (0.1, 0.2, 0.3) mm", of the mean of some nodes; " at a position that is not finite" where they have flown away.
std::string place_text(const Model& model, std::span<const std::int32_t> nodes) {
  std::array<double, 3> centre{};
  for (const std::int32_t node : nodes)
    for (std::size_t axis = 0; axis < 3; ++axis)
      centre[axis] += model.position[4 * static_cast<std::size_t>(node) + axis] / static_cast<double>(nodes.size());
  if (!std::isfinite(centre[0] + centre[1] + centre[2])) return " at a position that is not finite";
  return fmt::format(" at ({:.4g}, {:.4g}, {:.4g}) mm", centre[0], centre[1], centre[2]);
}

/// Nodes of the grain's tet with this number in the packing file; all nodes of the grain if there is no such tet.
std::vector<std::int32_t> nodes_of_file_tet(const Model& model, int grain, std::int32_t file_tet) {
  const auto g = static_cast<std::size_t>(grain);
  std::vector<std::int32_t> nodes;
  for (std::int32_t tet = model.tet_offset[g]; tet < model.tet_offset[g + 1]; ++tet)
    if (model.file_tet[static_cast<std::size_t>(tet)] == file_tet)
      for (const auto corner : model.nodes_of_tet(grain, tet - model.tet_offset[g]))
        nodes.push_back(model.node_offset[g] + static_cast<std::int32_t>(corner));
  if (nodes.empty())
    for (std::int32_t n = model.node_offset[g]; n < model.node_offset[g + 1]; ++n) nodes.push_back(n);
  return nodes;
}

} // namespace

std::string failed_grain_text(const Model& model, int grain) {
  const BadTet bad = find_bad_tet(model, grain);
  const std::string place = place_text(model, nodes_of_file_tet(model, grain, bad.file_tet));
  const char* cause = "likely causes: too fast a motion, too large a numerics.time_step_factor, or a poor mesh there";
  if (bad.file_tet >= 0)
    return fmt::format("tet {} of grain {}{} is inverted (volume ratio {:.3g}); {}", bad.file_tet, grain, place,
                       bad.volume_ratio, cause);
  return fmt::format("a stress of grain {}{} is not finite; {}", grain, place, cause);
}

} // namespace mpfem
