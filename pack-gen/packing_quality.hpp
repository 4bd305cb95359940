#pragma once
// Properties of a packing, as numbers by name and as tables: for `pack-gen quality -o`.

#include <string>

#include "pack-gen/mesh_report.hpp"
#include "pack-gen/packing_description.hpp"

namespace mpfem {

/// JSON of grains, relative_density, smallest_gap_mm (between spheres and to the walls), the mesh's nodes, tets,
/// tets_per_grain, smallest_quality, smallest_facet_gap_mm … and, where a description is given, size_distance, the
/// largest distance between the cumulative curve of the spheres (at each sphere's middle, (i + 1/2)/n) and that of the
/// description.
std::string quality_json(const SpherePacking& packing, const MeshReport& mesh, const PackingDescription* description);

/// CSV of diameter (mm) and cumulative fraction by number at each sphere's middle, ascending.
std::string sizes_csv(const SpherePacking& packing);

/// CSV of diameter (mm) and cumulative fraction by number at the sizes of a description's table. Throws InputError if
/// its sizes are no table.
std::string target_csv(const PackingDescription& description);

} // namespace mpfem
