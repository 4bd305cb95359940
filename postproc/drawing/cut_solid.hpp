#pragma once
// The outer surface of grains after a part is cut away: the remaining surfaces, and the cut faces that close them.

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

/// The points x with normal · x < offset (mm); the normal has length 1.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset = 0;
};

/// The part that is cut away: the points that lie in all of these half-spaces. Empty: nothing is cut.
using CutAway = std::vector<HalfSpace>;

/// A corner of a triangle that is drawn.
struct SolidVertex {
  Eigen::Vector3d position; ///< mm
  Eigen::Vector3d normal;   ///< outward, length 1; smooth over a grain's surface except at edges over 40 degrees
  double value = 0;         ///< of the field that is drawn, in its unit; NaN where there is none
};

/// A triangle of the solid's outer surface.
struct SolidTriangle {
  SolidVertex corner[3];
  std::int32_t grain = 0;
  std::int32_t face = 0; ///< 0: the grain's own surface; k: the cut along the half-space k of CutAway, counted from 1
};

/// Values at the nodes. For a field of tets: the volume-weighted mean over the tets around a node (grains do not mix,
/// since they share no nodes). For a field of nodes: its values, NaN where negative ("damage": never bonded).
struct ShownField {
  std::string name, unit;
  std::vector<double> value; ///< [nodes]
  bool of_surface = false;   ///< a field of surface nodes: cut faces have no values
};

/// Field of this name at the nodes. Throws InputError where there is none.
ShownField shown_field(const Snapshot& snapshot, const std::string& name);

/// The outer surface after cutting. The tets are cut, not their shells: each grain's triangles bound its remaining
/// volume. First all surfaces, ordered by grain, then the cuts, face by face.
std::vector<SolidTriangle> cut_solid(const Snapshot& snapshot, const ShownField& field, const CutAway& away);

/// The remaining parts of open surfaces; no faces close the cuts.
std::vector<SolidTriangle> cut_surface(const std::vector<SolidTriangle>& triangles, const CutAway& away);

} // namespace mpfem
