#include "pack-gen/convex_distance.hpp"

#include <limits>

#include <Eigen/Dense>

namespace mpfem {

namespace {

using Eigen::Vector3d;

/// Point of the simplex's hull nearest to the origin; the simplex shrinks to the face that holds it.
Vector3d nearest_to_origin(std::vector<Vector3d>& simplex) {
  const auto n = static_cast<unsigned>(simplex.size());
  double best = std::numeric_limits<double>::infinity();
  Vector3d nearest = simplex.front();
  unsigned kept = 1;
  // At most fifteen faces: all are tried. A face counts if the foot of the perpendicular lies inside it.
  for (unsigned face = 1; face < (1U << n); ++face) {
    std::vector<Vector3d> corner;
    for (unsigned k = 0; k < n; ++k)
      if (face >> k & 1U) corner.push_back(simplex[k]);
    const auto edges = static_cast<Eigen::Index>(corner.size()) - 1;
    Vector3d foot = corner[0];
    if (edges > 0) {
      Eigen::Matrix3Xd span(3, edges);
      for (Eigen::Index k = 0; k < edges; ++k) span.col(k) = corner[static_cast<std::size_t>(k + 1)] - corner[0];
      const Eigen::VectorXd weight = span.colPivHouseholderQr().solve(-corner[0]);
      if ((weight.array() < 0).any() || weight.sum() > 1) continue;
      foot += span * weight;
    }
    if (foot.squaredNorm() < best) {
      best = foot.squaredNorm();
      nearest = foot;
      kept = face;
    }
  }
  std::vector<Vector3d> rest;
  for (unsigned k = 0; k < n; ++k)
    if (kept >> k & 1U) rest.push_back(simplex[k]);
  simplex = std::move(rest);
  return nearest;
}

} // namespace

ConvexDistance convex_distance(const Eigen::Matrix3Xd& first, const Eigen::Matrix3Xd& second, const Vector3d& guess) {
  // The Minkowski difference second - first; its point nearest to the origin is the shortest way between the hulls.
  Vector3d nearest = guess;
  std::vector<Vector3d> simplex;
  ConvexDistance result;
  result.lower = -std::numeric_limits<double>::infinity();
  result.upper = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double length = nearest.norm();
    if (!(length > 0)) break;
    const Vector3d direction = nearest / length;
    Eigen::Index i = 0, j = 0;
    const double highest = (direction.transpose() * first).maxCoeff(&i);
    const double lowest = (direction.transpose() * second).minCoeff(&j);
    if (lowest - highest > result.lower) {
      result.lower = lowest - highest;
      result.direction = direction;
    }
    if (!simplex.empty() && result.upper - result.lower <= 1e-9 * result.upper) break;
    const Vector3d support = second.col(j) - first.col(i);
    bool known = false;
    for (const Vector3d& corner : simplex) known = known || corner == support;
    if (known) break;
    simplex.push_back(support);
    nearest = nearest_to_origin(simplex);
    result.upper = std::min(result.upper, nearest.norm());
    if (simplex.size() == 4) break; // the origin lies inside: the hulls meet
  }
  return result;
}

} // namespace mpfem
