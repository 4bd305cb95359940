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

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Vector3<double> row(const AlignedVector<double>& rows, std::int32_t node) {
  const double* r = rows.data() + 4 * at(node);
  return {r[0], r[1], r[2]};
}

/// Weights may exceed [0, 1] by rounding only, so that no node falls between two facets.
constexpr double weight_tolerance = 1e-9;

bool inside(const FacetProjection<double>& p) {
  return p.weight1 >= -weight_tolerance && p.weight2 >= -weight_tolerance &&
         p.weight1 + p.weight2 <= 1.0 + weight_tolerance;
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

/// Where a node meets a surface, if it does.
struct Met {
  std::int32_t facet = -1;
  FacetProjection<double> projection{};
  double distance = std::numeric_limits<double>::infinity(); ///< to the closest candidate, mm
};

/// Looks at all candidates: the facet whose projection holds the node, and the distance to the closest one. A node that
/// no projection holds though it lies behind its closest point (a sharp dent) is pushed back to that point.
Met scan(const Model& model, const Vector3<double>& node, std::span<const std::int32_t> facets, double depth) {
  Met met;
  double smallest_gap = std::numeric_limits<double>::infinity();
  std::int32_t closest_facet = -1;
  ClosestPoint<double> closest{};
  for (const std::int32_t facet : facets) {
    const Facet geometry = facet_geometry(model, facet);
    const auto candidate = closest_point_on_triangle(node, geometry.x);
    const double distance = norm(node - candidate.point);
    if (distance < met.distance) met.distance = distance, closest_facet = facet, closest = candidate;
    if (distance > depth) continue;
    const auto projection = project_on_facet(node, geometry.x, geometry.n);
    if (inside(projection) && std::abs(projection.gap) < std::min(smallest_gap, 2.0 * depth)) {
      smallest_gap = std::abs(projection.gap);
      met.facet = facet;
      met.projection = projection;
    }
  }
  if (met.facet < 0 && closest_facet >= 0 && met.distance < 0.5 * depth && met.distance > 0) {
    const Facet geometry = facet_geometry(model, closest_facet);
    const auto normal = geometry.n[0] + closest.weight1 * (geometry.n[1] - geometry.n[0]) +
                        closest.weight2 * (geometry.n[2] - geometry.n[0]);
    if (dot(node - closest.point, normal) < 0) {
      met.facet = closest_facet;
      met.projection = {closest.weight1, closest.weight2, -met.distance,
                        (1.0 / met.distance) * (closest.point - node)};
    }
  }
  return met;
}

} // namespace

void renew_candidates(const Model& model, double margin, ThreadTeam& team, Contact& contact) {
  contact.candidates = find_contact_candidates(model.surface(), margin, team);
  contact.margin = margin;
  const std::size_t points = contact.candidates.point_node.size();
  contact.point_facet.assign(points, -1);
  contact.point_wake.assign(points, -1.0);
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
  const double depth = contact.margin;
  for (std::int32_t pair = candidates.outgoing_offset[g]; pair < candidates.outgoing_offset[g + 1]; ++pair) {
    const std::size_t other = at(candidates.pair_second[at(pair)]);
    const double travel = contact.travel[g] + contact.travel[other];
    // Harmonic mean of both grains' penalties; half of it in each of the two passes.
    const double stiffness = model.penalty_stiffness[g] * model.penalty_stiffness[other] /
                             (model.penalty_stiffness[g] + model.penalty_stiffness[other]);
    const std::int32_t begin = candidates.pair_point_offset[at(pair)], end = candidates.pair_point_offset[at(pair) + 1];
    std::int32_t active = 0;
    for (std::int32_t point = begin; point < end; ++point) {
      if (travel < contact.point_wake[at(point)]) continue;
      const std::int32_t node_index = candidates.point_node[at(point)];
      const Vector3<double> node = row(model.position, node_index);
      std::int32_t facet = contact.point_facet[at(point)];
      FacetProjection<double> projection{};
      bool met = false;
      if (facet >= 0) {
        const Facet geometry = facet_geometry(model, facet);
        projection = project_on_facet(node, geometry.x, geometry.n);
        met = inside(projection) && projection.gap < 0.05 * h && projection.gap > -depth;
      }
      if (!met) {
        const std::int32_t first = candidates.point_facet_offset[at(point)],
                           last = candidates.point_facet_offset[at(point) + 1];
        const Met found = scan(model, node, {candidates.point_facet.data() + first, static_cast<std::size_t>(last - first)}, depth);
        facet = found.facet;
        projection = found.projection;
        contact.point_facet[at(point)] = facet;
        const bool away = facet < 0 || projection.gap >= 0;
        // Surfaces that are further apart than the travel of both grains need not be looked at before. Facets that are
        // no candidates were further than the margin at the search.
        if (away) {
          const double searched = contact.travel_at_search[g] + contact.travel_at_search[other];
          contact.point_wake[at(point)] = std::min(travel + found.distance, searched + contact.margin);
          continue;
        }
      }
      if (!(projection.gap < 0)) continue;
      if (projection.gap < -0.9 * depth)
        throw SimulationError(fmt::format("contact: a node of grain {} is {:.3g} mm inside grain {}, allowed up to {:.3g} "
                                          "mm: raise contact.stiffness_factor or lower the speed",
                                          grain, -projection.gap, other, 0.9 * depth));
      const double area = model.normal[4 * at(node_index) + 3];
      const double k = stiffness * area;
      const double magnitude = -k * projection.gap;
      ContactForce& record = contact.force[at(begin + active++)];
      record = {{magnitude * projection.normal.x, magnitude * projection.normal.y, magnitude * projection.normal.z},
                {1.0 - projection.weight1 - projection.weight2, projection.weight1, projection.weight2},
                k, node_index, facet};
      double* force = model.force.data() + 4 * at(node_index);
      for (int axis = 0; axis < 3; ++axis) force[axis] += record.force[axis];
      sums.energy += 0.5 * magnitude * -projection.gap;
      sums.area += area;
      sums.penetration = std::max(sums.penetration, -projection.gap / h);
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
  for (std::int32_t node = first; node < first + model.surface_node_count[g]; ++node) {
    // As a node with stiffness K/2 A and, by symmetry, a facet's share of the same size; against a wall K A alone.
    const double expected = 2.0 * model.penalty_stiffness[g] * model.normal[4 * at(node) + 3] * model.inverse_mass[at(node)];
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
    auto& entry = pairs.try_emplace({std::min(a, b), std::max(a, b)}, PairContact{std::min(a, b), std::max(a, b), {}, 0})
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
