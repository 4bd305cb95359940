#pragma once
// Two hemispheres tip to tip, finely meshed where they will touch: for comparing contact with closed forms.
//
// The lower one has its flat face on z = 0, the upper one on z = 2 R + gap; their tips face each other across the gap
// in the middle of the box. Nodes of the curved faces lie on the sphere: hemispheres are not scaled to the exact
// volume, as packings are, since the curvature at the tip is what counts. Facets of a convex body lie inside it, so
// that the two cannot overlap. Interior nodes are moved to raise the smallest critical step. The upper mesh is the
// lower one mirrored and turned about the axis: no node meets a node.

#include <string>

#include "pack-gen/grain_mesh.hpp"

namespace mpfem {

/// Sizes of the two hemispheres and of their elements.
struct HemisphereRequest {
  double radius = 0;         ///< R, mm
  double size = 0;           ///< element size far from the contact, mm
  double contact_size = 0;   ///< on the curved face up to contact_radius from the tip, mm
  double contact_radius = 0; ///< along the face, mm
  double bulk_size = 0;      ///< in the half-ball of 1.5 contact_radius under the tip, mm
  double growth = 0.3;       ///< of the size per distance from both regions
  double gap = 0;            ///< mm, > 0
  double rotation = 37;      ///< of the upper hemisphere about the axis, degrees
  double box_width = 0;      ///< in x and y, mm; 0: 2.4 R
};

/// Both hemispheres, meshed, in their box.
struct Hemispheres {
  SpherePacking packing; ///< the full spheres, of which half lies in the box
  PackingMesh mesh;
  double tip_gap =
      0; ///< mm, proven distance of the two meshes: the request's gap, and how far facets lie inside the tips
};

/// Throws InputError for inconsistent sizes or too many tets, SimulationError if gmsh fails.
Hemispheres mesh_hemispheres(const HemisphereRequest& request);

/// How the tets of both hemispheres are distributed.
struct Refinement {
  double smallest_edge = 0;  ///< mm
  std::size_t tets_near = 0; ///< tets at whose middle an edge below twice the contact size was requested
};
/// Measures the meshes of `pair`, which mesh_hemispheres() has made for this request.
Refinement refinement(const HemisphereRequest& request, const Hemispheres& pair);

} // namespace mpfem
