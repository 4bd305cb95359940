#include "postproc/energy_release.hpp"

#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "postproc/uncertainty.hpp"

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
  RowRange scatter_rows = stages.back().rows(); // that tell the rows' scatter
  try {
    stage = choose_unloading(stages, number, history, file.path());
    scatter_rows = stage.rows();
  } catch (const InputError&) {
    if (number) throw;
    m.notes.emplace_back("the run has no unloading: nothing is released, and energies are those of its end");
  }
  struct Energy {
    double value, uncertainty; ///< mJ
  };
  const auto state = [&](const char* name, std::size_t row) {
    return Energy{history[name][row], energy_uncertainty(history, name, row, scatter_rows)};
  };
  const auto change = [&](const char* name) {
    if (stage.first == stage.last) return Energy{0, 0};
    return Energy{history[name][stage.last] - history[name][stage.first],
                  energy_change_uncertainty(history, name, stage.rows())};
  };
  const Energy grown = change("elastic_energy"), released{-grown.value, grown.uncertainty};
  m.value = released.value;
  m.uncertainty = released.uncertainty;
  m.uncertainty_meaning =
      "change of the ledger's residual in the stage and 95 % of the scatter of its first and its last "
      "rows about parabolas over time, as hypotenuse";
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

  const std::vector<std::pair<std::string, Energy>> energies = {
      {"elastic_energy_loaded", state("elastic_energy", stage.first)},
      {"elastic_energy_locked_in", state("elastic_energy", stage.last)},
      {"elastic_energy_released", released},
      {"plastic_dissipation", state("plastic_dissipation", stage.last)},
      {"plastic_dissipation_in_unloading", change("plastic_dissipation")},
      {"damage_dissipation", state("damage_dissipation", stage.last)},
      {"damage_dissipation_in_unloading", change("damage_dissipation")},
      {"bond_energy", state("bond_energy", stage.last)}};
  m.brief = fmt::format(
      "elastic energy released, {:.4g} mJ locked in; damage {:.3g} mJ, plastic {:.3g} mJ in the unloading",
      history["elastic_energy"][stage.last], change("damage_dissipation").value, change("plastic_dissipation").value);
  for (const auto& [name, energy] : energies) {
    m.details[fmt::format("{}_mJ", name)] = energy.value;
    m.details[fmt::format("{}_uncertainty_mJ", name)] = energy.uncertainty;
  }
  m.details["energy_residual_mJ"] = history["energy_residual"][stage.last];
  m.details["energy_residual_in_unloading_mJ"] =
      history["energy_residual"][stage.last] - history["energy_residual"][stage.first];
  const auto number_or_null = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
  };
  const auto unit = scale.energy();
  m.details["youngs_modulus_of_grains_MPa"] = number_or_null(scale.youngs_modulus);
  m.details["mean_radius_mm"] = number_or_null(scale.mean_radius);
  m.details["energy_scale_mJ"] = number_or_null(unit);
  for (const auto& [name, energy] : energies) {
    const auto over_scale = [&](double value) {
      return number_or_null(unit ? std::optional(value / *unit) : std::nullopt);
    };
    m.details[fmt::format("{}_over_scale", name)] = over_scale(energy.value);
    m.details[fmt::format("{}_over_scale_uncertainty", name)] = over_scale(energy.uncertainty);
  }
  note_short_stage(m, scatter_rows);
  return m;
}

} // namespace mpfem
