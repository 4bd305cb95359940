#pragma once
// Which contact points of some grains have to be evaluated in a step, with their data prefetched.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "common/index.hpp"
#include "common/prefetch.hpp"
#include "solver/kernels/contact_state.hpp"
#include "solver/model/model.hpp"

namespace mpfem {

/// The points of some grains that must be evaluated in this step, their data prefetched. What a point needs lies
/// scattered over the memory of two grains. So the due points are listed first, and what their indices point at is
/// prefetched. A few points before a point's turn, when that data has arrived, the nodes of its facet are prefetched.
/// Waiting for the first points cannot be hidden; so several grains are listed together.
class DuePoints {
public:
  DuePoints(const Model& model, const Contact& contact) : model_(model), contact_(contact) {}
  std::size_t size() const { return points_.size(); }
  std::int32_t operator[](std::size_t i) const { return points_[i]; }

  void add(std::int32_t point) {
    points_.push_back(point);
    const std::size_t node = at(contact_.candidates.point_node[at(point)]);
    prefetch(&model_.position[4 * node]);
    prefetch_for_writing(&model_.force[4 * node]);
    prefetch(&model_.reference_area[node]);
    prefetch(&contact_.point_facet_until[at(point)]);
    prefetch(&contact_.candidates.point_facet_offset[at(point)]);
    if (!model_.inner_node.empty()) prefetch(&model_.position[4 * at(model_.inner_node[node])]);
    prefetch_facet(contact_.point_facet[at(point)]);
    if (const std::int32_t facet = bond_facet(point); facet != contact_.point_facet[at(point)]) prefetch_facet(facet);
  }
  /// Call this when all points are listed.
  void prefetch_first() const {
    for (std::size_t i = 0; i < std::min(ahead, points_.size()); ++i) prefetch_nodes_of(points_[i]);
  }
  /// Call this when it is the turn of point i.
  void prefetch_ahead_of(std::size_t i) const {
    if (i + ahead < points_.size()) prefetch_nodes_of(points_[i + ahead]);
  }

private:
  static constexpr std::size_t ahead = 8;

  void prefetch_nodes_of(std::int32_t point) const {
    const std::int32_t facet = contact_.point_facet[at(point)];
    prefetch_nodes(facet);
    if (const std::int32_t other = bond_facet(point); other != facet) prefetch_nodes(other);
  }
  std::int32_t bond_facet(std::int32_t point) const {
    return contact_.bond.empty() ? -1 : contact_.bond[at(point)].facet;
  }
  void prefetch_facet(std::int32_t facet) const {
    if (facet < 0) return;
    prefetch(&model_.facet[3 * at(facet)]); // its three numbers may lie in two cache lines
    prefetch(&model_.facet[3 * at(facet) + 2]);
  }
  void prefetch_nodes(std::int32_t facet) const {
    if (facet < 0) return;
    for (std::size_t c = 0; c < 3; ++c) prefetch(&model_.position[4 * at(model_.facet[3 * at(facet) + c])]);
  }
  const Model& model_;
  const Contact& contact_;
  std::vector<std::int32_t> points_;
};

/// The points of these grains' own nodes whose gap may have closed, or whose bond holds. The arrays that are looked
/// through are prefetched too: the processor's own prefetching ends with each memory page, and the arrays of a grain's
/// bonds are about as long.
template <bool bonding>
DuePoints due_points(const Model& model, const Contact& contact, std::span<const std::int32_t> grains) {
  const ContactCandidates& candidates = contact.candidates;
  DuePoints due(model, contact);
  for (const std::int32_t grain : grains)
    for (std::int32_t pair = candidates.outgoing_offset[at(grain)]; pair < candidates.outgoing_offset[at(grain) + 1];
         ++pair) {
      const double travel = contact.travel[at(grain)] + contact.travel[at(candidates.pair_second[at(pair)])];
      for (std::int32_t point = candidates.pair_point_offset[at(pair)];
           point < candidates.pair_point_offset[at(pair) + 1]; ++point) {
        prefetch_element(contact.point_open_until, at(point) + 64);
        if constexpr (bonding) prefetch_element(contact.bond, at(point) + 16);
        if (travel >= contact.point_open_until[at(point)] || (bonding && contact.bond[at(point)].intact()))
          due.add(point);
      }
    }
  due.prefetch_first();
  return due;
}

} // namespace mpfem
