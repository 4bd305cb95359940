#include "postproc/metrics/triaxial_test.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

namespace {

/// Lengths of the box and stresses of its walls, row by row, in a stage that begins at row `first`.
class Sample {
public:
  Sample(const HistoryTable& history, std::size_t first)
      : h_(history), first_(first), x_(history["box_lengths_0"]), y_(history["box_lengths_1"]),
        z_(history["box_lengths_2"]) {}

  /// Logarithmic, since the stage began, compression positive.
  double axial_strain(std::size_t row) const { return std::log(z_[first_] / z_[row]); }
  double volumetric_strain(std::size_t row) const {
    return std::log(x_[first_] * y_[first_] * z_[first_] / (x_[row] * y_[row] * z_[row]));
  }
  /// Force of the lateral walls over that of `lateral_stress` (MPa) on them at the beginning.
  double lateral_force_ratio(std::size_t row, double lateral_stress) const {
    const double force = (h_["wall_stress_2"][row] + h_["wall_stress_3"][row]) / 2 * x_[row] * z_[row] +
                         (h_["wall_stress_0"][row] + h_["wall_stress_1"][row]) / 2 * y_[row] * z_[row];
    return force / (lateral_stress * (y_[first_] * z_[first_] + x_[first_] * z_[first_]));
  }

private:
  const HistoryTable& h_;
  std::size_t first_;
  const std::vector<double>&x_, &y_, &z_; ///< mm
};

/// Rows of the extremes of a test.
struct TurningRows {
  std::size_t largest_q, most_contracted;
};

TurningRows turning_rows(const HistoryTable& h, const Sample& sample, RowRange rows) {
  const auto& q = h["deviatoric_stress"];
  TurningRows turning{rows.first, rows.first};
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    if (q[row] > q[turning.largest_q]) turning.largest_q = row;
    if (sample.volumetric_strain(row) > sample.volumetric_strain(turning.most_contracted))
      turning.most_contracted = row;
  }
  return turning;
}

/// Relative error of the lateral force beyond an axial strain of 2 %.
struct ForceError {
  double largest = 0, root_mean_square = 0;
};

ForceError lateral_force_error(const Sample& sample, RowRange rows, double lateral_stress) {
  double largest = 0, squares = 0, counted = 0;
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    if (sample.axial_strain(row) <= 0.02) continue;
    const double error = std::abs(sample.lateral_force_ratio(row, lateral_stress) - 1);
    largest = std::max(largest, error);
    squares += error * error;
    ++counted;
  }
  return {largest, counted > 0 ? std::sqrt(squares / counted) : 0};
}

nlohmann::ordered_json details_of(const HistoryTable& h, const Sample& sample, RowRange rows, double lateral_stress) {
  const std::size_t last = rows.last;
  const auto& q = h["deviatoric_stress"];
  const auto [largest_q, most_contracted] = turning_rows(h, sample, rows);
  const ForceError force_error = lateral_force_error(sample, rows, lateral_stress);
  const auto strain = [&](std::size_t row) { return sample.axial_strain(row); };
  // An extreme within the last hundredth of the strain counts as at the end: it has not been passed.
  const auto place = [&](std::size_t row) { return strain(row) < 0.99 * strain(last) ? strain(row) : strain(last); };
  const auto since = [&](const char* column) { return h[column][last] - h[column][rows.first]; };
  return {{"axial_strain_at_end", strain(last)},
          {"volumetric_strain_at_end", sample.volumetric_strain(last)},
          {"largest_deviatoric_stress_MPa", q[largest_q]},
          {"axial_strain_at_largest_deviatoric_stress", strain(largest_q)},
          {"place_of_largest_deviatoric_stress", place(largest_q)},
          {"fall_from_largest_deviatoric_stress", 1 - q[last] / q[largest_q]},
          {"axial_strain_at_largest_contraction", strain(most_contracted)},
          {"place_of_largest_contraction", place(most_contracted)},
          {"plastic_dissipation_mJ", since("plastic_dissipation")},
          {"damage_dissipation_mJ", since("damage_dissipation")},
          {"mean_damage_at_end", h["mean_damage"][last]},
          {"lateral_force_error", force_error.largest},
          {"lateral_force_error_root_mean_square", force_error.root_mean_square}};
}

} // namespace

Measurement triaxial_test(const HistoryTable& h, const StageRows& stage, double lateral_stress,
                          const std::optional<GrainInertia>& grains) {
  const Sample sample(h, stage.first);
  const Inertia inertia = inertia_of_rows(h, own_rows(h, stage), grains);
  const auto& q = h["deviatoric_stress"];
  Measurement m;
  m.metric = "triaxial";
  m.value = q[stage.last];
  m.unit = "MPa";
  m.uncertainty_meaning = "not known: read at the last row";
  m.window.stage = stage.number;
  m.window.stage_type = stage.type;
  m.window.first_row = stage.first;
  m.window.last_row = stage.last;
  m.window.strain = {0, sample.axial_strain(stage.last)};
  m.window.stress_name = "deviatoric_stress";
  m.window.stress = range_of(q, stage.first, stage.last);
  m.method = "deviatoric stress at the end of the stage";
  m.details = details_of(h, sample, stage.rows(), lateral_stress);
  m.details["kinetic_over_internal"] = inertia.kinetic_over_internal;
  m.details["inertial_number"] = number_or_null(inertia.inertial_number);
  m.details["largest_inertial_number"] = number_or_null(inertia.largest_inertial_number);
  return m;
}

Measurement measure_triaxial_test(const schema::FileReader& file, std::optional<int> number, double lateral_stress) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  return triaxial_test(history, need_stage_of_type(stages, number, {"triaxial_compression"}, file.path()),
                       lateral_stress, grain_inertia(file, history));
}

} // namespace mpfem
