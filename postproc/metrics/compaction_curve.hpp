#pragma once
// The curves of mean stress and contact area over relative density of a compaction, read at given densities, and its
// quality.

#include <optional>
#include <string>
#include <vector>

#include "postproc/run_data/history_table.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// `values` (one for each row) where each of these relative densities (ascending) is first reached, linear between the
/// two rows around it; empty for one that the run has not passed. A run that ends less than 1e-6 (rounding) below a
/// density has reached it.
std::vector<std::optional<double>> values_at_densities(const std::vector<double>& density,
                                                       const std::vector<double>& values,
                                                       const std::vector<double>& wanted);

/// The value is the stress (MPa) at the last of these densities; the details hold each as "at_0.80", the density with
/// two digits. Throws InputError where `wanted` is empty or does not ascend, or where its last density is not reached.
Measurement measure_stress_at_densities(const schema::FileReader& file, const std::vector<double>& wanted);

/// A curve from elsewhere: an experiment, another program. Relative densities ascend; stresses are in MPa.
struct CompactionCurve {
  std::vector<double> relative_density, mean_stress;
};

/// Reads a CSV file with the columns relative_density and mean_stress_MPa. Throws InputError.
CompactionCurve read_compaction_curve(const std::string& path);

/// CSV with the columns "name,relative_density [1],mean_stress [MPa],contact_area [mm^2]"; cells of a density that was
/// not reached are empty. With a reference, two stand before the area: its stress, and the run's stress over it.
std::string stress_at_densities_csv(const schema::FileReader& file, const std::vector<double>& wanted,
                                    const std::optional<CompactionCurve>& reference = {});

/// Over the rows from a relative density on, largest values of: kinetic over internal energy (the value), residual of
/// the energy balance over external work, penetration over element size, current volume of the grains over that of the
/// box, and the inertial number (also its median; null where not known). Throws InputError where no row is as dense.
Measurement measure_compaction_quality(const schema::FileReader& file, double from_density);

} // namespace mpfem
