#include "postproc/run_data/contact_plane.hpp"

#include <cmath>
#include <optional>

#include <Eigen/Dense>

namespace mpfem {

namespace {

Eigen::Vector3d vector(const std::array<double, 3>& x) {
  return {x[0], x[1], x[2]};
}

std::array<double, 3> components(const Eigen::Vector3d& x) {
  return {x[0], x[1], x[2]};
}

/// The axis of the smallest second moment. Empty where the points span no plane: where the extent along that axis is
/// not below half of the next larger one.
std::optional<Eigen::Vector3d> axis_across(const std::vector<AreaPoint>& points, const Eigen::Vector3d& origin) {
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const AreaPoint& p : points) {
    const Eigen::Vector3d d = vector(p.x) - origin;
    moment += p.area * d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moment);
  const Eigen::Vector3d size = solver.eigenvalues().cwiseMax(0).cwiseSqrt(); // ascending
  constexpr double thin = 0.5, round_off = 1e-4;                             // positions are stored in single precision
  if (!(size[1] > round_off * size[2] && size[0] < thin * size[1])) return {};
  return Eigen::Vector3d(solver.eigenvectors().col(0));
}

} // namespace

ContactPlane contact_plane(const std::vector<AreaPoint>& points, const std::array<double, 3>& force,
                           const std::array<double, 3>& across) {
  using From = ContactPlane::NormalFrom;
  ContactPlane plane;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double area = 0;
  for (const AreaPoint& p : points) origin += p.area * vector(p.x), area += p.area;
  if (area > 0) origin /= area;
  const auto axis = area > 0 ? axis_across(points, origin) : std::nullopt;
  const double magnitude = vector(force).norm();
  const double nearer = std::sqrt(0.5); // cosine of 45 degrees
  Eigen::Vector3d normal;
  if (magnitude > 0 && (!axis || std::abs(axis->dot(vector(force))) >= nearer * magnitude)) {
    normal = vector(force) / magnitude;
    plane.from = From::force;
  } else if (axis) {
    normal = *axis;
    plane.from = From::points;
  } else {
    normal = vector(across).norm() > 0 ? vector(across).normalized() : Eigen::Vector3d::UnitZ();
  }
  if (normal.dot(vector(across)) < 0) normal = -normal;
  Eigen::Index nearest = 0;
  normal.cwiseAbs().maxCoeff(&nearest);
  Eigen::Vector3d u = Eigen::Vector3d::Unit((nearest + 1) % 3);
  u = (u - u.dot(normal) * normal).normalized();
  plane.origin = components(origin);
  plane.normal = components(normal);
  plane.u = components(u);
  plane.v = components(normal.cross(u));
  return plane;
}

std::array<double, 3> in_plane(const ContactPlane& plane, const std::array<double, 3>& x) {
  const Eigen::Vector3d d = vector(x) - vector(plane.origin);
  return {d.dot(vector(plane.u)), d.dot(vector(plane.v)), d.dot(vector(plane.normal))};
}

} // namespace mpfem
