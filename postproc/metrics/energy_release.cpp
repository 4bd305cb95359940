#include "postproc/metrics/energy_release.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/run_data/uncertainty.hpp"
#include "postproc/run_data/windows.hpp"

namespace mpfem {

namespace {

/// The unloading, or, where there is none, the run's last row.
struct Unloading {
  StageRows stage;
  RowRange scatter_rows; ///< from which the scatter is estimated
  bool found = true;
};

/// Throws InputError where there is no stage `number`.
Unloading find_unloading(const HistoryTable& history, const std::vector<StageRows>& stages, std::optional<int> number,
                         const std::string& path) {
  try {
    const StageRows& stage = choose_unloading(stages, number, history, path);
    return {stage, stage.rows(), true};
  } catch (const InputError&) {
    if (number) throw;
  }
  const std::size_t end = history.rows() - 1;
  return {{stages.back().number, stages.back().type, end, end, stages.back().name}, stages.back().rows(), false};
}

struct Energy {
  double value = 0, uncertainty = 0; ///< mJ
};

/// An energy of the ledger in one row.
Energy energy_in_row(const HistoryTable& history, const char* name, std::size_t row, RowRange scatter_rows) {
  return {history[name][row], energy_uncertainty(history, name, row, scatter_rows)};
}

/// Change of an energy of the ledger from the stage's first row to its last.
Energy energy_change(const HistoryTable& history, const char* name, const StageRows& stage) {
  if (stage.first == stage.last) return {};
  return {history[name][stage.last] - history[name][stage.first],
          energy_change_uncertainty(history, name, stage.rows())};
}

using NamedEnergies = std::vector<std::pair<std::string, Energy>>;

NamedEnergies energies_of(const HistoryTable& history, const Unloading& unloading, const Energy& released) {
  const StageRows& stage = unloading.stage;
  const auto state = [&](const char* name, std::size_t row) {
    return energy_in_row(history, name, row, unloading.scatter_rows);
  };
  const auto change = [&](const char* name) { return energy_change(history, name, stage); };
  return {{"elastic_energy_loaded", state("elastic_energy", stage.first)},
          {"elastic_energy_locked_in", state("elastic_energy", stage.last)},
          {"elastic_energy_released", released},
          {"plastic_dissipation", state("plastic_dissipation", stage.last)},
          {"plastic_dissipation_in_unloading", change("plastic_dissipation")},
          {"damage_dissipation", state("damage_dissipation", stage.last)},
          {"damage_dissipation_in_unloading", change("damage_dissipation")},
          {"bond_energy", state("bond_energy", stage.last)}};
}

nlohmann::ordered_json energies_json(const NamedEnergies& energies) {
  nlohmann::ordered_json json;
  for (const auto& [name, energy] : energies) {
    json[fmt::format("{}_mJ", name)] = energy.value;
    json[fmt::format("{}_uncertainty_mJ", name)] = energy.uncertainty;
  }
  return json;
}

/// Null where the scale is not known.
nlohmann::ordered_json energies_over_scale_json(const NamedEnergies& energies, const EnergyScale& scale) {
  const auto unit = scale.energy();
  const auto over_scale = [&](double value) {
    return number_or_null(unit ? std::optional(value / *unit) : std::nullopt);
  };
  nlohmann::ordered_json json = {{"youngs_modulus_of_grains_MPa", number_or_null(scale.youngs_modulus)},
                                 {"mean_radius_mm", number_or_null(scale.mean_radius)},
                                 {"energy_scale_mJ", number_or_null(unit)}};
  for (const auto& [name, energy] : energies) {
    json[fmt::format("{}_over_scale", name)] = over_scale(energy.value);
    json[fmt::format("{}_over_scale_uncertainty", name)] = over_scale(energy.uncertainty);
  }
  return json;
}

} // namespace

std::optional<double> EnergyScale::energy() const {
  if (!youngs_modulus || !mean_radius) return {};
  return *youngs_modulus * *mean_radius * *mean_radius * *mean_radius;
}

Measurement measure_energy(const schema::FileReader& file, std::optional<int> number, const EnergyScale& scale) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const Unloading unloading = find_unloading(history, stages, number, file.path());
  const StageRows& stage = unloading.stage;
  const Energy grown = energy_change(history, "elastic_energy", stage), released{-grown.value, grown.uncertainty};
  const NamedEnergies energies = energies_of(history, unloading, released);

  Measurement m;
  m.metric = "energy";
  m.unit = "mJ";
  m.value = released.value;
  m.uncertainty = released.uncertainty;
  m.uncertainty_meaning =
      "change of the ledger's residual in the stage and 95 % of the scatter of its first and its last "
      "rows about parabolas over time, added in quadrature";
  m.window = isotropic_window(history, stage, stage.rows());
  m.method = "elastic energy at the beginning of the unloading minus that at its end";
  m.brief =
      fmt::format("elastic energy released, {:.4g} mJ locked in; damage {:.3g} mJ, plastic {:.3g} mJ in the unloading",
                  history["elastic_energy"][stage.last], energy_change(history, "damage_dissipation", stage).value,
                  energy_change(history, "plastic_dissipation", stage).value);
  m.details = energies_json(energies);
  const auto& residual = history["energy_residual"];
  m.details["energy_residual_mJ"] = residual[stage.last];
  m.details["energy_residual_in_unloading_mJ"] = residual[stage.last] - residual[stage.first];
  m.details.update(energies_over_scale_json(energies, scale));
  if (!unloading.found)
    m.notes.emplace_back("the run has no unloading: nothing is released; energies are those at its end");
  if (m.value < 0) m.notes.emplace_back("the elastic energy grows in this stage: it is not an unloading");
  note_short_stage(m, unloading.scatter_rows);
  return m;
}

} // namespace mpfem
