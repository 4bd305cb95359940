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
std::int32_t next_node(const std::vector<std::int32_t>& point_node, const PointRange& range) {
  return range.left() ? point_node[at(range.point)] : std::numeric_limits<std::int32_t>::max();
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
};

/// Candidates of the nodes of one grain, and which old point each point was.
struct MergedCandidates {
  GrainCandidates candidates;
  std::vector<std::int32_t> old_point; ///< [points]; -1: none
};

/// Appends the points of one pair, found and old, by ascending node. Old points that are not found are left out unless
/// `is_kept(point)`. A point that is in both lists gets the new facets.
template <class IsKept>
void merge_points(const GrainCandidates& found, PointRange new_points, const ContactCandidates& old,
                  PointRange old_points, IsKept is_kept, MergedCandidates& merged) {
  GrainCandidates& candidates = merged.candidates;
  while (new_points.left() || old_points.left()) {
    const std::int32_t new_node = next_node(found.node, new_points), old_node = next_node(old.point_node, old_points);
    if (old_node < new_node && !is_kept(old_points.point)) {
      ++old_points.point;
      continue;
    }
    candidates.node.push_back(std::min(new_node, old_node));
    merged.old_point.push_back(old_node <= new_node ? old_points.point : -1);
    if (new_node <= old_node) {
      const auto facet = found.facet.begin();
      candidates.facet.insert(candidates.facet.end(),
                              facet + (new_points.point > 0 ? found.facet_end[at(new_points.point - 1)] : 0),
                              facet + found.facet_end[at(new_points.point)]);
      ++new_points.point;
    }
    if (old_node <= new_node) ++old_points.point;
    candidates.facet_end.push_back(offset_after(candidates.facet));
  }
}

/// Candidates just found for the nodes of a grain, with the points of its old ones that are kept.
template <class IsKept>
MergedCandidates merge_candidates(const GrainCandidates& found, const ContactCandidates& old, std::int32_t grain,
                                  IsKept is_kept) {
  MergedCandidates merged;
  GrainCandidates& candidates = merged.candidates;
  constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
  std::size_t next_found = 0;
  const bool has_old = !old.pair_first.empty();
  std::int32_t next_old = has_old ? old.outgoing_offset[at(grain)] : 0;
  const std::int32_t end_old = has_old ? old.outgoing_offset[at(grain) + 1] : 0;
  while (next_found < found.second.size() || next_old < end_old) {
    const std::int32_t found_second = next_found < found.second.size() ? found.second[next_found] : none;
    const std::int32_t old_second = next_old < end_old ? old.pair_second[at(next_old)] : none;
    const std::size_t before = candidates.node.size();
    PointRange new_points, old_points;
    if (found_second <= old_second) {
      new_points = {next_found > 0 ? found.point_end[next_found - 1] : 0, found.point_end[next_found]};
      ++next_found;
    }
    if (old_second <= found_second) {
      old_points = {old.pair_point_offset[at(next_old)], old.pair_point_offset[at(next_old) + 1]};
      ++next_old;
    }
    merge_points(found, new_points, old, old_points, is_kept, merged);
    if (candidates.node.size() == before) continue;
    candidates.second.push_back(std::min(found_second, old_second));
    candidates.point_end.push_back(offset_after(candidates.node));
  }
  return merged;
}

/// A search drops other points that it does not find: those without a bond and without the energy of former bonds.
bool is_kept(const PointBond& bond) {
  return bond.exists() || bond.dissipated_before > 0;
}

/// Adds the points of contact that are kept to the lists found for these grains. Returns for each list which old point
/// each of its points was.
std::vector<std::vector<std::int32_t>> merge_with_old(std::span<const std::int32_t> firsts, const Contact& contact,
                                                      ThreadTeam& team, std::vector<GrainCandidates>& lists) {
  std::vector<std::vector<std::int32_t>> old_point(lists.size());
  team.for_each(static_cast<int>(lists.size()), [&](int i, int) {
    MergedCandidates merged = merge_candidates(lists[at(i)], contact.candidates, firsts[at(i)], [&](std::int32_t p) {
      return contact.bonding() && is_kept(contact.bond[at(p)]);
    });
    lists[at(i)] = std::move(merged.candidates);
    old_point[at(i)] = std::move(merged.old_point);
  });
  return old_point;
}

/// Calls carry(now, old) with the number of each point and of the old point that it was; several threads do so, each
/// for other points.
template <class Carry>
void for_each_old_point(const ContactCandidates& now, std::span<const std::int32_t> firsts,
                        std::span<const std::vector<std::int32_t>> old_point, ThreadTeam& team, Carry carry) {
  team.for_each(static_cast<int>(firsts.size()), [&](int i, int) {
    const std::int32_t first_pair = now.outgoing_offset[at(firsts[at(i)])];
    std::size_t point = at(now.pair_point_offset[at(first_pair)]);
    for (const std::int32_t old : old_point[at(i)]) {
      if (old >= 0) carry(point, at(old));
      ++point;
    }
  });
}

/// [points of now], from the bonds of the old points.
std::vector<PointBond> carried_bonds(const ContactCandidates& now, std::span<const std::int32_t> firsts,
                                     std::span<const std::vector<std::int32_t>> old_point,
                                     const std::vector<PointBond>& old_bond, ThreadTeam& team) {
  std::vector<PointBond> bond(now.point_node.size());
  for_each_old_point(now, firsts, old_point, team, [&](std::size_t point, std::size_t old) {
    if (is_kept(old_bond[old])) bond[point] = old_bond[old];
  });
  return bond;
}

/// Carries friction over to new candidates, and records what points that are gone have dissipated: only theirs is left
/// once that of the points carried over is set to 0.
void carry_friction(const ContactCandidates& now, std::span<const std::int32_t> firsts,
                    std::span<const std::vector<std::int32_t>> old_point, ThreadTeam& team, Contact& contact) {
  std::vector<PointFriction> carried(now.point_node.size());
  for_each_old_point(now, firsts, old_point, team, [&](std::size_t point, std::size_t before) {
    carried[point] = contact.point_friction[before];
    contact.point_friction[before].dissipated = 0;
  });
  const ContactCandidates& old = contact.candidates;
  std::vector<double> lost(old.pair_first.size());
  team.for_each(static_cast<int>(lost.size()), [&](int p, int) {
    for (std::int32_t i = old.pair_point_offset[at(p)]; i < old.pair_point_offset[at(p) + 1]; ++i)
      lost[at(p)] += contact.point_friction[at(i)].dissipated;
  });
  for (std::size_t p = 0; p < lost.size(); ++p)
    if (lost[p] != 0) contact.friction_of_former_points[{old.pair_first[p], old.pair_second[p]}] += lost[p];
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
  const std::vector<std::int32_t>& firsts = range.near.grain;
  std::vector<GrainCandidates> lists =
      find_candidates_of_grains(model.surface(), range.reach, range.bounds, range.near, team);
  std::vector<std::vector<std::int32_t>> old_point;
  if (contact.bonding() || contact.has_friction()) old_point = merge_with_old(firsts, contact, team, lists);
  ContactCandidates now = join_candidates(firsts, lists, model.grains, team);
  lists = {};
  if (contact.bonding()) contact.bond = carried_bonds(now, firsts, old_point, contact.bond, team);
  if (contact.has_friction()) carry_friction(now, firsts, old_point, team, contact);
  contact.candidates = std::move(now);
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
