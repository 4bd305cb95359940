#include "solver/kernels/contact_forces.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

#include "common/prefetch.hpp"
#include "solver/kernels/contact_facet.hpp"
#include "solver/kernels/due_points.hpp"
#include "solver/physics/penalty.hpp"

namespace mpfem {

namespace {

/// What the points of one ordered pair of grains share in one evaluation.
struct PairOfGrains {
  std::size_t grain, other;
  double travel;            ///< mm, of both grains
  double limit;             ///< mm: travel up to which the candidates are valid
  double stiffness;         ///< MPa/mm, share of this pass
  double friction;          ///< mu
  std::int32_t first_point; ///< where the pair's records begin
  std::int32_t active = 0;  ///< records of forces so far
  std::int32_t pulling = 0; ///< records of bonds' forces so far
};

/// Evaluates the points of one grain's own nodes, with bonds or without, with friction or without.
template <bool bonding, bool has_friction>
class PointEvaluation {
public:
  PointEvaluation(Model& model, Contact& contact) : model_(model), contact_(contact) {}

  void evaluate(std::span<const std::int32_t> grains, std::span<ContactSums> sums) {
    const DuePoints due = due_points<bonding>(model_, contact_, grains);
    std::size_t next = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) sums[i] = evaluate_grain(at(grains[i]), due, next);
  }

private:
  /// `next`: the grain's first due point; afterwards that of the next grain.
  ContactSums evaluate_grain(std::size_t g, const DuePoints& due, std::size_t& next) {
    const ContactCandidates& candidates = contact_.candidates;
    ContactSums sums;
    for (std::int32_t p = candidates.outgoing_offset[g]; p < candidates.outgoing_offset[g + 1]; ++p) {
      PairOfGrains pair = begin_pair(g, p);
      const std::int32_t end = candidates.pair_point_offset[at(p) + 1];
      // The next due point may be another grain's, whose points may have lower numbers.
      for (; next < due.size() && due[next] >= pair.first_point && due[next] < end; ++next) {
        due.prefetch_ahead_of(next);
        evaluate_point(pair, due[next], sums);
      }
      contact_.active[at(p)] = pair.active;
      if constexpr (bonding) contact_.pulling[at(p)] = pair.pulling;
    }
    sums.penetration = sums.depth / model_.element_size[g];
    return sums;
  }

  PairOfGrains begin_pair(std::size_t g, std::int32_t pair) const {
    const ContactCandidates& candidates = contact_.candidates;
    const std::size_t other = at(candidates.pair_second[at(pair)]);
    return {.grain = g,
            .other = other,
            .travel = contact_.travel[g] + contact_.travel[other],
            .limit = contact_.travel_at_search[g] + contact_.travel_at_search[other] + contact_.margin,
            .stiffness = pass_stiffness(model_.penalty_stiffness[g], model_.penalty_stiffness[other]),
            .friction = has_friction ? friction_of(g, other) : 0.0,
            .first_point = candidates.pair_point_offset[at(pair)]};
  }

  double friction_of(std::size_t grain, std::size_t other) const {
    return contact_.friction.of(at(model_.grain_material[grain]), at(model_.grain_material[other]));
  }

  void evaluate_point(PairOfGrains& pair, std::int32_t point, ContactSums& sums) {
    const std::int32_t node = contact_.candidates.point_node[at(point)];
    const Vector3<double> x = model_.contact_point(at(node));
    if constexpr (bonding) {
      // The mode in which damage begins depends on the gap. A damaged bond needs no gap, so that of an open point is
      // not evaluated.
      PointBond& bond = contact_.bond[at(point)];
      if (bond.state.initiation > 0 && pair.travel < contact_.point_open_until[at(point)]) {
        pull(pair, bond, node, x, contact_.margin);
        return;
      }
    }
    // 1. The closest facet.
    const std::int32_t facet = update_closest_facet(pair, point, x);
    if (bonding && facet < 0) return evaluate_far_bond(pair, point, node, x);
    const Facet geometry = facet_geometry(model_, facet);
    const ClosestPoint<double> closest = closest_point_on_triangle(x, geometry.x);
    const Vector3<double> offset = x - closest.point;
    const double distance = norm(offset);
    // 2. Outside.
    if (distance == 0 || is_outside(pair, point, offset, distance, closest, geometry)) {
      if constexpr (has_friction) release_friction(point, closest.point, sums);
      return evaluate_open_point(pair, point, node, x, distance);
    }
    // 3. Inside: pushed back to the closest point. The part of the push that a bond carries is not left to the penalty.
    const double k = pair.stiffness * model_.local_stiffness(at(node)) * model_.reference_area[at(node)];
    double pushed = k;
    if constexpr (bonding)
      pushed *= evaluate_closed_bond(pair, contact_.bond[at(point)], node, x, facet, closest, distance);
    ContactForce& record = contact_.force[at(pair.first_point + pair.active++)];
    if (has_friction && pair.friction > 0) {
      record = evaluate_friction({x, facet, geometry.x, closest, distance, motion(point, closest, geometry)}, geometry,
                                 point, pair.friction, k, pushed, sums);
    } else {
      if constexpr (has_friction) take_anchor(point); // a branch may have taken the pair's friction away
      record = make_record(penalty_force(pushed, offset), closest.weight1, closest.weight2, std::abs(pushed), node,
                           geometry);
    }
    model_.push_contact_point(at(node), vector_of(record.force));
    sums.energy += penalty_energy(k, distance);
    if (distance > sums.depth) {
      sums.depth = distance;
      sums.deepest_in = static_cast<std::int32_t>(pair.other);
    }
  }

  /// Whether a point is on the outer side of the other grain's surface. Facets that the search left out are farther
  /// away than its margin less the travel since; a point beyond that may be closest to a corner where such facets
  /// meet.
  bool is_outside(const PairOfGrains& pair, std::int32_t point, const Vector3<double>& offset, double distance,
                  const ClosestPoint<double>& closest, const Facet& facet) const {
    if (closest.between == interior || distance < pair.limit - pair.travel)
      return mpfem::is_outside(model_, offset, closest, facet, candidates_of(point));
    return mpfem::is_outside(model_, offset, closest, facet,
                             std::views::iota(model_.facet_offset[pair.other], model_.facet_offset[pair.other + 1]));
  }

  /// The facets that may be closest to a point.
  std::span<const std::int32_t> candidates_of(std::int32_t point) const {
    const std::vector<std::int32_t>& offset = contact_.candidates.point_facet_offset;
    const std::int32_t first = offset[at(point)];
    return {contact_.candidates.point_facet.data() + first, static_cast<std::size_t>(offset[at(point) + 1] - first)};
  }

  /// The facet stays the closest until the travel of both grains could make up its lead on the second closest.
  std::int32_t update_closest_facet(const PairOfGrains& pair, std::int32_t point, const Vector3<double>& x) {
    std::int32_t& facet = contact_.point_facet[at(point)];
    if (facet >= 0 && pair.travel < contact_.point_facet_until[at(point)]) return facet;
    const ClosestFacet closest = closest_facet(model_, x, candidates_of(point));
    facet = closest.facet;
    // Facets that are not candidates were farther away than the margin at the search.
    const double others = std::min(closest.second_distance, pair.limit - pair.travel);
    contact_.point_facet_until[at(point)] = facet < 0 ? pair.limit : pair.travel + 0.5 * (others - closest.distance);
    return facet;
  }

  /// A point that is kept only for its bond: the other surface is farther away than the margin.
  void evaluate_far_bond(PairOfGrains& pair, std::int32_t point, std::int32_t node, const Vector3<double>& x) {
    contact_.point_open_until[at(point)] = pair.limit;
    PointBond& bond = contact_.bond[at(point)];
    if (bond.intact()) pull(pair, bond, node, x, pair.limit - pair.travel);
  }

  /// A point whose gap is open by `distance` (mm): it stays open until the grains could have met.
  void evaluate_open_point(PairOfGrains& pair, std::int32_t point, std::int32_t node, const Vector3<double>& x,
                           double distance) {
    contact_.point_open_until[at(point)] = std::min(pair.travel + distance, pair.limit);
    if constexpr (bonding) {
      PointBond& bond = contact_.bond[at(point)];
      if (bond.intact()) {
        pull(pair, bond, node, x, distance);
      } else if (bond.exists() && contact_.rebond_on_contact) {
        PointBond none;
        none.law = bond.law;
        none.dissipated_before = bond.dissipated_before + contact_.bond_laws[at(bond.law)].fracture_energy;
        bond = none;
      }
    }
  }

  /// Updates the bond of a point that is closed by `distance` (mm) at the closest point of `facet`, or forms it if
  /// there is none. Returns the part of the penalty that the bond leaves to the point.
  double evaluate_closed_bond(PairOfGrains& pair, PointBond& bond, std::int32_t node, const Vector3<double>& x,
                              std::int32_t facet, const ClosestPoint<double>& closest, double distance) {
    const bool normal_only = contact_.bond_laws.back().normal_only;
    if (!bond.exists()) bond.law = static_cast<std::int32_t>(contact_.bond_laws.size()) - 1;
    if (!bond.exists() || (normal_only && bond.intact())) {
      bond.facet = facet;
      bond.weight1 = closest.weight1, bond.weight2 = closest.weight2;
    }
    if (normal_only) {
      bond.opening = bond.separation = 0;
      return 1.0;
    }
    return bond.intact() ? pull(pair, bond, node, x, -distance) : 1.0;
  }

  /// Updates a bond to the current position of its node and records its force. `gap` in mm, negative inside. Returns
  /// the part of the penalty that the bond leaves to a closed point.
  double pull(PairOfGrains& pair, PointBond& bond, std::int32_t node, const Vector3<double>& x, double gap) {
    const Facet facet = facet_geometry(model_, bond.facet);
    const double penalty = 2 * pair.stiffness * model_.local_stiffness(at(node)); // of both passes
    const BondLaw law = bond_law(contact_, bond, penalty);
    const double k = 0.5 * law.stiffness * model_.reference_area[at(node)]; // of this pass
    const BondPull pull =
        law.normal_only ? pull_of_normal_bond(law, bond, x, facet.x) : pull_of_bond(law, bond, x, facet.x, gap);
    ContactForce& record = contact_.bond_force[at(pair.first_point + pair.pulling++)];
    record = make_record(k * pull.pull, pull.weight1, pull.weight2, bond.remaining * k, node, facet);
    model_.push_contact_point(at(node), vector_of(record.force));
    return penalty_left_by_bond(law, bond, penalty);
  }

  /// The force of a closed point with friction (Coulomb's `coefficient`): one spring between the node and its anchor.
  /// `penalty` is k, `pushed` what a bond leaves of it, N/mm. In a branch, bonds of an earlier law may be stiffer than
  /// the penalty: until they are damaged, nothing rubs.
  ContactForce evaluate_friction(const ClosedPoint& closed, const Facet& closest_facet, std::int32_t point,
                                 double coefficient, double penalty, double pushed, ContactSums& sums) {
    PointFriction& friction = contact_.point_friction[at(point)];
    double share = 1.0; // of the point that rubs
    if constexpr (bonding) share -= contact_.bond[at(point)].remaining;
    const bool elsewhere = friction.exists() && friction.facet != closed.facet;
    const Facet anchor = elsewhere ? facet_geometry(model_, friction.facet) : closest_facet;
    const FrictionStep step = advance_friction(
        friction, friction_spring(friction, share * coefficient, penalty, std::max(pushed, 0.0)), closed, anchor.x);
    sums.friction_energy += step.stored;
    sums.friction_dissipation += step.dissipated;
    return make_record(-(pushed * step.reach), friction.weight1, friction.weight2, std::abs(pushed),
                       contact_.candidates.point_node[at(point)], step.on_closest ? closest_facet : anchor);
  }

  /// mm, motion of a point's node relative to its closest point in the last step; 0 if friction already has an anchor.
  Vector3<double> motion(std::int32_t point, const ClosestPoint<double>& closest, const Facet& facet) const {
    if (contact_.point_friction[at(point)].exists()) return {0, 0, 0};
    const std::size_t node = at(contact_.candidates.point_node[at(point)]);
    const Vector3<double> v[3] = {model_.velocity_of(at(facet.node[0])), model_.velocity_of(at(facet.node[1])),
                                  model_.velocity_of(at(facet.node[2]))};
    return contact_.last_step * (model_.contact_velocity(node) - facet_point(v, closest.weight1, closest.weight2));
  }

  void take_anchor(std::int32_t point) {
    PointFriction& friction = contact_.point_friction[at(point)];
    if (friction.exists()) friction = without_anchor(friction);
  }

  /// Forgets the anchor of a point that has opened.
  void release_friction(std::int32_t point, const Vector3<double>& closest, ContactSums& sums) {
    PointFriction& friction = contact_.point_friction[at(point)];
    if (friction.exists())
      sums.friction_dissipation += release(friction, closest, facet_geometry(model_, friction.facet).x);
  }

  static ContactForce make_record(const Vector3<double>& force, double weight1, double weight2, double stiffness,
                                  std::int32_t node, const Facet& facet) {
    return {
        {force.x, force.y, force.z}, weight1, weight2, stiffness, node, {facet.node[0], facet.node[1], facet.node[2]}};
  }

  Model& model_;
  Contact& contact_;
};

/// Forces whose reactions act on the facets of these grains, in a fixed order, prefetched.
std::vector<const ContactForce*> prefetched_reactions(const Contact& contact, std::span<const std::int32_t> grains) {
  const ContactCandidates& candidates = contact.candidates;
  std::vector<const ContactForce*> records;
  const auto list = [&records](std::span<const ContactForce> points) {
    for (const ContactForce& point : points) {
      prefetch(&point);
      records.push_back(&point);
    }
  };
  for (const std::int32_t grain : grains)
    for (std::int32_t i = candidates.incoming_offset[at(grain)]; i < candidates.incoming_offset[at(grain) + 1]; ++i) {
      list(contact.active_points(candidates.incoming_pair[at(i)]));
      list(contact.pulling_bonds(candidates.incoming_pair[at(i)]));
    }
  return records;
}

} // namespace

void contact_forces(Model& model, Contact& contact, std::span<const std::int32_t> grains, std::span<ContactSums> sums) {
  if (contact.has_friction()) {
    if (contact.bonding()) return PointEvaluation<true, true>(model, contact).evaluate(grains, sums);
    return PointEvaluation<false, true>(model, contact).evaluate(grains, sums);
  }
  if (contact.bonding()) return PointEvaluation<true, false>(model, contact).evaluate(grains, sums);
  return PointEvaluation<false, false>(model, contact).evaluate(grains, sums);
}

ContactSums contact_forces(Model& model, Contact& contact, std::int32_t grain) {
  ContactSums sums;
  contact_forces(model, contact, std::span(&grain, 1), std::span(&sums, 1));
  return sums;
}

void contact_reactions(Model& model, const Contact& contact, std::span<const std::int32_t> grains) {
  // Records of other grains' points lie scattered, and so do the rows that they act on: both are prefetched, the rows
  // once their records have arrived.
  constexpr std::size_t ahead = 8;
  const std::vector<const ContactForce*> records = prefetched_reactions(contact, grains);
  const auto prefetch_rows = [&](std::size_t i) {
    if (i >= records.size()) return;
    for (const std::int32_t node : records[i]->facet_node) prefetch_for_writing(&model.force[4 * at(node)]);
  };
  for (std::size_t i = 0; i < ahead; ++i) prefetch_rows(i);
  for (std::size_t i = 0; i < records.size(); ++i) {
    prefetch_rows(i + ahead);
    const ContactForce& point = *records[i];
    for (int c = 0; c < 3; ++c) {
      double* force = model.force.data() + 4 * at(point.facet_node[c]);
      for (int axis = 0; axis < 3; ++axis) force[axis] -= point.weight(c) * point.force[axis];
    }
  }
}

} // namespace mpfem
