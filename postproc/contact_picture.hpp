#pragma once
// The damage of one contact as a picture.

#include <string>

#include "postproc/contact_map.hpp"
#include "postproc/raster.hpp"

namespace mpfem {

struct ContactPictureRequest {
  std::string title; ///< default: the grains and the relative density
  int pixels = 900;
  bool mesh_lines = false; ///< edges between the nodes' patches
};

/// The patches of the bonds of one side, projected on the contact's plane: around each node the part of its adjacent
/// surface facets that is nearest to it in the sense of medians (a third of each facet, the node's tributary area).
/// `tet` of a polygon is the number of its bond in `map.bonds`. The side with more bonds; the first grain's where both
/// have as many.
std::vector<SectionPolygon> contact_patches(const Snapshot& snapshot, const ContactMap& map);

/// Writes the PNG: damage on a scale from 0 to 1 in the contact's plane, seen against the normal. Throws InputError
/// where the pair never had a bond, SimulationError where gnuplot is missing or fails, StorageError.
void write_contact_picture(const std::string& path, const Snapshot& snapshot, const ContactMap& map,
                           const ContactPictureRequest& request);

} // namespace mpfem
