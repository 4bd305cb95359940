#include "postproc/metrics/true_stress.hpp"

#include <algorithm>

#include "postproc/metrics/damage_onset.hpp"
#include "postproc/run_data/smoothing.hpp"
#include "postproc/run_data/stage_curve.hpp"

namespace mpfem {

std::vector<double> cross_section_growth(const HistoryTable& history, const StageRows& stage) {
  if (!history.has("mass_spread_0")) return {};
  const auto &x = history["mass_spread_0"], &y = history["mass_spread_1"];
  if (!(x[stage.first] * y[stage.first] > 0)) return {};
  std::vector<double> growth;
  for (std::size_t row = stage.first; row <= stage.last; ++row)
    growth.push_back(x[row] * y[row] / (x[stage.first] * y[stage.first]));
  return growth;
}

void add_true_stress(Measurement& m, const HistoryTable& history, const StageRows& stage) {
  if (m.details["test"] != "unconfined") return;
  m.details["nominal_strength_MPa"] = m.value;
  m.details["nominal_strength_uncertainty_MPa"] = m.uncertainty;
  for (const char* key :
       {"true_stress_at_strength_MPa", "true_stress_at_strength_uncertainty_MPa", "largest_true_stress_MPa",
        "axial_strain_at_largest_true_stress", "cross_section_growth_at_strength"})
    m.details[key] = nullptr;
  const std::vector<double> growth = cross_section_growth(history, stage);
  if (growth.empty()) return;
  const StageCurve c = stage_curve(history, stage, "");
  const auto strain = m.details["axial_strain_at_strength"].get<double>();
  const double at_strength = at_strain(c.axial_strain, strain, c.rows() - 1).of(growth);
  std::vector<double> stress = smoothed(c.axial_stress);
  for (std::size_t row = 0; row < stress.size(); ++row) stress[row] /= growth[row];
  const auto largest = static_cast<std::size_t>(std::max_element(stress.begin(), stress.end()) - stress.begin());
  m.details["true_stress_at_strength_MPa"] = m.value / at_strength;
  m.details["true_stress_at_strength_uncertainty_MPa"] = m.uncertainty / at_strength;
  m.details["largest_true_stress_MPa"] = stress[largest];
  m.details["axial_strain_at_largest_true_stress"] = c.axial_strain[largest];
  m.details["cross_section_growth_at_strength"] = at_strength;
}

} // namespace mpfem
