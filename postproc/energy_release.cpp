#include "postproc/energy_release.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

std::optional<double> EnergyScale::energy() const {
  if (!youngs_modulus || !mean_radius) return {};
  return *youngs_modulus * *mean_radius * *mean_radius * *mean_radius;
}

Measurement measure_energy(const schema::FileReader& file, std::optional<int> number, const EnergyScale& scale) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  Measurement m;
  m.metric = "energy";
  m.unit = "mJ";
  StageRows stage{stages.back().number, stages.back().type, history.rows() - 1, history.rows() - 1};
  try {
    stage = choose_unloading(stages, number, history, file.path());
  } catch (const InputError&) {
    if (number) throw;
    m.notes.emplace_back("the run has no unloading: nothing is released, and energies are those of its end");
  }
  const auto at = [&](const char* name, std::size_t row) { return history[name][row]; };
  const auto grown = [&](const char* name) { return at(name, stage.last) - at(name, stage.first); };
  m.value = -grown("elastic_energy");
  m.uncertainty = std::abs(grown("energy_residual"));
  m.uncertainty_meaning = "change of the ledger's residual in the stage";
  m.window.stage = stage.number;
  m.window.stage_type = stage.type;
  m.window.first_row = stage.first;
  m.window.last_row = stage.last;
  m.window.strain_name = "volumetric_strain";
  m.window.strain = range_of(history["volumetric_strain"], stage.first, stage.last);
  m.window.stress_name = "mean_stress";
  m.window.stress = range_of(history["mean_stress"], stage.first, stage.last);
  m.method = "elastic energy at the beginning of the unloading less that at its end";
  if (m.value < 0) m.notes.emplace_back("the elastic energy grows in this stage: it is no unloading");

  const std::vector<std::pair<std::string, double>> energies = {
      {"elastic_energy_loaded", at("elastic_energy", stage.first)},
      {"elastic_energy_locked_in", at("elastic_energy", stage.last)},
      {"elastic_energy_released", m.value},
      {"plastic_dissipation", at("plastic_dissipation", stage.last)},
      {"plastic_dissipation_in_unloading", grown("plastic_dissipation")},
      {"damage_dissipation", at("damage_dissipation", stage.last)},
      {"damage_dissipation_in_unloading", grown("damage_dissipation")},
      {"bond_energy", at("bond_energy", stage.last)}};
  m.brief =
      fmt::format("elastic energy released, {:.4g} mJ locked in; damage {:.3g} mJ, plastic {:.3g} mJ in the unloading",
                  at("elastic_energy", stage.last), grown("damage_dissipation"), grown("plastic_dissipation"));
  for (const auto& [name, value] : energies) m.details[fmt::format("{}_mJ", name)] = value;
  const auto number_or_null = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  const auto unit = scale.energy();
  m.details["youngs_modulus_of_grains_MPa"] = number_or_null(scale.youngs_modulus);
  m.details["mean_radius_mm"] = number_or_null(scale.mean_radius);
  m.details["energy_scale_mJ"] = number_or_null(unit);
  for (const auto& [name, value] : energies)
    m.details[fmt::format("{}_over_scale", name)] = number_or_null(unit ? std::optional(value / *unit) : std::nullopt);
  return m;
}

} // namespace mpfem
