#pragma once
// Mesh-free driver of one contact point: a node and a facet of another grain, with the penalty and, if there is a law,
// a bond and friction. It calls the same functions in the same order as the kernel; but bonds do not form again, and a
// point that closes is anchored where it is.

#include <optional>

#include "solver/physics/bond_kinematics.hpp"
#include "solver/physics/friction_kinematics.hpp"
#include "solver/physics/gap.hpp"
#include "solver/physics/penalty.hpp"

namespace mpfem::test {

/// Forces at a contact point, and its energy.
struct PointForces {
  Vector3<double> node{0, 0, 0}; ///< N
  Vector3<double> facet[3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  double energy = 0; ///< mJ, of penalty, bond and stick spring

  void add(const Vector3<double>& force, double weight1, double weight2) {
    const double weight[3] = {1 - weight1 - weight2, weight1, weight2};
    node = node + force;
    for (int c = 0; c < 3; ++c) facet[c] = facet[c] - weight[c] * force;
  }
};

struct ContactPoint {
  double stiffness = 50;                                    ///< K, MPa/mm
  double area = 0.02;                                       ///< A, mm^2
  Vector3<double> x[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; ///< mm; outward normal z
  Vector3<double> node{0.25, 0.25, 0.1};                    ///< mm
  std::optional<BondLaw> law;                               ///< its stiffness follows the penalty where it is 0
  PointBond bond;
  double friction = 0; ///< mu
  PointFriction point_friction;
  double rubbed = 0; ///< mJ, dissipated by friction so far

  /// Signed distance of the node, mm. The sign is that of the facet's own normal.
  double gap() const {
    const Vector3<double> offset = node - closest_point_on_triangle(node, x).point;
    return dot(offset, facet_direction(x)) < 0 ? -norm(offset) : norm(offset);
  }

  /// Forces at the current positions. A bond forms where the node is inside, and is taken to its current separation.
  PointForces evaluate() {
    PointForces forces;
    const ClosestPoint<double> closest = closest_point_on_triangle(node, x);
    const Vector3<double> offset = node - closest.point;
    const double k = stiffness * area, distance = gap();
    double pushed = k;
    if (law && (bond.intact() || distance < 0)) {
      if (!bond.exists()) bond.facet = 0, bond.weight1 = closest.weight1, bond.weight2 = closest.weight2;
      const BondLaw here = law_at_point(*law, stiffness);
      const BondPull pull = pull_of_bond(here, bond, node, x, distance);
      forces.add(here.stiffness * area * pull.pull, pull.weight1, pull.weight2);
      forces.energy += 0.5 * bond.remaining * here.stiffness * area * bond.separation * bond.separation;
      if (distance < 0) pushed *= penalty_left_by_bond(here, bond, stiffness);
    }
    if (distance >= 0) {
      if (point_friction.exists()) rubbed += release(point_friction, closest.point, x);
      return forces;
    }
    forces.energy += penalty_energy(k, -distance);
    if (friction > 0) {
      const double share = law ? 1 - bond.remaining : 1.0;
      const FrictionStep step =
          advance_friction(point_friction, friction_spring(point_friction, share * friction, k, pushed),
                           {node, 0, x, closest, -distance, {0, 0, 0}}, x);
      rubbed += step.dissipated;
      forces.energy += step.stored;
      forces.add(-(pushed * step.reach), point_friction.weight1, point_friction.weight2);
    } else {
      forces.add(penalty_force(pushed, offset), closest.weight1, closest.weight2);
    }
    return forces;
  }
};

} // namespace mpfem::test
