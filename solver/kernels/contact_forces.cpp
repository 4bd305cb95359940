#include "solver/kernels/contact_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "common/errors.hpp"
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
  Vector3<double> x[3], n[3];
};

Facet facet_geometry(const Model& model, std::int32_t facet) {
  Facet result;
  for (int c = 0; c < 3; ++c) {
    const std::int32_t node = model.facet[3 * at(facet) + static_cast<std::size_t>(c)];
    result.x[c] = row(model.position, node);
    result.n[c] = row(model.normal, node);
  }
  return result;
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

} // namespace

void renew_candidates(const Model& model, double margin, ThreadTeam& team, Contact& contact) {
  contact.candidates = find_contact_candidates(model.surface(), margin, team);
  contact.margin = margin;
  const std::size_t points = contact.candidates.point_node.size();
  contact.point_facet.assign(points, -1);
  contact.point_wake.assign(points, -1.0);
  contact.point_sure.assign(points, -1.0);
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

ContactSums contact_forces(Model& model, Contact& contact, int grain) {
  const ContactCandidates& candidates = contact.candidates;
  ContactSums sums;
  const auto g = static_cast<std::size_t>(grain);
  const double h = model.element_size[g];
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair) {
    const std::size_t other = at(candidates.pair_second[at(pair)]);
    const double travel = contact.travel[g] + contact.travel[other];
    const double limit = contact.travel_at_search[g] + contact.travel_at_search[other] + contact.margin;
    // Harmonic mean of both grains' penalties; half of it in each of the two passes.
    const double stiffness = model.penalty_stiffness[g] * model.penalty_stiffness[other] /
                             (model.penalty_stiffness[g] + model.penalty_stiffness[other]);
    const std::int32_t begin = candidates.pair_point_offset[at(pair)], end = candidates.pair_point_offset[at(pair) + 1];
    std::int32_t active = 0;
    for (std::int32_t point = begin; point < end; ++point) {
      if (travel < contact.point_wake[at(point)]) continue;
      const std::int32_t node_index = candidates.point_node[at(point)];
      const Vector3<double> node = row(model.position, node_index);
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
        contact.point_sure[at(point)] = travel + 0.5 * (others - nearest.distance);
      }
      const Facet geometry = facet_geometry(model, facet);
      const ClosestPoint closest = closest_point_on_triangle(node, geometry.x);
      const Vector3<double> offset = node - closest.point;
      const double distance = norm(offset);
      // 2. Outside: asleep until the grains could have met.
      if (dot(offset, outward_direction(closest, geometry.x, geometry.n)) >= 0 || distance == 0) {
        contact.point_wake[at(point)] = std::min(travel + distance, limit);
        continue;
      }
      if (distance > 0.9 * contact.margin)
        throw SimulationError(
            fmt::format("contact: a node of grain {} is {:.3g} mm inside grain {}, allowed up to {:.3g} "
                        "mm: raise contact.stiffness_factor or lower the speed",
                        grain, distance, other, 0.9 * contact.margin));
      // 3. Inside: pushed back to the closest point.
      const double k = stiffness * model.reference_area[at(node_index)];
      const Vector3<double> push = -(k * offset);
      ContactForce& record = contact.force[at(begin + active++)];
      record = {{push.x, push.y, push.z},
                {1.0 - closest.weight1 - closest.weight2, closest.weight1, closest.weight2},
                k,
                node_index,
                facet};
      double* force = model.force.data() + 4 * at(node_index);
      for (int axis = 0; axis < 3; ++axis) force[axis] += record.force[axis];
      sums.energy += 0.5 * k * distance * distance;
      sums.area += model.normal[4 * at(node_index) + 3];
      sums.penetration = std::max(sums.penetration, distance / h);
    }
    contact.active[at(pair)] = active;
    sums.active_points += active;
  }
  return sums;
}

void contact_reactions(Model& model, const Contact& contact, int grain) {
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i) {
    for (const ContactForce& point : contact.active_points(candidates.incoming_pair[at(i)])) {
      for (std::size_t c = 0; c < 3; ++c) {
        double* force = model.force.data() + 4 * at(model.facet[3 * at(point.facet) + c]);
        for (int axis = 0; axis < 3; ++axis) force[axis] -= point.weight[c] * point.force[axis];
      }
    }
  }
}

void contact_stiffness_rate(const Model& model, const Contact& contact, int grain, std::span<double> rate) {
  const ContactCandidates& candidates = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.node_offset[g];
  std::fill(rate.begin() + first, rate.begin() + model.node_offset[g + 1], 0.0);
  const auto add = [&](std::int32_t node, double stiffness) {
    rate[at(node)] += 2.0 * stiffness * model.inverse_mass[at(node)];
  };
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair)
    for (const ContactForce& point : contact.active_points(pair)) add(point.node, point.stiffness);
  for (std::int32_t i = candidates.incoming_offset[g]; i < candidates.incoming_offset[g + 1]; ++i)
    for (const ContactForce& point : contact.active_points(candidates.incoming_pair[at(i)]))
      for (std::size_t c = 0; c < 3; ++c) add(model.facet[3 * at(point.facet) + c], point.weight[c] * point.stiffness);
}

void raise_to_expected_rate(const Model& model, int grain, std::span<double> rate) {
  const auto g = static_cast<std::size_t>(grain);
  const std::int32_t first = model.node_offset[g];
  for (std::int32_t node = first; node < first + model.surface_node_count[g]; ++node) {
    // As a node with stiffness K/2 A and, by symmetry, a facet's share of the same size; against a wall K A alone.
    const double expected =
        2.0 * model.penalty_stiffness[g] * model.reference_area[at(node)] * model.inverse_mass[at(node)];
    rate[at(node)] = std::max(rate[at(node)], expected);
  }
}

std::vector<PairContact> pair_contacts(const Model& model, const Contact& contact) {
  std::map<std::pair<std::int32_t, std::int32_t>, PairContact> pairs;
  const ContactCandidates& candidates = contact.candidates;
  for (std::size_t p = 0; p < candidates.pair_first.size(); ++p) {
    const std::int32_t a = candidates.pair_first[p], b = candidates.pair_second[p];
    const auto points = contact.active_points(static_cast<std::int32_t>(p));
    if (points.empty()) continue;
    auto& entry =
        pairs.try_emplace({std::min(a, b), std::max(a, b)}, PairContact{std::min(a, b), std::max(a, b), {}, 0})
            .first->second;
    const double sign = a < b ? 1.0 : -1.0;
    for (const ContactForce& point : points) {
      for (int axis = 0; axis < 3; ++axis) entry.force[axis] += sign * point.force[axis];
      entry.area += 0.5 * model.normal[4 * at(point.node) + 3];
    }
  }
  std::vector<PairContact> result;
  for (const auto& [key, pair] : pairs) result.push_back(pair);
  return result;
}

} // namespace mpfem
