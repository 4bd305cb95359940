#include "solver/boundary/wall_friction.hpp"

#include <limits>
#include <numeric>
#include <utility>

#include "solver/physics/friction.hpp"

namespace mpfem {

namespace {

/// The friction of one wall on one grain in one step.
class WallRubbing {
public:
  /// `last_step` in s; `approach` of the wall in it, mm inward.
  WallRubbing(Model& model, double friction, const AxisNormal& normal, double last_step, double approach,
              const std::vector<WallAnchor>& before)
      : model_(model), friction_(friction), normal_(normal), across_{(normal.axis + 1) % 3, (normal.axis + 2) % 3},
        last_step_(last_step), approach_(approach), next_(before.begin()), end_(before.end()) {
    anchors_.reserve(before.size());
  }

  /// A node that is `depth` (mm) behind the wall, which pushes it with `push` (N). By ascending node.
  void rub(std::size_t node, double depth, double push) {
    const auto number = static_cast<std::int32_t>(node);
    release_before(number);
    const std::array<double, 2> place = place_of(number);
    const bool known = next_ != end_ && next_->node == number;
    const Entry entry = known ? Entry{} : entry_of(node, depth);
    WallAnchor anchor = known ? *next_++ : WallAnchor{number, moved_back(place, entry.inside), {}};
    const double stiffness = push / depth;
    const Vector3<double> drift = difference(place, anchor.place);
    const double left = share_left_by_slip(norm(drift), longest_drift(friction_, stiffness, stiffness, depth));
    const Vector3<double> slip = (1.0 - left) * drift, force = (left * stiffness) * drift;
    energy += stick_energy(stiffness, left * left * dot(drift, drift), 0.0);
    dissipation += slip_dissipation(vector_of(anchor.force), force, slip + entry.before);
    if (left < 1) anchor.place = {anchor.place[0] + slip.x, anchor.place[1] + slip.y};
    anchor.force = {force.x, force.y};
    for (std::size_t i = 0; i < 2; ++i) model_.push_contact_point(node, across_[i], -anchor.force[i]);
    anchors_.push_back(anchor);
  }

  /// The anchors of all nodes that still touch.
  std::vector<WallAnchor> finish() {
    release_before(std::numeric_limits<std::int32_t>::max());
    return std::move(anchors_);
  }

  double energy = 0;      ///< mJ
  double dissipation = 0; ///< mJ

private:
  static Vector3<double> vector_of(const std::array<double, 2>& v) { return {v[0], v[1], 0}; }
  static Vector3<double> difference(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return {a[0] - b[0], a[1] - b[1], 0};
  }
  std::array<double, 2> place_of(std::int32_t node) const {
    return {model_.contact_coordinate(static_cast<std::size_t>(node), across_[0]),
            model_.contact_coordinate(static_cast<std::size_t>(node), across_[1])};
  }
  /// Motion of a node along the wall in the step in which it came through it, mm.
  struct Entry {
    Vector3<double> inside{0, 0, 0}; ///< since then
    Vector3<double> before{0, 0, 0}; ///< until then: central differences do the work of the whole step
  };
  Entry entry_of(std::size_t node, double depth) const {
    const Vector3<double> v = model_.contact_velocity(node);
    const double velocity[3] = {v.x, v.y, v.z};
    const double closing = approach_ - last_step_ * normal_.sign * velocity[normal_.axis];
    const double share = share_inside(depth, closing);
    const Vector3<double> along{last_step_ * velocity[across_[0]], last_step_ * velocity[across_[1]], 0};
    return {share * along, (1.0 - share) * along};
  }
  static std::array<double, 2> moved_back(const std::array<double, 2>& place, const Vector3<double>& by) {
    return {place[0] - by.x, place[1] - by.y};
  }
  /// Nodes that have come in front of the wall: their anchors slip all the way.
  void release_before(std::int32_t node) {
    for (; next_ != end_ && next_->node < node; ++next_)
      dissipation +=
          slip_dissipation(vector_of(next_->force), {0, 0, 0}, difference(place_of(next_->node), next_->place));
  }

  Model& model_;
  double friction_;
  AxisNormal normal_;
  std::array<std::size_t, 2> across_;
  double last_step_, approach_;
  std::vector<WallAnchor>::const_iterator next_, end_;
  std::vector<WallAnchor> anchors_;
};

} // namespace

double WallFrictionSums::stored() const {
  return std::accumulate(energy.begin(), energy.end(), 0.0);
}

WallFriction::WallFriction(double friction, int grains) : friction_(friction) {
  if (friction > 0) anchors_.resize(static_cast<std::size_t>(grains));
}

WallFrictionSums WallFriction::add_forces(Model& model, const Box& box, const Bounds& bounds, double last_step,
                                          int grain) {
  WallFrictionSums sums;
  for (std::size_t side = 0; side < 6; ++side) {
    if (!box.has_walls(side / 2)) continue;
    std::vector<WallAnchor>& anchors = this->anchors(grain, side);
    const Plane plane = box.wall(side);
    WallRubbing wall(model, friction_, plane.normal, last_step, box.movement(side), anchors);
    for_each_node_behind(model, plane, bounds, grain, [&](std::size_t node, const auto& gap) {
      wall.rub(node, -gap.distance, surface_force(model, node, grain, gap.distance));
    });
    anchors = wall.finish();
    sums.energy[side] = wall.energy;
    sums.dissipation += wall.dissipation;
  }
  return sums;
}

void WallFriction::forget(const std::array<bool, 3>& axes) {
  for (auto& of_grain : anchors_)
    for (std::size_t side = 0; side < 6; ++side)
      if (axes[side / 2]) of_grain[side].clear();
}

std::array<double, 12> WallFriction::forces_on_grain(int grain) const {
  std::array<double, 12> force{};
  for (std::size_t side = 0; side < 6; ++side)
    for (const WallAnchor& anchor : anchors(grain, side))
      for (std::size_t i = 0; i < 2; ++i) force[2 * side + i] -= anchor.force[i];
  return force;
}

const std::vector<WallAnchor>& WallFriction::anchors(int grain, std::size_t side) const {
  return anchors_[static_cast<std::size_t>(grain)][side];
}

std::vector<WallAnchor>& WallFriction::anchors(int grain, std::size_t side) {
  return anchors_[static_cast<std::size_t>(grain)][side];
}

} // namespace mpfem
