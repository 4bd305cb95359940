#pragma once
// Facets of a model as contact sees them: gathered corners, the closest of several, and which side a node is on.

#include <algorithm>
#include <cstdint>
#include <limits>
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

/// True if a node is on the outer side of the facet's surface. `offset` is node minus closest point, mm. Nodal normals
/// lie elsewhere in memory; they are read only if the closest point is on an edge or corner.
inline bool is_outside(const Model& model, const Vector3<double>& offset, const ClosestPoint<double>& closest,
                       const Facet& facet) {
  if (closest.inside) return dot(offset, facet_direction(facet.x)) >= 0;
  const Vector3<double> normal[3] = {model.normal_of(at(facet.node[0])), model.normal_of(at(facet.node[1])),
                                     model.normal_of(at(facet.node[2]))};
  return dot(offset, edge_direction(closest, normal)) >= 0;
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
