#include "solver/kernels/contact_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/model/smooth_surface.hpp"
#include "solver/physics/gap.hpp"

namespace mpfem {

namespace {

std::size_t at(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

Vector3<double> row(const AlignedVector<double>& rows, std::int32_t node) {
  const double* r = rows.data() + 4 * at(node);
  return {r[0], r[1], r[2]};
}

struct Facet {
  std::int32_t node[3];
  Vector3<double> x[3];
};

Facet facet_geometry(const Model& model, std::int32_t facet) {
  Facet result;
  for (int c = 0; c < 3; ++c) {
    const std::int32_t node = result.node[c] = model.facet[3 * at(facet) + static_cast<std::size_t>(c)];
    result.x[c] = row(model.position, node);
  }
  return result;
}

/// True where a node is on the outer side of the facet's surface. `offset` is node minus closest point. Nodal normals, in
/// memory of their own, are asked for where the closest point is on an edge or corner only.
bool is_outside(const Model& model, const Vector3<double>& offset, const ClosestPoint<double>& closest,
                const Facet& facet) {
  if (closest.inside) return dot(offset, facet_direction(facet.x)) >= 0;
  const Vector3<double> normal[3] = {row(model.normal, facet.node[0]), row(model.normal, facet.node[1]),
                                     row(model.normal, facet.node[2])};
  return dot(offset, edge_direction(closest, normal)) >= 0;
}

/// The closest of the candidate facets, and by how much the second closest is further.
struct Nearest {
  std::int32_t facet = -1;
  double distance = std::numeric_limits<double>::infinity();        ///< mm
  double second_distance = std::numeric_limits<double>::infinity(); ///< mm
};

Nearest nearest_facet(const Model& model, const Vector3<double>& node, std::span<const std::int32_t> facets) {
  Nearest nearest;
  for (const std::int32_t facet : facets) {
    const Facet geometry = facet_geometry(model, facet);
    const double distance = norm(node - closest_point_on_triangle(node, geometry.x).point);
    if (distance < nearest.distance) {
      nearest.second_distance = nearest.distance;
      nearest.distance = distance;
      nearest.facet = facet;
    } else {
      nearest.second_distance = std::min(nearest.second_distance, distance);
    }
  }
  return nearest;
}

/// Adds to new candidates the points of the old ones that have, or had, a bond, and carries the bonds over.
void keep_bonded_points(const ContactCandidates& old, const std::vector<PointBond>& old_bond, int grains,
                        ContactCandidates& candidates, std::vector<PointBond>& bond) {
  using Pair = std::pair<std::int32_t, std::int32_t>;
  const ContactCandidates found = std::move(candidates);
  candidates = {};
  bond.clear();
  candidates.pair_point_offset.push_back(0);
  candidates.point_facet_offset.push_back(0);
  const auto is_kept = [&](std::int32_t point) {
    return old_bond[at(point)].exists() || old_bond[at(point)].spent > 0;
  };
  const auto pair_of = [](const ContactCandidates& c, std::size_t p) {
    return Pair(c.pair_first[p], c.pair_second[p]);
  };
  std::size_t p = 0, q = 0; // next pair of found, of old
  while (p < found.pair_first.size() || q < old.pair_first.size()) {
    const bool has_found = p < found.pair_first.size(), has_old = q < old.pair_first.size();
    const Pair pair = !has_old     ? pair_of(found, p)
                      : !has_found ? pair_of(old, q)
                                   : std::min(pair_of(found, p), pair_of(old, q));
    std::int32_t i = 0, i_end = 0, j = 0, j_end = 0;
    if (has_found && pair_of(found, p) == pair)
      i = found.pair_point_offset[p], i_end = found.pair_point_offset[p + 1], ++p;
    if (has_old && pair_of(old, q) == pair) j = old.pair_point_offset[q], j_end = old.pair_point_offset[q + 1], ++q;
    const std::size_t before = candidates.point_node.size();
    while (i < i_end || j < j_end) {
      if (j < j_end && !is_kept(j)) {
        ++j;
        continue;
      }
      const std::int32_t found_node = i < i_end ? found.point_node[at(i)] : std::numeric_limits<std::int32_t>::max();
      const std::int32_t old_node = j < j_end ? old.point_node[at(j)] : std::numeric_limits<std::int32_t>::max();
      candidates.point_node.push_back(std::min(found_node, old_node));
      bond.push_back(old_node <= found_node ? old_bond[at(j)] : PointBond{});
      if (found_node <= old_node) {
        candidates.point_facet.insert(candidates.point_facet.end(),
                                      found.point_facet.begin() + found.point_facet_offset[at(i)],
                                      found.point_facet.begin() + found.point_facet_offset[at(i) + 1]);
        ++i;
      }
      if (old_node <= found_node) ++j;
      candidates.point_facet_offset.push_back(static_cast<std::int32_t>(candidates.point_facet.size()));
    }
    if (candidates.point_node.size() == before) continue;
    candidates.pair_first.push_back(pair.first);
    candidates.pair_second.push_back(pair.second);
    candidates.pair_point_offset.push_back(static_cast<std::int32_t>(candidates.point_node.size()));
  }
  index_pairs(candidates, grains);
}

} // namespace

void renew_candidates(const Model& model, double margin, ThreadTeam& team, Contact& contact) {
  // Nodes are looked for; their contact points lie behind them, and travel counts from where they are now.
  ContactCandidates candidates = find_contact_candidates(model.surface(), margin + largest_stand_out(model), team);
  if (contact.bonding()) {
    std::vector<PointBond> bond;
    keep_bonded_points(contact.candidates, contact.bond, model.grains, candidates, bond);
    contact.bond = std::move(bond);
    contact.bond_force = {};
    contact.bond_force.resize(contact.bond.size());
    contact.pulling.assign(candidates.pair_first.size(), 0);
  }
  contact.candidates = std::move(candidates);
  contact.margin = margin;
  const std::size_t points = contact.candidates.point_node.size();
  contact.point_facet.assign(points, -1);
  contact.point_wake.assign(points, -1.0);
  contact.point_sure.assign(points, -1.0);
  contact.force = {}; // before its successor: never both in memory
  contact.force.resize(points);
  contact.active.assign(contact.candidates.pair_first.size(), 0);
  if (contact.travel.empty()) contact.travel.assign(static_cast<std::size_t>(model.grains), 0.0);
  contact.travel_at_search = contact.travel;
}

bool search_is_due(const Contact& contact) {
  double largest = 0;
  for (std::size_t g = 0; g < contact.travel.size(); ++g)
    largest = std::max(largest, contact.travel[g] - contact.travel_at_search[g]);
  return 2.0 * largest > 0.9 * contact.margin;
}

namespace {

/// Half of the harmonic mean of both grains' penalties: a pass's share, MPa/mm.
double pass_stiffness(const Model& model, std::size_t first, std::size_t second) {
  const double a = model.penalty_stiffness[first], b = model.penalty_stiffness[second];
  return a * b / (a + b);
}

/// Adds a force to its node's contact point.
void act_on_node(Model& model, const ContactForce& record) {
  for (std::size_t axis = 0; axis < 3; ++axis) model.push_contact_point(at(record.node), axis, record.force[axis]);
}

ContactForce bond_record(const BondPull& pull, double stiffness, std::int32_t node, const PointBond& bond,
                         const Facet& facet) {
  return {{stiffness * pull.pull.x, stiffness * pull.pull.y, stiffness * pull.pull.z},
          pull.weight1,
          pull.weight2,
          bond.remaining * stiffness,
          node,
          {facet.node[0], facet.node[1], facet.node[2]}};
}

/// The points of a grain that must be looked at in this step, and their data asked for in time. What a point needs lies
/// scattered over the memory of two grains, and waiting for it one piece after the other was two thirds of the time of
/// contact. So the awake points are listed first, and what their indices point at is asked for; when a point's turn is a
/// few points away, that has come, and the nodes of its facet are asked for.
class AwakePoints {
public:
  AwakePoints(const Model& model, const Contact& contact, std::size_t expected) : model_(model), contact_(contact) {
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
    ask_for_facet(contact_.point_facet[at(point)]);
    if (const std::int32_t facet = bond_facet(point); facet != contact_.point_facet[at(point)]) ask_for_facet(facet);
  }
  /// To be called when it is the turn of point i.
  void look_ahead_from(std::size_t i) const {
    constexpr std::size_t ahead = 4;
    if (i + ahead >= points_.size()) return;
    const std::int32_t point = points_[i + ahead], facet = contact_.point_facet[at(point)];
    ask_for_nodes(facet);
    if (const std::int32_t other = bond_facet(point); other != facet) ask_for_nodes(other);
  }

private:
  std::int32_t bond_facet(std::int32_t point) const {
    return contact_.bond.empty() ? -1 : contact_.bond[at(point)].facet;
  }
  void ask_for_facet(std::int32_t facet) const {
    if (facet >= 0) __builtin_prefetch(&model_.facet[3 * at(facet)]);
  }
  void ask_for_nodes(std::int32_t facet) const {
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

/// Points of a grain's own nodes whose gap may have closed, or whose bond holds.
template <bool bonding>
AwakePoints awake_points(const Model& model, const Contact& contact, int grain) {
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first_pair = candidates.outgoing_offset[g], end_pair = candidates.outgoing_offset[g + 1];
  AwakePoints awake(model, contact,
                    static_cast<std::size_t>(candidates.pair_point_offset[at(end_pair)] -
                                             candidates.pair_point_offset[at(first_pair)]));
  for (std::int32_t pair = first_pair; pair < end_pair; ++pair) {
    const double travel = contact.travel[g] + contact.travel[at(candidates.pair_second[at(pair)])];
    for (std::int32_t point = candidates.pair_point_offset[at(pair)];
         point < candidates.pair_point_offset[at(pair) + 1]; ++point)
      if (travel >= contact.point_wake[at(point)] || (bonding && contact.bond[at(point)].intact())) awake.add(point);
  }
  return awake;
}

template <bool bonding>
ContactSums forces_of_points(Model& model, Contact& contact, int grain) {
  const ContactCandidates& candidates = contact.candidates;
  ContactSums sums;
  const auto g = static_cast<std::size_t>(grain);
  const double h = model.element_size[g];
  const AwakePoints awake = awake_points<bonding>(model, contact, grain);
  std::size_t next = 0;
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair) {
    const std::int32_t other_grain = candidates.pair_second[at(pair)];
    const std::size_t other = at(other_grain);
    const double travel = contact.travel[g] + contact.travel[other];
    const double limit = contact.travel_at_search[g] + contact.travel_at_search[other] + contact.margin;
    const double stiffness = pass_stiffness(model, g, other);
    const std::int32_t begin = candidates.pair_point_offset[at(pair)], end = candidates.pair_point_offset[at(pair) + 1];
    std::int32_t active = 0, pulling = 0;
    const bool normal_only = bonding && contact.bond_laws.back().normal_only;
    const auto pull = [&](PointBond& bond, std::int32_t node_index, const Vector3<double>& node, double gap) {
      const Facet facet = facet_geometry(model, bond.facet);
      const double share = stiffness * model.local_stiffness(at(node_index)); // of this pass
      const double k = share * model.reference_area[at(node_index)];
      const BondLaw law = bond_law(contact, bond, 2 * share);
      ContactForce& record = contact.bond_force[at(begin + pulling++)];
      record = bond_record(normal_only ? pull_of_normal_bond(law, bond, node, facet.x)
                                       : pull_of_bond(law, bond, node, facet.x, gap),
                           k, node_index, bond, facet);
      act_on_node(model, record);
    };
    for (; next < awake.size() && awake[next] < end; ++next) {
      awake.look_ahead_from(next);
      const std::int32_t point = awake[next];
      const std::int32_t node_index = candidates.point_node[at(point)];
      if constexpr (bonding) {
        // The mode in which damage begins depends on the gap; later on a bond needs none, and the gap may sleep.
        PointBond& bond = contact.bond[at(point)];
        if (bond.state.initiation > 0 && travel < contact.point_wake[at(point)]) {
          pull(bond, node_index, model.contact_point(at(node_index)), contact.margin);
          continue;
        }
      }
      const Vector3<double> node = model.contact_point(at(node_index));
      // 1. The closest facet. It stays the closest until both grains' travel could make up its lead on the second.
      std::int32_t& facet = contact.point_facet[at(point)];
      if (facet < 0 || travel >= contact.point_sure[at(point)]) {
        const std::int32_t first = candidates.point_facet_offset[at(point)],
                           last = candidates.point_facet_offset[at(point) + 1];
        const Nearest nearest =
            nearest_facet(model, node, {candidates.point_facet.data() + first, static_cast<std::size_t>(last - first)});
        facet = nearest.facet;
        // Facets that are no candidates were further than the margin at the search.
        const double others = std::min(nearest.second_distance, limit - travel);
        contact.point_sure[at(point)] = facet < 0 ? limit : travel + 0.5 * (others - nearest.distance);
      }
      if (bonding && facet < 0) { // kept for its bond alone: the other surface is further than the margin
        contact.point_wake[at(point)] = limit;
        if (contact.bond[at(point)].intact()) pull(contact.bond[at(point)], node_index, node, limit - travel);
        continue;
      }
      const Facet geometry = facet_geometry(model, facet);
      const ClosestPoint<double> closest = closest_point_on_triangle(node, geometry.x);
      const Vector3<double> offset = node - closest.point;
      const double distance = norm(offset);
      // 2. Outside: asleep until the grains could have met.
      if (distance == 0 || is_outside(model, offset, closest, geometry)) {
        contact.point_wake[at(point)] = std::min(travel + distance, limit);
        if constexpr (bonding) {
          PointBond& bond = contact.bond[at(point)];
          if (bond.intact()) {
            pull(bond, node_index, node, distance);
          } else if (bond.exists() && contact.rebond_on_contact) {
            PointBond none;
            none.law = bond.law;
            none.spent = bond.spent + contact.bond_laws[at(bond.law)].fracture_energy;
            bond = none;
          }
        }
        continue;
      }
      if (distance > 0.9 * contact.margin)
        throw SimulationError(
            fmt::format("contact: a node of grain {} is {:.3g} mm inside grain {}, allowed up to {:.3g} "
                        "mm: raise contact.stiffness_factor or lower the speed",
                        grain, distance, other, 0.9 * contact.margin));
      // 3. Inside: pushed back to the closest point. What an unbroken bond holds of the point, it holds itself.
      const double k = stiffness * model.local_stiffness(at(node_index)) * model.reference_area[at(node_index)];
      double pushed = k;
      if constexpr (bonding) {
        PointBond& bond = contact.bond[at(point)];
        if (!bond.exists()) bond.law = static_cast<std::int32_t>(contact.bond_laws.size()) - 1;
        if (!bond.exists() || (normal_only && bond.intact())) {
          bond.facet = facet;
          bond.weight1 = closest.weight1, bond.weight2 = closest.weight2;
        }
        if (normal_only) {
          bond.opening = bond.separation = 0;
        } else if (bond.intact()) {
          pull(bond, node_index, node, -distance);
          pushed *= 1.0 - bond.remaining;
        }
      }
      const Vector3<double> push = -(pushed * offset);
      ContactForce& record = contact.force[at(begin + active++)];
      record = {{push.x, push.y, push.z},
                closest.weight1,
                closest.weight2,
                pushed,
                node_index,
                {geometry.node[0], geometry.node[1], geometry.node[2]}};
      act_on_node(model, record);
      sums.energy += 0.5 * k * distance * distance;
      sums.penetration = std::max(sums.penetration, distance / h);
    }
    contact.active[at(pair)] = active;
    if constexpr (bonding) contact.pulling[at(pair)] = pulling;
    sums.active_points += active;
  }
  return sums;
}

} // namespace

BondLaw law_of_bonds(const BondParameters& parameters) {
  return {.stiffness = 0,
          .tensile_strength = parameters.tensile_strength,
          .shear_strength = parameters.shear_strength,
          .fracture_energy = parameters.fracture_energy,
          .softening = parameters.softening,
          .normal_only = parameters.normal_only};
}

ContactSums contact_forces(Model& model, Contact& contact, int grain) {
  return contact.bonding() ? forces_of_points<true>(model, contact, grain)
                           : forces_of_points<false>(model, contact, grain);
}

void contact_reactions(Model& model, const Contact& contact, int grain) {
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  const auto react = [&model](std::span<const ContactForce> points) {
    for (const ContactForce& point : points)
      for (int c = 0; c < 3; ++c) {
        double* force = model.force.data() + 4 * at(point.facet_node[c]);
        for (int axis = 0; axis < 3; ++axis) force[axis] -= point.weight(c) * point.force[axis];
      }
  };
  const std::int32_t end = candidates.incoming_offset[g + 1];
  for (std::int32_t i = candidates.incoming_offset[g]; i < end; ++i) {
    if (i + 2 < end) // the first points of the pair after the next; the others follow in order
      for (const auto points : {contact.active_points(candidates.incoming_pair[at(i + 2)]),
                                contact.pulling_bonds(candidates.incoming_pair[at(i + 2)])})
        for (std::size_t p = 0; p < std::min<std::size_t>(points.size(), 4); ++p) __builtin_prefetch(&points[p]);
    react(contact.active_points(candidates.incoming_pair[at(i)]));
    react(contact.pulling_bonds(candidates.incoming_pair[at(i)]));
  }
}

double contact_area(const Model& model, const Contact& contact, int grain) {
  double area = 0;
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair)
    for (const ContactForce& point : contact.active_points(pair)) area += model.normal[4 * at(point.node) + 3];
  return area;
}

void contact_stiffness_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate) {
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.node_offset[g];
  std::fill(rate.begin() + first, rate.begin() + model.node_offset[g + 1], 0.0);
  const auto add = [&](std::int32_t node, double stiffness) {
    rate[at(node)] += stiffness * model.inverse_mass[at(node)];
  };
  const auto share = [](const ContactForce& point) {
    return (1.0 + std::abs(point.weight(0)) + std::abs(point.weight(1)) + std::abs(point.weight(2))) * point.stiffness;
  };
  // Weights of a point beneath an opened bond may lie outside the facet: their magnitudes bound what they add. With W the sum of
  // the magnitudes (1 inside), k (u - sum w_c u_c)^2 <= k (1 + W) (u^2 + sum |w_c| u_c^2).
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair)
    for (const auto points : {contact.active_points(pair), contact.pulling_bonds(pair)})
      for (const ContactForce& point : points) {
        add(point.node, share(point));
        if (!model.inner_node.empty())
          add(model.inner_node[at(point.node)], model.inward[at(point.node)] * share(point));
      }
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i) {
    const std::int32_t pair = candidates.incoming_pair[at(i)];
    for (const auto points : {contact.active_points(pair), contact.pulling_bonds(pair)})
      for (const ContactForce& point : points)
        for (int c = 0; c < 3; ++c) add(point.facet_node[c], std::abs(point.weight(c)) * share(point));
  }
}

namespace {

/// A node of a grain r times as coarse brings r^2/(1 + r) times what a grain expects of its like (the harmonic mean of both penalties,
/// r^2 times the area): below 1.5 that is less.
void raise_near_coarser_grains(const Model& model, const Contact& contact, int grain, std::span<double> rate) {
  constexpr double coarser = 1.5;
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i) {
    const std::size_t pair = at(candidates.incoming_pair[at(i)]), other = at(candidates.pair_first[pair]);
    if (model.element_size[other] < coarser * model.element_size[g]) continue;
    const double stiffness = pass_stiffness(model, other, g);
    for (std::int32_t p = candidates.pair_point_offset[pair]; p < candidates.pair_point_offset[pair + 1]; ++p) {
      const std::size_t node = at(candidates.point_node[at(p)]);
      const double k = stiffness * model.local_stiffness(node) * model.reference_area[node];
      for (std::int32_t f = candidates.point_facet_offset[at(p)]; f < candidates.point_facet_offset[at(p) + 1]; ++f)
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const std::size_t touched = at(model.facet[3 * at(candidates.point_facet[at(f)]) + corner]);
          rate[touched] = std::max(rate[touched], 2.0 * k * model.inverse_mass[touched]);
        }
    }
  }
}

/// Against a much stiffer neighbour a grain meets up to twice the stiffness that it meets in its like: the harmonic mean of
/// both penalties over its own. Contrasts below three, as those of sizes, are left to the estimates that follow.
double stiffness_contrast(const Model& model, const Contact& contact, int grain) {
  constexpr double noteworthy = 1.5;
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  double contrast = 1;
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i) {
    const std::size_t other = at(candidates.pair_first[at(candidates.incoming_pair[at(i)])]);
    const double mean = 2 * pass_stiffness(model, other, g) / model.penalty_stiffness[g];
    if (mean > noteworthy) contrast = std::max(contrast, mean);
  }
  return contrast;
}

} // namespace

void raise_to_expected_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.node_offset[g];
  const double contrast = stiffness_contrast(model, contact, grain);
  for (std::int32_t node = first; node < first + model.surface_node_count[g]; ++node) {
    // As a node with stiffness K/2 A and, by symmetry, a facet's share of the same size; against a wall K A alone.
    const double expected = contrast * 2.0 * model.penalty_stiffness[g] * model.local_stiffness(at(node)) *
                            model.reference_area[at(node)] * model.inverse_mass[at(node)];
    rate[at(node)] = std::max(rate[at(node)], expected);
  }
  raise_near_coarser_grains(model, contact, grain, rate);
}

BondSums bond_sums(const Model& model, const Contact& contact, std::int32_t pair) {
  BondSums sums;
  if (contact.bond.empty()) return sums;
  const ContactCandidates& candidates = contact.candidates;
  const double stiffness =
      2 * pass_stiffness(model, at(candidates.pair_first[at(pair)]), at(candidates.pair_second[at(pair)]));
  for (std::int32_t p = candidates.pair_point_offset[at(pair)]; p < candidates.pair_point_offset[at(pair) + 1]; ++p) {
    const PointBond& bond = contact.bond[at(p)];
    if (!bond.exists() && bond.spent == 0) continue;
    const double area = model.reference_area[at(candidates.point_node[at(p)])];
    const BondLaw law = bond_law(contact, bond, stiffness * model.local_stiffness(at(candidates.point_node[at(p)])));
    // Each of the two passes carries half of the traction, so half of the energy.
    const double share = 0.5 * area;
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

std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact) {
  std::map<std::pair<std::int32_t, std::int32_t>, PairContact> pairs;
  const ContactCandidates& candidates = contact.candidates;
  for (std::size_t p = 0; p < candidates.pair_first.size(); ++p) {
    const std::int32_t a = candidates.pair_first[p], b = candidates.pair_second[p];
    const auto pair = static_cast<std::int32_t>(p);
    const BondSums bonds = bond_sums(model, contact, pair);
    const auto touching = contact.active_points(pair), pulling = contact.pulling_bonds(pair);
    if (touching.empty() && bonds.formed_area == 0) continue;
    auto& entry =
        pairs.try_emplace({std::min(a, b), std::max(a, b)}, PairContact{std::min(a, b), std::max(a, b), {}, 0, {}})
            .first->second;
    const double sign = a < b ? 1.0 : -1.0;
    for (const auto points : {touching, pulling})
      for (const ContactForce& point : points)
        for (int axis = 0; axis < 3; ++axis) entry.force[axis] += sign * point.force[axis];
    for (const ContactForce& point : touching) entry.area += 0.5 * model.normal[4 * at(point.node) + 3];
    entry.bonds.add(bonds);
  }
  std::vector<PairContact> result;
  for (const auto& [key, pair] : pairs) result.push_back(pair);
  return result;
}

} // namespace mpfem
