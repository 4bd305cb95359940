#pragma once
// Facets of a model as contact sees them: gathered corners, the closest of several, and which side a node is on.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <ranges>
#include <span>

#include "common/index.hpp"
#include "solver/model/model.hpp"
#include "solver/physics/gap.hpp"

namespace mpfem {

/// A facet with the current positions of its nodes, mm.
struct Facet {
  std::int32_t node[3];
  Vector3<double> x[3];
};

/// Gathers a facet's corners.
inline Facet facet_geometry(const Model& model, std::int32_t facet) {
  Facet result;
  for (int c = 0; c < 3; ++c) {
    const std::int32_t node = result.node[c] = model.facet[3 * at(facet) + static_cast<std::size_t>(c)];
    result.x[c] = model.point(at(node));
  }
  return result;
}

/// The corners of `facet` that are also corners of `other`, there among `some`.
inline Corners shared_corners(const std::int32_t* facet, const Facet& other, Corners some) {
  Corners shared = 0;
  for (unsigned c = 0; c < 3; ++c)
    for (unsigned i = 0; i < 3; ++i)
      if ((some >> i & 1U) != 0 && facet[c] == other.node[i]) shared |= 1U << c;
  return shared;
}

/// Outward direction (rad) on an edge or at a corner of a facet, `place`. `facets` must contain those that meet there.
template <std::ranges::range Facets>
Vector3<double> direction_at(const Model& model, const Facet& facet, Corners place, const Facets& facets) {
  Vector3<double> direction{0, 0, 0};
  for (const std::int32_t other : facets) {
    const Corners shared = shared_corners(&model.facet[3 * at(other)], facet, place);
    if (std::popcount(shared) != std::popcount(place)) continue;
    direction = direction + share_of_direction(facet_geometry(model, other).x, shared);
  }
  return direction;
}

/// True if a node is on the outer side of the facet's surface. `offset` is node minus closest point, mm. `facets` must
/// contain all facets of the surface that meet at the closest point.
template <std::ranges::range Facets>
bool is_outside(const Model& model, const Vector3<double>& offset, const ClosestPoint<double>& closest,
                const Facet& facet, const Facets& facets) {
  const Corners place = closest.between;
  return dot(offset, place == interior ? facet_direction(facet.x) : direction_at(model, facet, place, facets)) >= 0;
}

/// The closest of some facets, and the distance of the second closest.
struct ClosestFacet {
  std::int32_t facet = -1;                                          ///< -1 where there are none
  double distance = std::numeric_limits<double>::infinity();        ///< mm
  double second_distance = std::numeric_limits<double>::infinity(); ///< mm
};

/// The facet of `facets` that is closest to a node at `node` (mm).
inline ClosestFacet closest_facet(const Model& model, const Vector3<double>& node,
                                  std::span<const std::int32_t> facets) {
  ClosestFacet closest;
  for (const std::int32_t facet : facets) {
    const Facet geometry = facet_geometry(model, facet);
    const double distance = norm(node - closest_point_on_triangle(node, geometry.x).point);
    if (distance < closest.distance) {
      closest.second_distance = closest.distance;
      closest.distance = distance;
      closest.facet = facet;
    } else {
      closest.second_distance = std::min(closest.second_distance, distance);
    }
  }
  return closest;
}

} // namespace mpfem
