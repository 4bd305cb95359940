#pragma once
// Adhesion of a grain's nodes to one rigid surface: bonds (solver/physics/bond_kinematics.hpp) from a node to a point
// of the surface, which is kept in the surface's own frame.
//
// A bond forms when its node first comes behind the surface, at the surface point that is closest to it then. A broken
// bond stays broken, unless its law lets the node bond again after it has been in front of the surface.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "solver/boundary/rigid_surface.hpp"
#include "solver/physics/bond_kinematics.hpp"

namespace mpfem {

/// How a surface holds what touches it.
struct Adhesion {
  BondLaw law;
  bool rebond_on_contact = false;
};

/// The bond of a node to a rigid surface, intact or broken.
struct SurfaceBond : BondDamage {
  std::int32_t node = 0;
  Vector3<double> place{0, 0, 0}; ///< mm, in the surface's frame
  bool intact() const { return remaining > 0; }
};

/// A cut bond is a broken one: its law says whether the node bonds again.
inline void cut(SurfaceBond& bond) {
  bond.remaining = bond.opening = bond.separation = 0;
}

/// A node behind the surface, held by its bond.
struct HeldNode {
  double penalty_left = 1;        ///< part of the penalty that the bond leaves, at this time level
  double penalty_left_before = 1; ///< the same at the level before
  double friction_share = 1;      ///< D, the share of the point that has no bond
};

/// MPa/mm, the penalty of a rigid surface at a node.
inline double surface_penalty(const Model& model, std::size_t node, int grain) {
  return model.penalty_stiffness[static_cast<std::size_t>(grain)] * model.local_stiffness(node);
}

/// N, force of an intact bond with the present separation on its node. `origin`: mm, where the surface's frame lies.
inline Vector3<double> force_of_bond(const Model& model, const Adhesion& adhesion, const Vector3<double>& origin,
                                     int grain, const SurfaceBond& bond) {
  const auto node = static_cast<std::size_t>(bond.node);
  const double stiffness = law_at_point(adhesion.law, surface_penalty(model, node, grain)).stiffness;
  const Vector3<double> reach = model.contact_point(node) - origin - bond.place;
  return -(bond.remaining * stiffness * model.reference_area[node]) * reach;
}

/// The bonds of one grain to one surface at one time level. `OnPull` is called with every node that a bond pulls, the
/// force on it (N) and the surface's normal there.
template <RigidSurface Surface, class OnPull>
class SurfaceAdhesion {
public:
  /// `origin`: mm, where the surface's frame lies now; `before`: the bonds of the time level before, by ascending node.
  SurfaceAdhesion(Model& model, const Adhesion& adhesion, const Surface& surface, const Vector3<double>& origin,
                  int grain, const std::vector<SurfaceBond>& before, OnPull on_pull)
      : model_(model), adhesion_(adhesion), surface_(surface), origin_(origin), grain_(grain), next_(before.begin()),
        end_(before.end()), on_pull_(std::move(on_pull)) {
    bonds_.reserve(before.size());
  }

  /// Handles a node behind the surface: it bonds if it has never been there. To be called by ascending node.
  template <class Gap>
  HeldNode hold(std::size_t node, const Gap& gap) {
    const auto number = static_cast<std::int32_t>(node);
    pull_before(number);
    SurfaceBond bond;
    if (next_ != end_ && next_->node == number) {
      bond = *next_++;
    } else {
      bond.node = number;
      bond.place = model_.contact_point(node) - gap.distance * gap.normal.vector() - origin_;
    }
    HeldNode held;
    if (bond.intact()) {
      const double penalty = surface_penalty(model_, node, grain_);
      const BondLaw law = law_at_point(adhesion_.law, penalty);
      held.penalty_left_before = penalty_left_by_bond(law, bond, penalty);
      pull(bond, gap);
      held.penalty_left = penalty_left_by_bond(law, bond, penalty);
      held.friction_share = 1.0 - bond.remaining;
    }
    bonds_.push_back(bond);
    return held;
  }

  /// All bonds, including those whose nodes are in front of the surface.
  std::vector<SurfaceBond> finish() {
    pull_before(std::numeric_limits<std::int32_t>::max());
    return std::move(bonds_);
  }

  double energy = 0;      ///< mJ, stored
  double dissipation = 0; ///< mJ, by damage since the time level before
  double bonded_area = 0; ///< mm^2, of nodes whose bonds are not broken

private:
  /// Handles bonds whose nodes are in front of the surface, up to `node`.
  void pull_before(std::int32_t node) {
    for (; next_ != end_ && next_->node < node; ++next_) {
      if (!next_->intact()) {
        if (!adhesion_.rebond_on_contact) bonds_.push_back(*next_);
        continue;
      }
      bonds_.push_back(*next_);
      pull(bonds_.back(), gap_at_any_distance(surface_, NodePoint{model_, static_cast<std::size_t>(next_->node)}));
    }
  }

  /// Updates an intact bond to this time level.
  template <class Gap>
  void pull(SurfaceBond& bond, const Gap& gap) {
    const auto node = static_cast<std::size_t>(bond.node);
    const double area = model_.reference_area[node];
    const BondLaw law = law_at_point(adhesion_.law, surface_penalty(model_, node, grain_));
    const double stiffness = law.stiffness * area, lost = damage_dissipation(law, bond.state);
    const Vector3<double> reach = model_.contact_point(node) - origin_ - bond.place;
    const Vector3<double> force = stiffness * pull_along(law, bond, reach, gap.distance);
    model_.push_contact_point(node, 0, force.x);
    model_.push_contact_point(node, 1, force.y);
    model_.push_contact_point(node, 2, force.z);
    energy += 0.5 * bond.remaining * stiffness * bond.separation * bond.separation;
    dissipation += area * (damage_dissipation(law, bond.state) - lost);
    if (bond.intact()) bonded_area += area;
    on_pull_(node, force, gap.normal.vector());
  }

  Model& model_;
  const Adhesion& adhesion_;
  const Surface& surface_;
  Vector3<double> origin_;
  int grain_;
  std::vector<SurfaceBond>::const_iterator next_, end_;
  std::vector<SurfaceBond> bonds_;
  OnPull on_pull_;
};

/// Whether any of a grain's bonds has to be updated even if the surface cannot touch the grain.
inline bool any_bond_to_update(const Adhesion& adhesion, const std::vector<SurfaceBond>& bonds) {
  return adhesion.rebond_on_contact
             ? !bonds.empty()
             : std::any_of(bonds.begin(), bonds.end(), [](const SurfaceBond& bond) { return bond.intact(); });
}

/// Adds to `rate` (1/s^2) [nodes] what a grain's bonds to a surface add to the frequency squared, beyond the penalty of
/// nodes behind it. Push and tangential displacement of a point are perpendicular, so that the larger of
/// both stiffnesses counts.
template <RigidSurface Surface>
void add_adhesion_stiffness_rate(const Model& model, const Adhesion& adhesion, const Surface& surface, int grain,
                                 const std::vector<SurfaceBond>& bonds, std::span<double> rate) {
  for (const SurfaceBond& bond : bonds) {
    if (!bond.intact()) continue;
    const auto node = static_cast<std::size_t>(bond.node);
    const double penalty = surface_penalty(model, node, grain);
    const bool closed = surface.gap(NodePoint{model, node}).distance < 0;
    const double beyond = bond.remaining * law_at_point(adhesion.law, penalty).stiffness - (closed ? penalty : 0.0);
    if (beyond > 0) add_node_stiffness_rate(model, node, beyond * model.reference_area[node], rate);
  }
}

/// Raises `rate` (1/s^2) of a grain's surface nodes, and of the nodes towards which their contact points lie, to what a
/// new bond adds if it is stiffer than the penalty. Bonds form at once, wherever the surface comes to touch.
inline void raise_to_rate_of_new_bonds(const Model& model, const Adhesion& adhesion, int grain,
                                       std::span<double> rate) {
  const auto g = static_cast<std::size_t>(grain);
  const std::size_t first = model.first_node(grain);
  const auto raise = [&](std::size_t node, double stiffness) {
    rate[node] = std::max(rate[node], stiffness * model.inverse_mass[node]);
  };
  for (std::size_t node = first; node < first + static_cast<std::size_t>(model.surface_node_count[g]); ++node) {
    const double penalty = surface_penalty(model, node, grain), bond = law_at_point(adhesion.law, penalty).stiffness;
    if (bond <= penalty) continue;
    raise(node, bond * model.reference_area[node]);
    if (!model.inner_node.empty())
      raise(static_cast<std::size_t>(model.inner_node[node]), model.inward[node] * bond * model.reference_area[node]);
  }
}

} // namespace mpfem
