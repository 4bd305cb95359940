#include "postproc/metrics/quasi_static.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

Measurement quasi_static(const HistoryTable& history, const StageRows& stage,
                         const std::optional<GrainInertia>& grains) {
  std::vector<std::size_t> rows = own_rows(history, stage);
  if (rows.empty()) rows.push_back(stage.last);
  const auto& upper = history["wall_stress_5"];
  const auto& lower = history["wall_stress_4"];
  const auto& residual = history["energy_residual"];
  const auto& work = history["external_work"];
  const auto axial = [&](std::size_t row) { return (upper[row] + lower[row]) / 2; };
  std::size_t peak = 0;
  double largest_residual = 0, largest_work = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (axial(rows[i]) > axial(rows[peak])) peak = i;
    largest_residual = std::max(largest_residual, std::abs(residual[rows[i]] - residual.front()));
    largest_work = std::max(largest_work, std::abs(work[rows[i]] - work.front()));
  }
  const bool rises = 10 * (peak + 1) > rows.size(); // otherwise the stress is largest at the beginning: an unloading
  double of_elastic = 0, difference = 0, stress = 0;
  std::vector<std::size_t> loaded;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t row = rows[i];
    if (axial(row) < axial(rows[peak]) / 5 || (rises && i > peak)) continue;
    const double kinetic = history["kinetic_energy"][row], elastic = history["elastic_energy"][row];
    loaded.push_back(row);
    if (elastic > 0) of_elastic = std::max(of_elastic, kinetic / elastic);
    difference += std::abs(upper[row] - lower[row]);
    stress += axial(row);
  }
  const Inertia inertia = inertia_of_rows(history, loaded, grains);
  Measurement m;
  m.metric = "quasi-static";
  m.value = inertia.kinetic_over_internal;
  m.uncertainty_meaning = "not known: a largest value over rows";
  m.window.stage = stage.number;
  m.window.stage_type = stage.type;
  m.window.first_row = rows.front();
  m.window.last_row = rows.back();
  m.window.strain = range_of(history["axial_strain"], rows.front(), rows.back());
  m.window.stress = {axial(rows.front()), axial(rows[peak])};
  m.method = "largest kinetic over the stage's internal energy in rows above a fifth of the largest axial stress";
  m.details = {{"kinetic_over_internal", inertia.kinetic_over_internal},
               {"kinetic_over_elastic", of_elastic},
               {"imbalance", stress > 0 ? difference / stress : 0},
               {"residual_over_work", largest_work > 0 ? largest_residual / largest_work : 0},
               {"inertial_number", number_or_null(inertia.inertial_number)},
               {"largest_inertial_number", number_or_null(inertia.largest_inertial_number)}};
  return m;
}

Measurement measure_quasi_static(const schema::FileReader& file, std::optional<int> number) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  return quasi_static(history, number ? stage_by_number(stages, *number, file.path()) : stages.back(),
                      grain_inertia(file, history));
}

} // namespace mpfem
