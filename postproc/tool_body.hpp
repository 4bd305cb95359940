#pragma once
// What is drawn of a rigid tool: a body of some thickness, since the surfaces of planes and dies are those of matter
// without end. One place decides where it ends, for sections, pictures, pages and VTK.

#include <string>
#include <vector>

#include "postproc/snapshot.hpp"

namespace mpfem {

/// What is drawn of space, mm.
struct DrawnExtent {
  std::array<double, 3> low{}, high{};
  double thickness = 0; ///< of bodies without end
};

/// Around box and grains (these as far as 0.3 of the box's lengths), and a thickness of 0.12 of the box's longest edge
/// beyond. Also around the bore and the ends of a die, where they are nearer to the box than it is long.
DrawnExtent drawn_extent(const Snapshot& snapshot);

/// A point of a profile: distance from the axis and place along it, mm.
struct ProfilePoint {
  double radius = 0, along = 0;
};

/// A closed polygon turned about a line along a coordinate axis.
struct Revolved {
  std::size_t axis = 2;
  std::array<double, 3> centre{};    ///< mm, where the axis has `along` 0
  std::vector<ProfilePoint> profile; ///< convex, or a strip
  bool strip = false;                ///< the profile's second half runs back along its first, point by point
};

/// A closed surface.
struct Faceted {
  std::vector<std::array<double, 3>> vertex;         ///< mm
  std::vector<std::array<std::int32_t, 3>> triangle; ///< counter-clockwise from outside of the surface
  /// Of a slab: so many of its vertices are its front, a convex polygon; as many after them lie behind these. Else 0.
  std::size_t front = 0;
};

/// Either turned, where it has a profile, or faceted.
struct ToolBody {
  std::string name;
  Revolved turned;
  Faceted faceted;
  bool is_turned() const { return !turned.profile.empty(); }
};

/// The bodies of the snapshot's tools. A die is a sleeve, a plane a slab, or across the axis of a die that is in place
/// a punch that fills its bore. Tools without a part within the extent are left out.
std::vector<ToolBody> tool_bodies(const Snapshot& snapshot, const DrawnExtent& extent);

} // namespace mpfem
