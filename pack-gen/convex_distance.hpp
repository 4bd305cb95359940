#pragma once
// Distance between two convex bodies given by points, proven by a separating plane.

#include <vector>

#include <Eigen/Core>

namespace mpfem {

/// Two bounds of a distance. `lower` is proven by the plane normal to `direction`: every point of the second body lies
/// at least `lower` beyond every point of the first. `upper` is the distance between two points of the hulls. Both <= 0
/// if no separating plane was found.
struct ConvexDistance {
  double lower = 0, upper = 0; ///< mm
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// Distance between the convex hulls of two point sets (columns, mm) with the algorithm of Gilbert, Johnson & Keerthi
/// (1988), to a relative accuracy of 1e-9 where the hulls are apart. `guess`: a direction from the first to the second.
ConvexDistance convex_distance(const Eigen::Matrix3Xd& first, const Eigen::Matrix3Xd& second,
                               const Eigen::Vector3d& guess);

} // namespace mpfem
