#include "solver/kernels/contact_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/index.hpp"

namespace mpfem {

namespace {

using Pair = std::pair<std::int32_t, std::int32_t>;

/// Points [point, end) of one pair in a list of candidates, by ascending node.
struct PointRange {
  std::int32_t point = 0, end = 0;
  bool left() const { return point < end; }
};

/// The node of the range's next point; larger than any node if none is left.
std::int32_t next_node(const ContactCandidates& candidates, const PointRange& range) {
  return range.left() ? candidates.point_node[at(range.point)] : std::numeric_limits<std::int32_t>::max();
}

/// The pairs of a list of candidates, one after another.
struct PairCursor {
  const ContactCandidates& candidates;
  std::size_t pair = 0;

  /// The current pair; larger than any other if none is left.
  Pair grains() const {
    constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
    return pair < candidates.pair_first.size() ? Pair(candidates.pair_first[pair], candidates.pair_second[pair])
                                               : Pair(none, none);
  }
  bool left() const { return pair < candidates.pair_first.size(); }
  /// The points of these two grains, after which the cursor moves on to the next pair; none if the current pair is
  /// another one.
  PointRange take(const Pair& wanted) {
    if (!left() || grains() != wanted) return {};
    ++pair;
    return {candidates.pair_point_offset[pair - 1], candidates.pair_point_offset[pair]};
  }
};

/// New candidates together with the points of the old ones that have, or had, a bond.
struct BondedCandidates {
  ContactCandidates candidates;
  std::vector<PointBond> bond; ///< [points]
};

/// Appends the points of one pair, found and old, by ascending node. Old points without a bond and without the energy
/// of former bonds are left out. A point that is in both lists gets the new facets and the old bond.
void merge_points(const ContactCandidates& found, PointRange new_points, const ContactCandidates& old,
                  const std::vector<PointBond>& old_bond, PointRange old_points, BondedCandidates& merged) {
  const auto is_kept = [&](std::int32_t point) {
    return old_bond[at(point)].exists() || old_bond[at(point)].dissipated_before > 0;
  };
  ContactCandidates& candidates = merged.candidates;
  while (new_points.left() || old_points.left()) {
    if (old_points.left() && !is_kept(old_points.point)) {
      ++old_points.point;
      continue;
    }
    const std::int32_t new_node = next_node(found, new_points), old_node = next_node(old, old_points);
    candidates.point_node.push_back(std::min(new_node, old_node));
    merged.bond.push_back(old_node <= new_node ? old_bond[at(old_points.point)] : PointBond{});
    if (new_node <= old_node) {
      candidates.point_facet.insert(candidates.point_facet.end(),
                                    found.point_facet.begin() + found.point_facet_offset[at(new_points.point)],
                                    found.point_facet.begin() + found.point_facet_offset[at(new_points.point) + 1]);
      ++new_points.point;
    }
    if (old_node <= new_node) ++old_points.point;
    candidates.point_facet_offset.push_back(offset_after(candidates.point_facet));
  }
}

/// Candidates just found, with the points of the old ones that have, or had, a bond.
BondedCandidates keep_bonded_points(const ContactCandidates& found, const ContactCandidates& old,
                                    const std::vector<PointBond>& old_bond, int grains) {
  BondedCandidates merged;
  ContactCandidates& candidates = merged.candidates;
  candidates.pair_point_offset.push_back(0);
  candidates.point_facet_offset.push_back(0);
  PairCursor next_found{found}, next_old{old};
  while (next_found.left() || next_old.left()) {
    const Pair pair = std::min(next_found.grains(), next_old.grains());
    const std::size_t before = candidates.point_node.size();
    const PointRange new_points = next_found.take(pair), old_points = next_old.take(pair);
    merge_points(found, new_points, old, old_bond, old_points, merged);
    if (candidates.point_node.size() == before) continue;
    candidates.pair_first.push_back(pair.first);
    candidates.pair_second.push_back(pair.second);
    candidates.pair_point_offset.push_back(offset_after(candidates.point_node));
  }
  index_pairs(candidates, grains);
  return merged;
}

/// The friction of new points, from the old points of the same node and grain. The dissipation of those old points is
/// set to 0, so that `friction` keeps only that of points which are gone.
std::vector<PointFriction> carried_friction(const ContactCandidates& now, const ContactCandidates& old,
                                            std::vector<PointFriction>& friction) {
  std::vector<PointFriction> carried(now.point_node.size());
  PairCursor next_old{old};
  for (PairCursor next_now{now}; next_now.left();) {
    const Pair pair = next_now.grains();
    while (next_old.grains() < pair) ++next_old.pair;
    PointRange points = next_now.take(pair), before = next_old.take(pair);
    for (; points.left(); ++points.point) {
      const std::int32_t node = next_node(now, points);
      while (next_node(old, before) < node) ++before.point;
      if (next_node(old, before) != node) continue;
      carried[at(points.point)] = friction[at(before.point)];
      friction[at(before.point)].dissipated = 0;
    }
  }
  return carried;
}

/// Carries friction over to new candidates, and records what points that are gone have dissipated.
void carry_friction(const ContactCandidates& now, Contact& contact) {
  const ContactCandidates& old = contact.candidates;
  std::vector<PointFriction> carried = carried_friction(now, old, contact.point_friction);
  for (std::size_t p = 0; p < old.pair_first.size(); ++p) {
    double lost = 0;
    for (std::int32_t i = old.pair_point_offset[p]; i < old.pair_point_offset[p + 1]; ++i)
      lost += contact.point_friction[at(i)].dissipated;
    if (lost != 0) contact.friction_of_former_points[{old.pair_first[p], old.pair_second[p]}] += lost;
  }
  contact.point_friction = std::move(carried);
}

/// Makes `records` this long; what they hold does not matter. Where they do not fit, the old ones are freed before more
/// memory is allocated: never both at once.
void make_room(std::size_t points, std::vector<ContactForce>& records) {
  if (points > records.capacity()) {
    records = {};
    records.reserve(points + points / 16); // the number of points grows by little from one search to the next
  }
  records.resize(points);
}

/// Memory for the records of forces of all points.
void make_room_for_forces(Contact& contact) {
  const std::size_t points = contact.candidates.point_node.size(), pairs = contact.candidates.pair_first.size();
  make_room(points, contact.force);
  contact.active.assign(pairs, 0);
  if (!contact.bonding()) return;
  make_room(points, contact.bond_force);
  contact.pulling.assign(pairs, 0);
}

/// Candidates assembled from pairs of other lists, and which old point each point was.
struct CandidatesFromOld {
  ContactCandidates candidates;
  std::vector<std::int32_t> old_point; ///< [points]; -1: none

  CandidatesFromOld() {
    candidates.pair_point_offset.push_back(0);
    candidates.point_facet_offset.push_back(0);
  }
  void append(const ContactCandidates& from, std::size_t pair, bool keeps_state) {
    candidates.pair_first.push_back(from.pair_first[pair]);
    candidates.pair_second.push_back(from.pair_second[pair]);
    for (std::int32_t p = from.pair_point_offset[pair]; p < from.pair_point_offset[pair + 1]; ++p) {
      candidates.point_node.push_back(from.point_node[at(p)]);
      candidates.point_facet.insert(candidates.point_facet.end(),
                                    from.point_facet.begin() + from.point_facet_offset[at(p)],
                                    from.point_facet.begin() + from.point_facet_offset[at(p) + 1]);
      candidates.point_facet_offset.push_back(offset_after(candidates.point_facet));
      old_point.push_back(keeps_state ? p : -1);
    }
    candidates.pair_point_offset.push_back(offset_after(candidates.point_node));
  }
};

template <class T>
void carry_over(const std::vector<std::int32_t>& old_point, const T& fresh, std::vector<T>& values) {
  std::vector<T> carried;
  carried.reserve(old_point.size());
  for (const std::int32_t old : old_point) carried.push_back(old >= 0 ? values[at(old)] : fresh);
  values = std::move(carried);
}

/// Makes these the candidates of contact. Points keep the state that they had.
void take_over(CandidatesFromOld&& now, int grains, Contact& contact) {
  carry_over(now.old_point, std::int32_t{-1}, contact.point_facet);
  carry_over(now.old_point, -1.0, contact.point_open_until);
  carry_over(now.old_point, -1.0, contact.point_facet_until);
  if (contact.bonding()) carry_over(now.old_point, PointBond{}, contact.bond);
  if (contact.has_friction()) carry_over(now.old_point, PointFriction{}, contact.point_friction);
  contact.candidates = std::move(now.candidates);
  index_pairs(contact.candidates, grains);
  make_room_for_forces(contact);
}

} // namespace

void renew_candidates(const Model& model, const SearchRange& range, ThreadTeam& team, Contact& contact) {
  ContactCandidates candidates = find_contact_candidates(model.surface(), range.reach, range.bounds, range.near, team);
  if (contact.bonding()) {
    BondedCandidates merged = keep_bonded_points(candidates, contact.candidates, contact.bond, model.grains);
    candidates = std::move(merged.candidates);
    contact.bond = std::move(merged.bond);
  }
  if (contact.has_friction()) carry_friction(candidates, contact);
  contact.candidates = std::move(candidates);
  contact.margin = range.margin;
  const std::size_t points = contact.candidates.point_node.size();
  contact.point_facet.assign(points, -1);
  contact.point_open_until.assign(points, -1.0);
  contact.point_facet_until.assign(points, -1.0);
  make_room_for_forces(contact);
  contact.travel_at_search = contact.travel;
}

void leave_own_pairs(const Model& model, Contact& contact) {
  const ContactCandidates& all = contact.candidates;
  CandidatesFromOld own;
  for (std::size_t pair = 0; pair < all.pair_first.size(); ++pair)
    if (model.ownership.owns(all.pair_first[pair])) own.append(all, pair, true);
  take_over(std::move(own), model.grains, contact);
}

void add_pairs(const Model& model, const ContactCandidates& others, Contact& contact) {
  CandidatesFromOld joined;
  PairCursor own{contact.candidates}, other{others};
  while (own.left() || other.left()) {
    const bool is_own = own.grains() < other.grains();
    PairCursor& next = is_own ? own : other;
    joined.append(next.candidates, next.pair, is_own);
    ++next.pair;
  }
  take_over(std::move(joined), model.grains, contact);
}

double travel_in_step(const Contact& contact, const Advance& update, double relative_speed) {
  const double rate = std::max({std::abs(update.rate[0]), std::abs(update.rate[1]), std::abs(update.rate[2])});
  return (relative_speed + 0.5 * rate * contact.margin) * update.step;
}

double travel_since_search(const Contact& contact, std::size_t grain) {
  return contact.travel[grain] - contact.travel_at_search[grain];
}

double largest_travel_since_search(const Contact& contact) {
  double largest = 0;
  for (std::size_t grain = 0; grain < contact.travel.size(); ++grain)
    largest = std::max(largest, travel_since_search(contact, grain));
  return largest;
}

bool search_is_due(const Contact& contact, double travel) {
  return 2.0 * travel > 0.9 * contact.margin;
}

} // namespace mpfem
