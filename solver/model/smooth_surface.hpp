#pragma once
// Contact of curved grains as their smooth surface has it.
//
// A convex grain that is meshed with its volume has its surface nodes outside its surface and the middles of its facets inside.
// Facets meet the nodes of another grain on the average where the surface is, but the nodes, which are what is pressed back,
// come too early: by the mean height s of the smooth surface above the facets around a node, 0.5 % of the radius with five elements to
// it. So each surface node n has a contact point a little inside its grain, towards an inner node i of the same tet,
//   x = (1 - a) x_n + a x_i,   a fixed in the mesh,   (x_n - x).n = s at the start,
// whose gap is measured, and whose force is shared by both nodes alike. A point that is a fixed mean of two nodes moves with the
// material: penalty and bonds keep their exact potentials, momentum and angular momentum are kept, and as a contact
// flattens s shrinks with the layer of tets alone, so that flattened grains overlap by it.
//
// With unit normals n at the corners, a surface that is quadratic over a facet stands above it by the sum over its edges of
// w_i w_j (n_j - n_i).(x_j - x_i)/2; the mean of w_i w_j is 1/12.

#include <vector>

#include "solver/model/model.hpp"

namespace mpfem {

/// Which grains touch by their smooth surface, [grains]: all or none, or those that `surface` = automatic finds to be meshes of
/// the packing's spheres with the spheres' volume. Only of these it is known that their nodes stand out of a curved surface: a
/// cube has edges, and a sphere that is meshed with its nodes on it has none that stand out.
std::vector<bool> smooth_grains(const Model& model, const MeshedPacking& packing, ContactSurface surface);

/// Sets model.inner_node and model.inward of these grains ([grains]) from the mesh as it is, and model.normal on the way; nothing where there are none.
/// Concave places keep their nodes, and flat ones an element away from edges.
void find_smooth_surface(Model& model, const std::vector<bool>& grains);

/// mm, of a node from its contact point, at present; 0 where contact takes the nodes themselves.
double largest_stand_out(const Model& model);

} // namespace mpfem
