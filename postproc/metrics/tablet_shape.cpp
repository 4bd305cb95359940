#include "postproc/metrics/tablet_shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "postproc/fits/least_squares.hpp"

namespace mpfem {

namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

Matrix3Xd points_of(std::span<const float> values) {
  return Eigen::Map<const Eigen::Matrix3Xf>(values.data(), 3, static_cast<Eigen::Index>(values.size() / 3))
      .cast<double>();
}

/// Motion of a rigid body: a point x moves to there + turn (x - here).
struct RigidMotion {
  Vector3d here, there;
  Matrix3d turn;

  /// Displacement of a point beyond this motion, in the frame before it.
  Vector3d beyond(const Vector3d& before, const Vector3d& later) const {
    return turn.transpose() * (later - there) - (before - here);
  }
};

/// The motion that fits these points best in the least-squares sense (Kabsch, Acta Cryst. A32, 922, 1976).
RigidMotion rigid_motion(const Matrix3Xd& before, const Matrix3Xd& later) {
  RigidMotion motion{before.rowwise().mean(), later.rowwise().mean(), Matrix3d::Identity()};
  const Matrix3d product = (before.colwise() - motion.here) * (later.colwise() - motion.there).transpose();
  const Eigen::JacobiSVD<Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d sign = Matrix3d::Identity();
  sign(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1;
  motion.turn = svd.matrixV() * sign * svd.matrixU().transpose();
  return motion;
}

/// Mean position of each grain's nodes.
Matrix3Xd grain_centres(const Matrix3Xd& node, std::span<const std::int32_t> grain, std::size_t grains) {
  Matrix3Xd sum = Matrix3Xd::Zero(3, static_cast<Eigen::Index>(grains));
  Eigen::RowVectorXd count = Eigen::RowVectorXd::Zero(sum.cols());
  for (Eigen::Index i = 0; i < node.cols(); ++i) {
    sum.col(grain[static_cast<std::size_t>(i)]) += node.col(i);
    count[grain[static_cast<std::size_t>(i)]] += 1;
  }
  return sum.array().rowwise() / count.array().max(1.0);
}

/// The grains that still belong to the tablet, and its motion. A grain displaced relative to the others by more than is
/// allowed is left out and the motion fitted again, until none is.
struct Tablet {
  std::vector<char> holds; ///< [grains]
  RigidMotion motion;
  std::size_t lost() const { return static_cast<std::size_t>(std::count(holds.begin(), holds.end(), 0)); }
};

Tablet whole_tablet(const Matrix3Xd& before, const Matrix3Xd& later, double largest_departure) {
  const auto grains = static_cast<std::size_t>(before.cols());
  Tablet tablet{std::vector<char>(grains, 1), rigid_motion(before, later)};
  constexpr int most_rounds = 20;
  for (int round = 0; round < most_rounds; ++round) {
    std::vector<char> holds(grains);
    std::vector<Eigen::Index> kept;
    for (std::size_t g = 0; g < grains; ++g) {
      const auto column = static_cast<Eigen::Index>(g);
      holds[g] = tablet.motion.beyond(before.col(column), later.col(column)).norm() <= largest_departure;
      if (holds[g]) kept.push_back(column);
    }
    if (holds == tablet.holds || kept.size() < 3) break;
    tablet.holds = holds;
    tablet.motion = rigid_motion(before(Eigen::all, kept), later(Eigen::all, kept));
  }
  return tablet;
}

/// Sums of a value over the added nodes of each grain.
class GrainSums {
public:
  void add(std::int32_t grain, double value) {
    auto& [sum, count] = sums_[grain];
    sum += value;
    count += 1;
  }
  std::size_t grains() const { return sums_.size(); }
  /// Mean over all nodes; its uncertainty takes grains as independent units.
  Ratio mean() const {
    std::vector<double> sum, count;
    for (const auto& [grain, entry] : sums_) {
      sum.push_back(entry.first);
      count.push_back(entry.second);
    }
    return ratio_of_sums(sum, count);
  }

private:
  std::map<std::int32_t, std::pair<double, double>> sums_;
};

/// A node of the band: its direction from the axis in the pressed state, and its displacement along x and y.
struct BandNode {
  std::int32_t grain;
  Eigen::Vector2d outward, moved;
};

/// Outward displacement of the band, by grain, without the translation that fits best together with a uniform growth.
GrainSums growth_of(const std::vector<BandNode>& band) {
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(band.size()), 3);
  Eigen::VectorXd outward(basis.rows());
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    const BandNode& node = band[static_cast<std::size_t>(i)];
    basis.row(i) << node.outward[0], node.outward[1], 1;
    outward[i] = node.outward.dot(node.moved);
  }
  const auto fit = linear_least_squares(basis, outward);
  const Eigen::Vector2d aside = fit ? Eigen::Vector2d(fit->parameters.head<2>()) : Eigen::Vector2d(0, 0);
  GrainSums growth;
  for (const BandNode& node : band) growth.add(node.grain, node.outward.dot(node.moved - aside));
  return growth;
}

/// Displacements of the nodes at punches and die.
struct Faces {
  GrainSums upper, lower; ///< mm, upwards
  std::vector<BandNode> band;
};

Faces faces_of(const TabletStates& states, const Matrix3Xd& pressed, const Matrix3Xd& later, const Tablet& tablet,
               double distance) {
  const double radius = 0.5 * (states.high[0] - states.low[0]);
  const Eigen::Vector2d axis(states.low[0] + radius, 0.5 * (states.low[1] + states.high[1]));
  Faces faces;
  for (Eigen::Index i = 0; i < pressed.cols(); ++i) {
    const std::int32_t grain = states.node_grain[static_cast<std::size_t>(i)];
    if (!tablet.holds[static_cast<std::size_t>(grain)]) continue;
    const Vector3d place = pressed.col(i), moved = tablet.motion.beyond(place, later.col(i));
    const Eigen::Vector2d from_axis = place.head<2>() - axis;
    if (states.high[2] - place[2] <= distance) faces.upper.add(grain, moved[2]);
    if (place[2] - states.low[2] <= distance) faces.lower.add(grain, moved[2]);
    if (radius - from_axis.norm() <= distance) faces.band.push_back({grain, from_axis.normalized(), moved.head<2>()});
  }
  return faces;
}

} // namespace

std::optional<TabletShape> tablet_shape(const TabletStates& states, const TabletShapeRule& rule, std::string& why) {
  const Matrix3Xd pressed = points_of(states.pressed), later = points_of(states.later);
  const auto grains = static_cast<std::size_t>(
      states.node_grain.empty() ? 0 : *std::max_element(states.node_grain.begin(), states.node_grain.end()) + 1);
  if (grains < 3) {
    why = fmt::format("found {} grains, allowed: 3 or more", grains);
    return {};
  }
  const Tablet tablet = whole_tablet(grain_centres(pressed, states.node_grain, grains),
                                     grain_centres(later, states.node_grain, grains), rule.largest_departure);
  const Faces faces = faces_of(states, pressed, later, tablet, rule.face_distance);
  const GrainSums growth = growth_of(faces.band);
  for (const auto& [name, found] : {std::pair{"the upper punch", faces.upper.grains()},
                                    {"the lower punch", faces.lower.grains()},
                                    {"the die", growth.grains()}})
    if (found < 3) {
      why = fmt::format("within {:g} mm of {} found nodes of {} grains, allowed: 3 or more", rule.face_distance, name,
                        found);
      return {};
    }
  const Ratio up = faces.upper.mean(), down = faces.lower.mean(), out = growth.mean();
  TabletShape shape;
  shape.thickness = {states.high[2] - states.low[2] + up.value - down.value,
                     std::hypot(up.half_width, down.half_width)};
  shape.diameter = {states.high[0] - states.low[0] + 2 * out.value, 2 * out.half_width};
  shape.upper_grains = faces.upper.grains();
  shape.lower_grains = faces.lower.grains();
  shape.band_grains = growth.grains();
  shape.grains_lost = tablet.lost();
  return shape;
}

} // namespace mpfem
