#pragma once
// Mean radius of a run's grains.

#include <optional>
#include <string>

#include "results-schema/file.hpp"

namespace mpfem {

/// Mean of the sphere radii of a packing file (mm). Throws InputError where it is not the packing of this run.
double mean_radius_of_packing(const std::string& path, const schema::FileReader& run);

/// Mean radius (mm) of spheres with the grains' volumes, from a run's first snapshot. The volumes are scaled to the
/// reference volume given by relative density and box, so that elastic compression does not count. Empty without a
/// snapshot.
std::optional<double> mean_radius_of_run(const schema::FileReader& file);

} // namespace mpfem
