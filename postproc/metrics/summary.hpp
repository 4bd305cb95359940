#pragma once
// The results of a run in a few numbers.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "results-schema/file.hpp"

namespace mpfem {

/// Results of a run, its quality and its cost.
struct Summary {
  std::vector<std::string> warnings; ///< what makes the results doubtful
  std::string status, version, host;
  std::int64_t tets = 0, grains = 0, steps = 0;
  int threads = 0;
  double wall_time = 0;                ///< s
  double nanoseconds_per_tet_step = 0; ///< wall-clock time over tets times steps, everything included
  double relative_density = 0, mean_stress = 0, deviatoric_stress = 0; ///< at the end; 1, MPa, MPa
  std::vector<std::pair<std::string, double>> energies;                ///< every term of the ledger at the end, mJ
  double largest_residual = 0;              ///< largest |energy residual| over the largest |external work|
  double kinetic_over_internal = 0;         ///< largest, while the mean stress is above a tenth of its largest
  double loaded_from_density = 0;           ///< smallest relative density of the rows used for kinetic_over_internal
  double kinetic_over_largest_internal = 0; ///< largest kinetic energy of all rows over largest internal energy
  std::optional<double> inertial_number, largest_inertial_number; ///< over the same rows; empty where not known
  std::optional<double> kinetic_small_from_density; ///< relative density from which the ratio stays <= 1 % to the end
  double largest_penetration = 0;                   ///< over h
  double largest_current_density = 0;               ///< current volume of the grains over the box's
  double smallest_time_step = 0, largest_time_step = 0;   ///< s
  double coordination_number = 0, contact_area_ratio = 0; ///< at the end
  struct Bonds {
    std::int64_t unbroken = 0;        ///< on both sides of every contact
    double area = 0, mean_damage = 0; ///< mm^2, 1
  };
  std::optional<Bonds> bonds; ///< at the end; empty where the run never had any
  std::vector<std::string> profile_name;
  std::vector<double> profile_share; ///< of the wall-clock time
};

/// Internal energy is that of the row's stage (internal_energy of history_table.hpp). Before jamming it is nearly zero
/// and the ratio of single rows has no meaning; therefore kinetic_over_internal uses rows under load only, and
/// kinetic_over_largest_internal the whole run. Throws InputError.
Summary summarise(const schema::FileReader& file);
/// All numbers by name.
nlohmann::ordered_json to_json(const Summary& summary);
/// A table of lines for the terminal.
std::string to_text(const Summary& summary);
/// CSV "name,value" of the numbers at the top level of the JSON.
std::string to_csv(const Summary& summary);

/// Total cost of several runs, a line "runs,tet_steps,wall_time_s,core_time_s"; core time is wall time times threads.
std::string cost_of_runs(const std::vector<Summary>& runs);

} // namespace mpfem
