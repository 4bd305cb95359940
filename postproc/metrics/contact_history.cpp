#include "postproc/metrics/contact_history.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "postproc/run_data/stages.hpp"
#include "postproc/run_data/uncertainty.hpp"

namespace mpfem {

std::vector<Column> contact_history(const HistoryTable& history) {
  std::vector<Column> columns;
  for (const char* name : {"time", "stage", "relative_density", "mean_stress", "axial_strain"})
    columns.push_back(history.column(name));
  const auto ratio = [&](const char* area, const char* name) {
    Column column{name, "1", {}};
    for (std::size_t row = 0; row < history.rows(); ++row) {
      const double surface = history["surface_area"][row];
      column.values.push_back(surface > 0 ? history[area][row] / surface : 0.0);
    }
    columns.push_back(std::move(column));
  };
  ratio("contact_area", "contact_area_ratio");
  ratio("bonded_area", "bonded_area_ratio");
  for (const char* name : {"coordination_number", "bonds", "mean_damage", "damage_dissipation"})
    columns.push_back(history.column(name));
  return columns;
}

Measurement measure_contact(const schema::FileReader& file, std::optional<int> number) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const StageRows& stage = choose_stage(stages, number, {}, file.path());
  const std::vector<Column> columns = contact_history(history);
  const auto column = [&](std::string_view name) -> const std::vector<double>& {
    return std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; })->values;
  };
  const auto& ratio = column("contact_area_ratio");
  Measurement m;
  m.metric = "contact";
  m.value = ratio[stage.last];
  m.window.stage = stage.number;
  m.window.stage_type = stage.type;
  const RowRange last_rows = rows_about(stage.last, stage.rows());
  m.window.first_row = last_rows.first;
  m.window.last_row = last_rows.last;
  m.uncertainty = row_uncertainty(history, ratio, stage.last, stage.rows());
  m.uncertainty_meaning =
      "95 % of a row's scatter, by the stage's last rows about their parabola over time; not that of the mesh";
  m.window.strain = range_of(history["axial_strain"], m.window.first_row, m.window.last_row);
  m.window.stress_name = "mean_stress";
  m.window.stress = range_of(history["mean_stress"], m.window.first_row, m.window.last_row);
  m.method =
      "area of grain surface in contact with other grains over total grain surface, at the stage's last row; axial "
      "strain since the run began";
  const auto uncertainty = [&](std::string_view name, std::size_t row) {
    return name == "damage_dissipation" ? energy_uncertainty(history, name, row, stage.rows())
                                        : row_uncertainty(history, column(name), row, stage.rows());
  };
  for (const std::string_view name : {"contact_area_ratio", "bonded_area_ratio", "coordination_number", "bonds",
                                      "mean_damage", "damage_dissipation", "relative_density", "mean_stress"})
    for (const auto& [place, row] : {std::pair{"start", stage.first}, std::pair{"end", stage.last}}) {
      m.details[fmt::format("{}_at_{}", name, place)] = column(name)[row];
      if (name != "relative_density") // known exactly from the box
        m.details[fmt::format("{}_at_{}_uncertainty", name, place)] = uncertainty(name, row);
    }
  note_short_stage(m, stage.rows());
  m.brief = fmt::format("contact area over surface, coordination number {:.2f}, mean damage {:.3g}",
                        column("coordination_number")[stage.last], column("mean_damage")[stage.last]);
  return m;
}

} // namespace mpfem
