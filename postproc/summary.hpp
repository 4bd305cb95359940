#pragma once
// What a run came to, in a few numbers.

#include <string>

#include <nlohmann/json.hpp>

#include "results-schema/file.hpp"

namespace mpfem {

struct Summary {
  std::string status, version, host;
  std::int64_t tets = 0, grains = 0, steps = 0;
  int threads = 0;
  double wall_time = 0;                   ///< s
  double nanoseconds_per_tet_step = 0;    ///< wall-clock time over tets and steps, everything included
  double relative_density = 0, mean_stress = 0, deviatoric_stress = 0; ///< at the end
  double elastic_energy = 0, plastic_dissipation = 0, external_work = 0; ///< mJ, at the end
  double largest_residual = 0;            ///< |energy residual| over the largest external work
  double kinetic_over_internal = 0;       ///< largest, while the mean stress is above a tenth of its largest
  double kinetic_over_internal_from_density = 0; ///< relative density from which kinetic/internal stays <= 1 %
  double largest_penetration = 0;         ///< over h
  double smallest_time_step = 0, largest_time_step = 0; ///< s
  double coordination_number = 0, contact_area_ratio = 0; ///< at the end
  std::vector<std::string> profile_name;
  std::vector<double> profile_share;      ///< of the wall-clock time
};

/// Throws InputError.
Summary summarise(const schema::FileReader& file);
nlohmann::ordered_json to_json(const Summary& summary);
std::string to_text(const Summary& summary);

} // namespace mpfem
