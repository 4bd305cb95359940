#include "solver/kernels/contact_sums.hpp"

#include <algorithm>
#include <utility>

#include "common/index.hpp"
#include "solver/model/normals.hpp"
#include "solver/parallel/totals.hpp"
#include "solver/physics/penalty.hpp"

namespace mpfem {

namespace {

/// K (MPa/mm) of the two passes of a pair together.
double penalty_of_pair(const Model& model, const ContactCandidates& candidates, std::int32_t pair) {
  return 2 * pass_stiffness(model.penalty_stiffness[at(candidates.pair_first[at(pair)])],
                            model.penalty_stiffness[at(candidates.pair_second[at(pair)])]);
}

/// Law of the bond at a point.
BondLaw law_of_bond(const Model& model, const Contact& contact, double penalty_of_pair, std::int32_t point) {
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
  const SurfaceNormals normals(model, grain);
  const auto g = static_cast<std::size_t>(grain);
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair)
    for (const ContactForce& point : contact.active_points(pair)) area += normals.area(at(point.node));
  return area;
}

BondSums bond_sums(const Model& model, const Contact& contact, std::int32_t pair) {
  BondSums sums;
  if (contact.bond.empty()) return sums;
  const ContactCandidates& candidates = contact.candidates;
  const double penalty = penalty_of_pair(model, candidates, pair);
  for (std::int32_t p = candidates.pair_point_offset[at(pair)]; p < candidates.pair_point_offset[at(pair) + 1]; ++p) {
    const PointBond& bond = contact.bond[at(p)];
    if (!bond.exists() && bond.dissipated_before == 0) continue;
    const double area = model.reference_area[at(candidates.point_node[at(p)])];
    const BondLaw law = law_of_bond(model, contact, penalty, p);
    const double share = share_of_point(model, contact, p);
    sums.formed_area += area;
    sums.damaged_area += bond.exists() ? (1.0 - bond.remaining) * area : area;
    sums.dissipated += share * bond.dissipated_before;
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
  if (!bond.exists()) return share * bond.dissipated_before;
  const double penalty = penalty_of_pair(model, contact.candidates, pair);
  return share * (bond.dissipated_before + damage_dissipation(law_of_bond(model, contact, penalty, point), bond.state));
}

namespace {

/// What the nodes of one grain have with another grain.
struct HalfContact {
  PairContact pair;   ///< first: the grain of the nodes; force on it
  bool shown = false; ///< they touch or have had bonds; otherwise only past friction is left
};

using GrainPair = std::pair<std::int32_t, std::int32_t>;

/// The two grains, the lower number first.
GrainPair grains_of(const HalfContact& half) {
  return std::minmax(half.pair.first, half.pair.second);
}

/// Force on the grain with these normals, half of the area, bonds and friction at its nodes.
HalfContact half_contact(const Model& model, const SurfaceNormals& normals, const Contact& contact, std::int32_t pair) {
  const auto p = at(pair);
  const ContactCandidates& candidates = contact.candidates;
  HalfContact half{{candidates.pair_first[p], candidates.pair_second[p], {}, 0, bond_sums(model, contact, pair), {}}};
  const auto touching = contact.active_points(pair), pulling = contact.pulling_bonds(pair);
  half.shown = !touching.empty() || half.pair.bonds.formed_area > 0;
  for (const auto points : {touching, pulling})
    for (const ContactForce& point : points)
      for (int axis = 0; axis < 3; ++axis) half.pair.force[axis] += point.force[axis];
  for (const ContactForce& point : touching) half.pair.area += 0.5 * normals.area(at(point.node));
  if (!contact.has_friction()) return half;
  for (std::int32_t i = candidates.pair_point_offset[p]; i < candidates.pair_point_offset[p + 1]; ++i)
    add_terms(half.pair.friction, {contact.point_friction[at(i)].stored, contact.point_friction[at(i)].dissipated});
  return half;
}

/// The halves at nodes of own grains.
std::vector<HalfContact> halves_at_own_nodes(const Model& model, const Contact& contact) {
  std::vector<HalfContact> halves;
  const ContactCandidates& candidates = contact.candidates;
  for (const std::int32_t grain : model.own()) {
    const SurfaceNormals normals(model, grain);
    for (std::int32_t pair = candidates.outgoing_offset[at(grain)]; pair < candidates.outgoing_offset[at(grain) + 1];
         ++pair)
      if (const HalfContact half = half_contact(model, normals, contact, pair); half.shown || contact.has_friction())
        halves.push_back(half);
  }
  for (const auto& [grains, lost] : contact.friction_of_former_points)
    halves.push_back({{grains.first, grains.second, {}, 0, {}, {0, lost}}});
  return halves;
}

/// From the halves of all ranks, those whose lower-numbered grain is an own grain.
std::vector<HalfContact> halves_of_own(const Model& model, const Contact& contact, const Communicator& ranks) {
  std::vector<HalfContact> halves = halves_at_own_nodes(model, contact);
  if (ranks.alone()) return halves;
  std::vector<Bytes> to_ranks(at(ranks.size()));
  std::erase_if(halves, [&](const HalfContact& half) {
    const std::int32_t owner = model.ownership.owner[at(std::min(half.pair.first, half.pair.second))];
    if (owner == model.ownership.rank) return false;
    append(to_ranks[at(owner)], half);
    return true;
  });
  for (const Bytes& message : ranks.exchange(to_ranks))
    for (MessageReader reader(message); !reader.done();) halves.push_back(reader.take<HalfContact>());
  return halves;
}

/// Adds a half to the contact of its two grains; the other half may have been added before.
void add_half(HalfContact& both, const HalfContact& half) {
  const double sign = half.pair.first == both.pair.first ? 1.0 : -1.0;
  for (int axis = 0; axis < 3; ++axis) both.pair.force[axis] += sign * half.pair.force[axis];
  both.pair.area += half.pair.area;
  add_terms(both.pair.bonds, half.pair.bonds);
  add_terms(both.pair.friction, half.pair.friction);
  both.shown = both.shown || half.shown;
}

} // namespace

std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact, const Communicator& ranks) {
  std::vector<HalfContact> halves = halves_of_own(model, contact, ranks);
  // The half at the first grain's nodes comes first, so that sums do not depend on which rank owns the grains.
  std::stable_sort(halves.begin(), halves.end(), [&](const HalfContact& a, const HalfContact& b) {
    return std::pair(grains_of(a), a.pair.first) < std::pair(grains_of(b), b.pair.first);
  });
  std::vector<PairContact> pairs;
  for (std::size_t i = 0; i < halves.size();) {
    const GrainPair grains = grains_of(halves[i]);
    HalfContact both{{grains.first, grains.second, {}, 0, {}, {}}};
    for (; i < halves.size() && grains_of(halves[i]) == grains; ++i) add_half(both, halves[i]);
    if (both.shown) pairs.push_back(both.pair);
  }
  return pairs;
}

} // namespace mpfem
