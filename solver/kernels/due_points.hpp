#pragma once
// Which contact points of a grain have to be evaluated in a step, with their data prefetched.

#include <cstdint>
#include <vector>

#include "common/index.hpp"
#include "solver/kernels/contact_state.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// The points of a grain that must be evaluated in this step, their data prefetched. What a point needs lies scattered
/// over the memory of two grains. Without prefetching, waiting for it takes two thirds of the time of contact. So the
/// due points are listed first, and what their indices point at is prefetched. A few points before a point's turn, when
/// that data has arrived, the nodes of its facet are prefetched.
class DuePoints {
public:
  DuePoints(const Model& model, const Contact& contact, std::size_t expected) : model_(model), contact_(contact) {
    points_.reserve(expected);
  }
  std::size_t size() const { return points_.size(); }
  std::int32_t operator[](std::size_t i) const { return points_[i]; }

  void add(std::int32_t point) {
    points_.push_back(point);
    const std::size_t node = at(contact_.candidates.point_node[at(point)]);
    __builtin_prefetch(&model_.position[4 * node]);
    __builtin_prefetch(&model_.force[4 * node], 1);
    __builtin_prefetch(&model_.reference_area[node]);
    if (!model_.inner_node.empty()) __builtin_prefetch(&model_.position[4 * at(model_.inner_node[node])]);
    prefetch_facet(contact_.point_facet[at(point)]);
    if (const std::int32_t facet = bond_facet(point); facet != contact_.point_facet[at(point)]) prefetch_facet(facet);
  }
  /// Call this when it is the turn of point i.
  void prefetch_ahead_of(std::size_t i) const {
    constexpr std::size_t ahead = 8;
    if (i + ahead >= points_.size()) return;
    const std::int32_t point = points_[i + ahead], facet = contact_.point_facet[at(point)];
    prefetch_nodes(facet);
    if (const std::int32_t other = bond_facet(point); other != facet) prefetch_nodes(other);
  }

private:
  std::int32_t bond_facet(std::int32_t point) const {
    return contact_.bond.empty() ? -1 : contact_.bond[at(point)].facet;
  }
  void prefetch_facet(std::int32_t facet) const {
    if (facet >= 0) __builtin_prefetch(&model_.facet[3 * at(facet)]);
  }
  void prefetch_nodes(std::int32_t facet) const {
    if (facet < 0) return;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t node = at(model_.facet[3 * at(facet) + c]);
      __builtin_prefetch(&model_.position[4 * node]);
      __builtin_prefetch(&model_.normal[4 * node]);
    }
  }
  const Model& model_;
  const Contact& contact_;
  std::vector<std::int32_t> points_;
};

/// The points of a grain's own nodes whose gap may have closed, or whose bond holds.
template <bool bonding>
DuePoints due_points(const Model& model, const Contact& contact, int grain) {
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_pair = candidates.outgoing_offset[g], end_pair = candidates.outgoing_offset[g + 1];
  DuePoints due(model, contact,
                static_cast<std::size_t>(candidates.pair_point_offset[at(end_pair)] -
                                         candidates.pair_point_offset[at(first_pair)]));
  for (std::int32_t pair = first_pair; pair < end_pair; ++pair) {
    const double travel = contact.travel[g] + contact.travel[at(candidates.pair_second[at(pair)])];
    for (std::int32_t point = candidates.pair_point_offset[at(pair)];
         point < candidates.pair_point_offset[at(pair) + 1]; ++point)
      if (travel >= contact.point_open_until[at(point)] || (bonding && contact.bond[at(point)].intact()))
        due.add(point);
  }
  return due;
}

} // namespace mpfem
