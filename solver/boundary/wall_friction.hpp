#pragma once
// Coulomb friction of grains at the walls of the box (surface_friction.hpp).

#include <array>
#include <vector>

#include "solver/boundary/box.hpp"
#include "solver/boundary/surface_friction.hpp"

namespace mpfem {

/// What friction at the walls stores and dissipates at one grain.
struct WallFrictionSums {
  std::array<double, 6> energy{}; ///< mJ, of each wall
  double dissipation = 0;         ///< mJ, since the time level before
  double stored() const;

  template <class Self, class Visitor>
  static void for_each_term(Self& s, Visitor&& visit) {
    for (auto& of_wall : s.energy) visit.sum(of_wall);
    visit.sum(s.dissipation);
  }
};

/// The stick springs between all grains and the six walls.
class WallFriction {
public:
  /// `friction` mu; 0: none.
  WallFriction(double friction, int grains);

  bool present() const { return friction_ > 0; }
  /// Adds the walls' friction on a grain to model.force, before the box takes in its loads. `last_step` in s, the step
  /// that led to the present. Different grains may be handled at the same time.
  WallFrictionSums add_forces(Model& model, const Box& box, const Bounds& bounds, double last_step, int grain);
  /// Forgets the anchors in the walls across these axes.
  void forget(const std::array<bool, 3>& axes);

  /// N on a grain, of each wall along its two tangential axes.
  std::array<double, 12> forces_on_grain(int grain) const;
  /// By ascending node.
  const std::vector<SurfaceAnchor>& anchors(int grain, std::size_t side) const;
  std::vector<SurfaceAnchor>& anchors(int grain, std::size_t side);
  int grains() const { return static_cast<int>(anchors_.size()); }

private:
  double friction_;
  std::vector<std::array<std::vector<SurfaceAnchor>, 6>> anchors_; ///< [grains]
};

} // namespace mpfem
