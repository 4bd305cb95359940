#pragma once
// Penalty contact of a node with a rigid wall, a plane across a coordinate axis, at one point.
//
// The wall has no mesh and no deformation of its own, so the node alone carries the whole penalty: p = K r (-gap) over
// the node's reference area A, with the grain's penalty K (solver/physics/penalty.hpp) and the local refinement r of
// its mesh.

namespace mpfem {

/// Distance (mm) of a node at `coordinate` (mm) from the wall at `plane` (mm), negative behind it. `inward` is the
/// direction into the box along the wall's axis: 1 for the wall at the low face, -1 for that at the high face.
inline double wall_gap(double coordinate, double plane, double inward) {
  return inward * (coordinate - plane);
}

/// Push (N) of a wall on one node, into the box, at `gap` < 0 (mm). `penalty` K in MPa/mm, `refinement` r >= 0 without
/// unit, `area` A in mm^2.
inline double wall_force(double gap, double penalty, double refinement, double area) {
  return -gap * penalty * refinement * area;
}

/// Energy (mJ) of that spring: `force` N, `gap` < 0 mm.
inline double wall_energy(double force, double gap) {
  return -0.5 * force * gap;
}

} // namespace mpfem
