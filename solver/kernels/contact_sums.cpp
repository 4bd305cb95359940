#include "solver/kernels/contact_sums.hpp"

#include <algorithm>
#include <optional>
#include <tuple>

#include "common/index.hpp"
#include "solver/physics/penalty.hpp"

namespace mpfem {

namespace {

/// K (MPa/mm) of the two passes of a pair together.
double penalty_of_pair(const Model& model, const ContactCandidates& candidates, std::int32_t pair) {
  return 2 * pass_stiffness(model.penalty_stiffness[at(candidates.pair_first[at(pair)])],
                            model.penalty_stiffness[at(candidates.pair_second[at(pair)])]);
}

/// Of the bond at a point.
BondLaw law_at_point(const Model& model, const Contact& contact, double penalty_of_pair, std::int32_t point) {
  const std::size_t node = at(contact.candidates.point_node[at(point)]);
  return bond_law(contact, contact.bond[at(point)], penalty_of_pair * model.local_stiffness(node));
}

/// mm^2: each of the two passes carries half of the traction, so half of the energy.
double share_of_point(const Model& model, const Contact& contact, std::int32_t point) {
  return 0.5 * model.reference_area[at(contact.candidates.point_node[at(point)])];
}

} // namespace

double contact_area(const Model& model, const Contact& contact, int grain) {
  double area = 0;
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair)
    for (const ContactForce& point : contact.active_points(pair)) area += model.normal[4 * at(point.node) + 3];
  return area;
}

BondSums bond_sums(const Model& model, const Contact& contact, std::int32_t pair) {
  BondSums sums;
  if (contact.bond.empty()) return sums;
  const ContactCandidates& candidates = contact.candidates;
  const double penalty = penalty_of_pair(model, candidates, pair);
  for (std::int32_t p = candidates.pair_point_offset[at(pair)]; p < candidates.pair_point_offset[at(pair) + 1]; ++p) {
    const PointBond& bond = contact.bond[at(p)];
    if (!bond.exists() && bond.spent == 0) continue;
    const double area = model.reference_area[at(candidates.point_node[at(p)])];
    const BondLaw law = law_at_point(model, contact, penalty, p);
    const double share = share_of_point(model, contact, p);
    sums.formed_area += area;
    sums.damaged_area += bond.exists() ? (1.0 - bond.remaining) * area : area;
    sums.dissipated += share * bond.spent;
    if (!bond.exists()) continue;
    sums.dissipated += share * damage_dissipation(law, bond.state);
    sums.stored += 0.5 * share * bond.remaining * law.stiffness * bond.separation * bond.separation;
    if (!bond.intact()) continue;
    sums.bonded_area += area;
    ++sums.bonds;
  }
  return sums;
}

double bond_dissipation(const Model& model, const Contact& contact, std::int32_t pair, std::int32_t point) {
  const PointBond& bond = contact.bond[at(point)];
  const double share = share_of_point(model, contact, point);
  if (!bond.exists()) return share * bond.spent;
  const double penalty = penalty_of_pair(model, contact.candidates, pair);
  return share * (bond.spent + damage_dissipation(law_at_point(model, contact, penalty, point), bond.state));
}

namespace {

/// What the nodes of a grain have with another: force on the grain, half of the area, bonds. Nothing where they neither
/// touch nor ever had a bond.
std::optional<PairContact> half_contact(const Model& model, const Contact& contact, std::int32_t pair) {
  const auto p = at(pair);
  PairContact half{
      contact.candidates.pair_first[p], contact.candidates.pair_second[p], {}, 0, bond_sums(model, contact, pair)};
  const auto touching = contact.active_points(pair), pulling = contact.pulling_bonds(pair);
  if (touching.empty() && half.bonds.formed_area == 0) return std::nullopt;
  for (const auto points : {touching, pulling})
    for (const ContactForce& point : points)
      for (int axis = 0; axis < 3; ++axis) half.force[axis] += point.force[axis];
  for (const ContactForce& point : touching) half.area += 0.5 * model.normal[4 * at(point.node) + 3];
  return half;
}

/// The halves that concern own grains as the first of both: own ones, and those whose nodes are another rank's.
std::vector<PairContact> halves_of_own(const Model& model, const Contact& contact, const Communicator& ranks) {
  std::vector<PairContact> halves;
  std::vector<Bytes> to_ranks(at(ranks.size()));
  const ContactCandidates& candidates = contact.candidates;
  for (const std::int32_t grain : model.own())
    for (std::int32_t pair = candidates.outgoing_offset[at(grain)]; pair < candidates.outgoing_offset[at(grain) + 1];
         ++pair) {
      const auto half = half_contact(model, contact, pair);
      if (!half) continue;
      const std::int32_t owner = model.ownership.owner[at(std::min(half->first, half->second))];
      if (owner == model.ownership.rank)
        halves.push_back(*half);
      else
        append(to_ranks[at(owner)], *half);
    }
  if (ranks.alone()) return halves;
  for (const Bytes& message : ranks.exchange(to_ranks))
    for (MessageReader reader(message); !reader.done();) halves.push_back(reader.take<PairContact>());
  return halves;
}

/// Adds a half to the contact of its two grains; the other half may have been added before.
void add_half(PairContact& pair, const PairContact& half) {
  const double sign = half.first == pair.first ? 1.0 : -1.0;
  for (int axis = 0; axis < 3; ++axis) pair.force[axis] += sign * half.force[axis];
  pair.area += half.area;
  pair.bonds.add(half.bonds);
}

} // namespace

std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact, const Communicator& ranks) {
  std::vector<PairContact> halves = halves_of_own(model, contact, ranks);
  const auto grains = [](const PairContact& half) { return std::minmax(half.first, half.second); };
  // Of both halves that of the first grain's nodes comes first.
  std::sort(halves.begin(), halves.end(), [&](const PairContact& a, const PairContact& b) {
    return std::tuple(grains(a), a.first) < std::tuple(grains(b), b.first);
  });
  std::vector<PairContact> pairs;
  for (const PairContact& half : halves) {
    const auto [first, second] = grains(half);
    if (pairs.empty() || pairs.back().first != first || pairs.back().second != second)
      pairs.push_back({first, second, {}, 0, {}});
    add_half(pairs.back(), half);
  }
  return pairs;
}

} // namespace mpfem
