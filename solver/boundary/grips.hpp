#pragma once
// Grips: the nodes near two opposite faces of the cell are moved as rigid bodies.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/boundary/cell.hpp"
#include "solver/model/model.hpp"
#include "solver/physics/damping.hpp"

namespace mpfem {

/// A node that a grip moves.
struct GrippedNode {
  std::int32_t node;
  std::int32_t side;               ///< 0: the grip at the low face, 1: at the high face
  std::array<double, 3> reference; ///< mm, when gripped: distance from the face along the axis, position across it
};

/// The grips of a stage.
struct Grips {
  std::size_t axis = 2;
  bool lateral_fixed = true;
  std::vector<GrippedNode> node;    ///< of own grains, by grain
  std::vector<std::int32_t> offset; ///< [grains + 1]
  bool present() const { return !offset.empty(); }
  /// Sets `offset` from `node` and the grains' first nodes.
  void make_offsets(std::span<const std::int32_t> node_offset);
};

/// Own nodes within `depth` (mm) of the two faces of the cell along an axis.
Grips grip_nodes(const Model& model, const Cell& cell, std::size_t axis, double depth, bool lateral_fixed);

/// Forces and work of grips on one grain.
struct GripSums {
  std::array<double, 2> force{}; ///< N, push of the low and the high grip towards the middle
  double work_behind = 0;        ///< mJ, half of the forces times the motion in the step that led here
  double work_ahead = 0;         ///< mJ, half of the forces times the motion in the step that follows

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    for (auto& push : s.force) visit.sum(push);
    visit.sum(s.work_behind), visit.sum(s.work_ahead);
  }
};

/// Sets model.force of the gripped nodes so that the velocity update with these parameters takes them to where the
/// grips at `next` hold them. The high grip has then slid across the axis by `sliding` (mm) relative to the low one.
/// `last_step` in s, the step that led here.
GripSums grip_forces(Model& model, const Grips& grips, const Cell& next, const std::array<double, 3>& sliding,
                     const Advance& parameters, double last_step, int grain);

} // namespace mpfem
