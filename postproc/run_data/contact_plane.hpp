#pragma once
// The mean plane of a contact between two grains, with coordinates in it.

#include <array>
#include <vector>

namespace mpfem {

/// A point of a contact with its tributary area.
struct AreaPoint {
  std::array<double, 3> x{}; ///< mm
  double area = 0;           ///< mm^2
};

/// A plane with right-handed coordinates u, v in it.
struct ContactPlane {
  std::array<double, 3> origin{};           ///< area centroid of the points, mm
  std::array<double, 3> normal{}, u{}, v{}; ///< right-handed, unit length; the normal points along `across`
  enum class NormalFrom { force, points, centres } from = NormalFrom::centres; ///< source of the normal
};

/// The plane through the area centroid of the points. Its normal is the direction of the pair's force (N, either
/// sense). Where that is zero, or makes more than 45 degrees with the normal of the points' plane (a sheared bond), it
/// is the principal axis of the points with the smallest area-weighted second moment. Where the points do not span a
/// plane either, it is the direction `across` from the centre of the first grain to that of the second (z where that is
/// zero too). u is the projection of the coordinate axis that follows, in cyclic order, the one nearest to the normal
/// (as in sections: y for a normal along x); v = normal x u. Without points the origin is zero.
ContactPlane contact_plane(const std::vector<AreaPoint>& points, const std::array<double, 3>& force,
                           const std::array<double, 3>& across);

/// Coordinates u and v, and height above the plane, mm.
std::array<double, 3> in_plane(const ContactPlane& plane, const std::array<double, 3>& x);

} // namespace mpfem
