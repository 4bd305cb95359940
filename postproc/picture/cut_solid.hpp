#pragma once
// The outside of grains of which a part is cut away: what is left of their surfaces, and the cut faces that close them.

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "postproc/snapshot.hpp"

namespace mpfem {

/// The points x with normal · x < offset (mm); the normal has length 1.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset = 0;
};

/// What is cut away: the points that lie in all of these half-spaces. None of them: nothing is.
using CutAway = std::vector<HalfSpace>;

struct SolidVertex {
  Eigen::Vector3d position; ///< mm
  Eigen::Vector3d normal;   ///< outward, length 1; smooth over a grain's surface but for edges sharper than 40 degrees
  double value = 0;         ///< of the field that is drawn, in its unit; not a number where there is none
};

/// A triangle of the solid's outside.
struct SolidTriangle {
  SolidVertex corner[3];
  std::int32_t grain = 0;
  std::int32_t face = 0; ///< 0: the grain's own surface; k: the cut along the half-space k of CutAway, counted from 1
};

/// Values at the nodes: of a field of tets the mean over the tets around a node, weighted by their volumes, which never
/// mixes grains since grains share no nodes. Of a field of nodes its values, where negative not a number ("damage":
/// never bonded).
struct ShownField {
  std::string name, unit;
  std::vector<double> value; ///< [nodes]
  bool of_surface = false;   ///< a field of surface nodes: cut faces have none
};

/// Throws InputError where there is no such field.
ShownField shown_field(const Snapshot& snapshot, const std::string& name);

/// The tets are cut, not their shells: each grain's triangles bound what is left of its volume. First all surfaces,
/// ordered by grain, then the cuts, face by face.
std::vector<SolidTriangle> cut_solid(const Snapshot& snapshot, const ShownField& field, const CutAway& away);

/// What is left of triangles that bound nothing; no faces close them.
std::vector<SolidTriangle> cut_surface(const std::vector<SolidTriangle>& triangles, const CutAway& away);

} // namespace mpfem
