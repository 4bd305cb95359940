#pragma once
// The curve of mean stress over relative density of a compaction, read at given densities, and how sound it is.

#include <optional>
#include <string>
#include <vector>

#include "postproc/history_table.hpp"
#include "postproc/measurement.hpp"

namespace mpfem {

/// Mean stress (MPa) at each of these relative densities (ascending), between the rows around each; nothing for one
/// that the run has not passed. A run that ends a rounding (1e-6) below a density has reached it.
std::vector<std::optional<double>> stress_at_densities(const std::vector<double>& density,
                                                       const std::vector<double>& stress,
                                                       const std::vector<double>& wanted);

/// The last of these stresses, and each as "at_0.80"; the densities as printed with two digits.
/// Throws InputError where `wanted` is empty or does not rise.
Measurement measure_stress_at_densities(const schema::FileReader& file, const std::vector<double>& wanted);

/// A curve of other origin: an experiment, another program. Relative densities ascend, stress in MPa.
struct CompactionCurve {
  std::vector<double> relative_density, mean_stress;
};

/// Of a CSV file with the columns relative_density and mean_stress_MPa. Throws InputError.
CompactionCurve read_compaction_curve(const std::string& path);

/// CSV "name,relative_density [1],mean_stress [MPa]", an empty cell for a density that was not passed; with a reference
/// also its stress and the run's over it.
std::string stress_at_densities_csv(const schema::FileReader& file, const std::vector<double>& wanted,
                                    const std::optional<CompactionCurve>& reference = {});

/// Over the rows from a relative density on: largest kinetic over internal energy, residual of the energy balance over
/// external work, penetration over the element size, inertial number (null where it is not known) and present volume of
/// the grains over the box's. Throws InputError where no row is as dense.
Measurement measure_compaction_quality(const schema::FileReader& file, double from_density);

} // namespace mpfem
