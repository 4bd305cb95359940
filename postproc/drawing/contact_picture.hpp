#pragma once
// Picture of the damage of one contact.

#include <string>

#include "postproc/drawing/raster.hpp"
#include "postproc/metrics/contact_map.hpp"

namespace mpfem {

/// How a contact is drawn.
struct ContactPictureRequest {
  std::string title; ///< default: the grains and the relative density
  int pixels = 900;
  bool mesh_lines = false; ///< edges between the nodes' patches
};

/// The bonds of one side of the contact as patches, projected on the contact's plane. A node's patch consists of a
/// third of each of its surface facets, bounded by the facet's medians: the node's tributary area. `tet` of a polygon
/// is the number of its bond in `map.bonds`. The side is the one with more bonds, the first grain's where both have as
/// many.
std::vector<SectionPolygon> contact_patches(const Snapshot& snapshot, const ContactMap& map);

/// Writes the PNG: damage on a scale from 0 to 1 in the contact's plane, seen against the normal. Throws InputError
/// where the pair never had a bond, SimulationError where gnuplot is missing or fails, StorageError where the file
/// cannot be written.
void write_contact_picture(const std::string& path, const Snapshot& snapshot, const ContactMap& map,
                           const ContactPictureRequest& request);

} // namespace mpfem
