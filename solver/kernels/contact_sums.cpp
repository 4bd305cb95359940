#include "solver/kernels/contact_sums.hpp"

#include <algorithm>
#include <map>
#include <utility>

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

using GrainPair = std::pair<std::int32_t, std::int32_t>;

/// Of all pairs that have ever rubbed, first < second, whichever of the two grains' nodes did.
std::map<GrainPair, FrictionSums> friction_of_pairs(const Contact& contact) {
  std::map<GrainPair, FrictionSums> pairs;
  if (!contact.has_friction()) return pairs;
  const ContactCandidates& candidates = contact.candidates;
  for (std::size_t p = 0; p < candidates.pair_first.size(); ++p) {
    FrictionSums& sums = pairs[std::minmax(candidates.pair_first[p], candidates.pair_second[p])];
    for (std::int32_t i = candidates.pair_point_offset[p]; i < candidates.pair_point_offset[p + 1]; ++i)
      sums.add({contact.rubbing[at(i)].stored, contact.rubbing[at(i)].dissipated});
  }
  for (const auto& [grains, lost] : contact.friction_left_behind)
    pairs[std::minmax(grains.first, grains.second)].dissipated += lost;
  return pairs;
}

} // namespace

std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact) {
  std::map<GrainPair, PairContact> pairs;
  const ContactCandidates& candidates = contact.candidates;
  for (std::size_t p = 0; p < candidates.pair_first.size(); ++p) {
    const std::int32_t a = candidates.pair_first[p], b = candidates.pair_second[p];
    const auto pair = static_cast<std::int32_t>(p);
    const BondSums bonds = bond_sums(model, contact, pair);
    const auto touching = contact.active_points(pair), pulling = contact.pulling_bonds(pair);
    if (touching.empty() && bonds.formed_area == 0) continue;
    auto& entry =
        pairs.try_emplace({std::min(a, b), std::max(a, b)}, PairContact{std::min(a, b), std::max(a, b), {}, 0, {}, {}})
            .first->second;
    const double sign = a < b ? 1.0 : -1.0;
    for (const auto points : {touching, pulling})
      for (const ContactForce& point : points)
        for (int axis = 0; axis < 3; ++axis) entry.force[axis] += sign * point.force[axis];
    for (const ContactForce& point : touching) entry.area += 0.5 * model.normal[4 * at(point.node) + 3];
    entry.bonds.add(bonds);
  }
  const auto friction = friction_of_pairs(contact);
  std::vector<PairContact> result;
  for (const auto& [key, pair] : pairs) {
    result.push_back(pair);
    if (const auto found = friction.find(key); found != friction.end()) result.back().friction = found->second;
  }
  return result;
}

} // namespace mpfem
