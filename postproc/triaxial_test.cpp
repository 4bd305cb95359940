#include "postproc/triaxial_test.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

Measurement triaxial_test(const HistoryTable& h, const StageRows& stage, double lateral_stress) {
  const std::size_t first = stage.first, last = stage.last;
  const auto& x = h["box_lengths_0"];
  const auto& y = h["box_lengths_1"];
  const auto& z = h["box_lengths_2"];
  const auto& q = h["deviatoric_stress"];
  const auto strain = [&](std::size_t row) { return std::log(z[first] / z[row]); };
  const auto volumetric = [&](std::size_t row) {
    return std::log(x[first] * y[first] * z[first] / (x[row] * y[row] * z[row]));
  };
  const auto force_ratio = [&](std::size_t row) {
    const double force = (h["wall_stress_0"][row] + h["wall_stress_1"][row]) / 2 * y[row] * z[row] +
                         (h["wall_stress_2"][row] + h["wall_stress_3"][row]) / 2 * x[row] * z[row];
    return force / (lateral_stress * (y[first] * z[first] + x[first] * z[first]));
  };
  std::size_t largest_q = first, most_contracted = first;
  double force_error = 0, squares = 0, counted = 0, kinetic = 0;
  for (std::size_t row = first; row <= last; ++row) {
    if (q[row] > q[largest_q]) largest_q = row;
    if (volumetric(row) > volumetric(most_contracted)) most_contracted = row;
    if (internal_energy(h, row) > 0) kinetic = std::max(kinetic, h["kinetic_energy"][row] / internal_energy(h, row));
    if (strain(row) <= 0.02) continue;
    const double error = std::abs(force_ratio(row) - 1);
    force_error = std::max(force_error, error);
    squares += error * error;
    ++counted;
  }
  // What stands within the last hundredth of the test has not been passed.
  const auto place = [&](std::size_t row) { return strain(row) < 0.99 * strain(last) ? strain(row) : strain(last); };
  const auto since = [&](const char* column) { return h[column][last] - h[column][first]; };
  Measurement m;
  m.metric = "triaxial";
  m.value = q[last];
  m.unit = "MPa";
  m.uncertainty_meaning = "none: read at the last row";
  m.window.stage = stage.number;
  m.window.stage_type = stage.type;
  m.window.first_row = first;
  m.window.last_row = last;
  m.window.strain = {0, strain(last)};
  m.window.stress_name = "deviatoric_stress";
  m.window.stress = range_of(q, first, last);
  m.method = "deviatoric stress at the end of the stage";
  m.details = {{"axial_strain_at_end", strain(last)},
               {"volumetric_strain_at_end", volumetric(last)},
               {"largest_deviatoric_stress_MPa", q[largest_q]},
               {"axial_strain_at_largest_deviatoric_stress", strain(largest_q)},
               {"place_of_largest_deviatoric_stress", place(largest_q)},
               {"fall_from_largest_deviatoric_stress", 1 - q[last] / q[largest_q]},
               {"axial_strain_at_largest_contraction", strain(most_contracted)},
               {"place_of_largest_contraction", place(most_contracted)},
               {"plastic_dissipation_mJ", since("plastic_dissipation")},
               {"damage_dissipation_mJ", since("damage_dissipation")},
               {"mean_damage_at_end", h["mean_damage"][last]},
               {"lateral_force_error", force_error},
               {"lateral_force_error_root_mean_square", counted > 0 ? std::sqrt(squares / counted) : 0},
               {"kinetic_over_internal", kinetic}};
  return m;
}

Measurement measure_triaxial_test(const schema::FileReader& file, std::optional<int> number, double lateral_stress) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  return triaxial_test(history, choose_stage(stages, number, {"triaxial_compression"}, file.path()), lateral_stress);
}

} // namespace mpfem
