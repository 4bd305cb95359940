#pragma once
// Contact of curved grains by their smooth surface.
//
// If the mesh of a convex grain has the grain's volume, its surface nodes lie outside the grain's surface and the
// middles of its facets inside. On average, facets meet the nodes of another grain where the surface is. But the nodes,
// which are pushed back, touch too early: by the mean height s of the smooth surface above the facets around a node.
// That is 0.5 % of the radius with five elements per radius. So each surface node n has a contact point a little inside
// its grain, towards an inner node i of the same tet,
//   x = (1 - a) x_n + a x_i,   a fixed in the mesh,   (x_n - x).n = s at the start.
// The gap is measured there, and both nodes share the force. A point that is a fixed mean of two nodes moves with the
// material: penalty and bonds keep their exact potentials, and momentum and angular momentum are conserved. As a
// contact flattens, s shrinks only with the layer of tets, so that flattened grains overlap by s.
//
// With unit normals n at the corners, a surface that is quadratic over a facet is above it by the sum over its edges of
// w_i w_j (n_j - n_i).(x_j - x_i)/2; the mean of w_i w_j is 1/12.

#include <vector>

#include "solver/model/model.hpp"

namespace mpfem {

/// Which grains touch by their smooth surface, [grains]: all or none, or with `surface` = automatic those that are
/// meshes of the packing's spheres with the spheres' volume. Only for these is it known that their nodes lie outside a
/// curved surface: a cube has edges, and the nodes of a sphere that is meshed with its nodes on it lie on its surface.
/// Collective.
std::vector<char> smooth_grains(const Model& model, const MeshedPacking& packing, ContactSurface surface,
                                const Communicator& ranks = Communicator());

/// Sets model.inner_node and model.inward of these grains ([grains]) from the mesh as it is; does nothing if there are
/// none. Nodes in concave places keep their place, and so do nodes on flat faces an element away from edges.
void find_smooth_surface(Model& model, const std::vector<char>& grains);

/// Largest distance (mm) of an own node from its contact point at present; 0 where contact takes the nodes themselves.
double max_contact_offset(const Model& model);

} // namespace mpfem
