#pragma once
// The drawn body of a rigid tool, with some thickness: the surface of a plane or a die bounds an infinite solid.
// Sections, pictures, pages and VTK all use the ends chosen here.

#include <string>
#include <vector>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// The part of space that is drawn, mm.
struct DrawnExtent {
  std::array<double, 3> low{}, high{};
  double thickness = 0; ///< of infinite bodies
};

/// Around box and grains (grains up to 0.3 of the box's lengths outside it), plus a thickness of 0.12 of the box's
/// longest edge on every side. Also around the bore and the ends of a die where they are nearer to the box than its
/// longest edge.
DrawnExtent drawn_extent(const Snapshot& snapshot);

/// A point of a profile: distance from the axis and position along it, mm.
struct ProfilePoint {
  double radius = 0, along = 0;
};

/// A closed polygon rotated about a line along a coordinate axis.
struct Revolved {
  std::size_t axis = 2;
  std::array<double, 3> centre{};    ///< mm, point of the axis with `along` 0
  std::vector<ProfilePoint> profile; ///< convex, or a strip
  bool strip = false;                ///< the profile's second half runs back along its first, point by point
};

/// A closed surface.
struct Faceted {
  std::vector<std::array<double, 3>> vertex;         ///< mm
  std::vector<std::array<std::int32_t, 3>> triangle; ///< counter-clockwise seen from outside
  /// Slab: its first `front` vertices are its front, a convex polygon; the next `front` lie behind these. 0 for others.
  std::size_t front = 0;
};

/// Either turned, if it has a profile, or faceted.
struct ToolBody {
  std::string name;
  Revolved turned;
  Faceted faceted;
  bool is_turned() const { return !turned.profile.empty(); }
};

/// The bodies of the snapshot's tools. A die is a sleeve; a plane is a slab, or a punch that fills the bore if it is
/// normal to the axis of a die that is in place. Tools with no part inside the extent are left out.
std::vector<ToolBody> tool_bodies(const Snapshot& snapshot, const DrawnExtent& extent);

} // namespace mpfem
