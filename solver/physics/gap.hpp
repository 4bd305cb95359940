#pragma once
// Geometry of a contact point: the signed gap of a node over a facet along the field of interpolated nodal normals.
//
// Neighbouring facets share their edge's nodes and nodal normals, so the foot point, the gap and the direction are
// continuous as the node slides from facet to facet, over convex edges and into dents alike. The normal force and its
// reaction act along one line through the node and the foot point: linear and angular momentum are kept exactly.

#include "solver/physics/tensor.hpp"

namespace mpfem {

template <class S> struct FacetProjection {
  S weight1, weight2;  ///< foot point = (1 - weight1 - weight2) x0 + weight1 x1 + weight2 x2
  S gap;               ///< mm; negative where the node has penetrated
  Vector3<S> normal;   ///< unit, out of the facet's grain
};

/// Finds weights w and gap parameter g with   node = sum_i w_i (x_i + g n_i),   n_i the unit nodal normals.
/// For a fixed g the offset triangle x_i + g n_i spans a plane; the node lies in it where a cubic in g vanishes. The
/// root next to zero is found by Newton's method. The weights are inside [0, 1] where this facet is met.
template <class S>
FacetProjection<S> project_on_facet(const Vector3<S>& node, const Vector3<S> (&x)[3], const Vector3<S> (&n)[3]) {
  const Vector3<S> e1 = x[1] - x[0], e2 = x[2] - x[0], m1 = n[1] - n[0], m2 = n[2] - n[0];
  const Vector3<S> d0 = x[0] - node;
  const Vector3<S> a0 = cross(e1, e2), a1 = cross(e1, m2) + cross(m1, e2), a2 = cross(m1, m2);
  const S c0 = dot(a0, d0), c1 = dot(a1, d0) + dot(a0, n[0]), c2 = dot(a2, d0) + dot(a1, n[0]), c3 = dot(a2, n[0]);
  S g(0.0);
  for (int iteration = 0; iteration < 4; ++iteration) {
    const S value = ((c3 * g + c2) * g + c1) * g + c0;
    const S slope = (S(3.0) * c3 * g + S(2.0) * c2) * g + c1;
    g = g - value / slope;
  }
  const Vector3<S> plane = a0 + g * (a1 + g * a2);
  const Vector3<S> p = -(d0 + g * n[0]);
  const S inverse = S(1.0) / dot(plane, plane);
  const S weight1 = dot(cross(p, e2 + g * m2), plane) * inverse;
  const S weight2 = dot(cross(e1 + g * m1, p), plane) * inverse;
  const Vector3<S> direction = n[0] + weight1 * m1 + weight2 * m2;
  const S length = norm(direction);
  return {weight1, weight2, g * length, (S(1.0) / length) * direction};
}

/// Closest point of a triangle, with its weights as above.
template <class S> struct ClosestPoint {
  Vector3<S> point;
  S weight1, weight2;
};

/// Closest point of the triangle x0 x1 x2 to `p`, by the Voronoi regions of its corners, edges and face (Ericson,
/// Real-Time Collision Detection, 2005, section 5.1.5). Plain doubles: the regions branch.
inline ClosestPoint<double> closest_point_on_triangle(const Vector3<double>& p, const Vector3<double> (&x)[3]) {
  const auto result = [&x](double weight1, double weight2) {
    return ClosestPoint<double>{x[0] + weight1 * (x[1] - x[0]) + weight2 * (x[2] - x[0]), weight1, weight2};
  };
  const Vector3<double> ab = x[1] - x[0], ac = x[2] - x[0], ap = p - x[0];
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return result(0, 0);
  const Vector3<double> bp = p - x[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return result(1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return result(d1 / (d1 - d3), 0);
  const Vector3<double> cp = p - x[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return result(0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return result(0, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double weight = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return result(1 - weight, weight);
  }
  const double sum = va + vb + vc;
  return result(vb / sum, vc / sum);
}

} // namespace mpfem
