#pragma once
// Statistics of a plane section: stress weighted by area, damage by length.

#include "postproc/drawing/damage_section.hpp"
#include "postproc/run_data/measurement.hpp"

namespace mpfem {

/// Mean, median, 95th and 99th percentile and largest value of a field, in its unit, and the share of the area in which
/// it is above `threshold`.
struct SectionStress {
  double mean = 0, median = 0, percentile_95 = 0, percentile_99 = 0, largest = 0, share_above = 0;
};

/// Throws InputError where there is no area.
SectionStress section_stress(std::vector<std::pair<double, double>> value_and_area, double threshold);

/// Bonded length (mm), its mean damage, and the share of it with a damage of `threshold` or more. Segments that were
/// never bonded are left out.
struct SectionDamage {
  double bonded_length = 0, mean = 0, share_above = 0;
};
/// All zero where no segment was ever bonded.
SectionDamage section_damage(const std::vector<BoundarySegment>& segments, double threshold);

/// Statistics on the middle plane of a snapshot (numbered as in snapshot_name) normal to `axis` (0, 1, 2); the values
/// are the mean von Mises stress (MPa, as `threshold`) and the mean damage. Throws InputError.
Measurement measure_section_stress(const schema::FileReader& file, int snapshot, int axis, double threshold);
/// The same for damage; `threshold` is a damage, 0 … 1.
Measurement measure_section_damage(const schema::FileReader& file, int snapshot, int axis, double threshold);

} // namespace mpfem
