#pragma once
// Mean radius of a run's grains.

#include <optional>
#include <string>

#include "results-schema/file.hpp"

namespace mpfem {

/// Mean of the sphere radii of a packing file (mm). Throws InputError.
double mean_radius_of_packing(const std::string& path);

/// From a run's first snapshot: mean radius of spheres with the grains' volumes, which are scaled to the reference
/// volume that relative density and box give, so that elastic compression does not count (mm). Nothing without a
/// snapshot.
std::optional<double> mean_radius_of_run(const schema::FileReader& file);

} // namespace mpfem
