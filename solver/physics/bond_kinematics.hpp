#pragma once
// Bonds of contact points: where they are attached, how far they are separated, their energy and their force.
//
// A bond forms when its node first comes inside the other grain, and is attached to the material point of the surface
// where that happens. With d = node - attachment, c the point of the surface that is closest to the node now, and
// g = |node - c|, the energy of a point with penalty stiffness k and bond stiffness b (N/mm) is
//   open:     (1 - D) b |d|^2 / 2
//   closed:   k g^2 / 2 + (1 - D) b (|d|^2 - g^2) / 2   =   (1 - D) b |d|^2 / 2 + (k - (1 - D) b) g^2 / 2
// that is, the undamaged penalty against closing and a bond whose effective separation delta^2 = |d|^2 - g^2 is the
// tangential displacement. The bond leaves k - (1 - D) b of the penalty to the point; this is negative if the bond is
// stiffer than the penalty. (|d| >= g, since c is the closest point of all.) Both terms are central forces between
// material points: linear and angular momentum are conserved exactly, a rigid rotation of both grains changes nothing,
// and no tangent plane has to be followed as the node slides over facets and edges. The force is continuous when the
// point opens or closes. A chord between distant points of a curved surface is not along the surface; the bond then
// pulls along the chord.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/physics/bond.hpp"
#include "solver/physics/gap.hpp"

namespace mpfem {

/// How far a bond is separated and damaged, whatever it is attached to.
struct BondDamage {
  BondState state;                    ///< separations at first damage and largest, mm
  double remaining = 1;               ///< 1 - D
  double opening = 0, separation = 0; ///< mm, at the current time level
};

/// The bond of one contact point, attached to a facet of the other grain.
struct PointBond : BondDamage {
  std::int32_t facet = -1;         ///< where it is attached, -1: none
  std::int32_t law = 0;            ///< number of the law by which this bond, or the one before it, formed
  double weight1 = 0, weight2 = 0; ///< shape functions of the facet's second and third node
  double dissipated_before = 0;    ///< N/mm, dissipated by the bonds that this point had before
  bool exists() const { return facet >= 0; }
  bool intact() const { return facet >= 0 && remaining > 0; }
};

/// Updates the bond and its damage for a new separation. `open` and `effective` (separation) in mm, both >= 0.
inline void update_bond(const BondLaw& law, BondDamage& bond, double open, double effective) {
  bond.opening = open;
  bond.separation = effective;
  if (advance_damage(law, bond.state, open, effective)) bond.remaining = remaining_stiffness(law, bond.state);
  if (bond.remaining == 0) bond.opening = bond.separation = 0; // broken: no longer followed
}

/// Part of the penalty that a bond leaves to its closed point: 1 - (1 - D) b/k. The bond's own pull makes up for the
/// rest. `law` at the point, `penalty` K of the point (MPa/mm).
inline double penalty_left_by_bond(const BondLaw& law, const BondDamage& bond, double penalty) {
  return 1.0 - bond.remaining * (law.stiffness / penalty);
}

/// Pull (mm) of a bond that holds in all directions. Times the bond's stiffness b (N/mm) it is the force (N) on its
/// node. `reach` (mm) points from the attachment to the node. `gap` is the distance (mm) of the node from the other
/// surface, negative inside. If the node is too far away for its gap to be known, pass any larger number: the opening
/// is at most the distance to the attachment.
inline Vector3<double> pull_along(const BondLaw& law, BondDamage& bond, const Vector3<double>& reach, double gap) {
  const double square = dot(reach, reach);
  if (gap < 0)
    update_bond(law, bond, 0.0, std::sqrt(std::max(square - gap * gap, 0.0)));
  else
    update_bond(law, bond, std::min(gap, std::sqrt(square)), std::sqrt(square));
  return -bond.remaining * reach;
}

/// Force of a bond on its node per unit of the bond's stiffness, and where the reaction acts on the facet.
struct BondPull {
  Vector3<double> pull;    ///< mm: times the bond's stiffness b gives N
  double weight1, weight2; ///< shape functions of the attachment facet's second and third node
};

/// Pull of a bond that holds in all directions. `x` are the corners of its facet, mm; `gap` as of pull_along.
inline BondPull pull_of_bond(const BondLaw& law, PointBond& bond, const Vector3<double>& node,
                             const Vector3<double> (&x)[3], double gap) {
  const Vector3<double> attachment = facet_point(x, bond.weight1, bond.weight2);
  return {pull_along(law, bond, node - attachment, gap), bond.weight1, bond.weight2};
}

/// Pull of an open bond that does not resist sliding: along the normal of the facet where it was last closed, between
/// the node and the point of the facet's plane beneath it. `x` are the corners of that facet, mm.
inline BondPull pull_of_normal_bond(const BondLaw& law, PointBond& bond, const Vector3<double>& node,
                                    const Vector3<double> (&x)[3]) {
  const PlaneFoot foot = foot_on_plane(node, x);
  const double height = std::max(foot.height, 0.0); // in units of |area|
  const double open = height * norm(foot.area);
  update_bond(law, bond, open, open);
  return {-(bond.remaining * height) * foot.area, foot.weight1, foot.weight2};
}

} // namespace mpfem
