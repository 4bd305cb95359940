#include "postproc/run_data/contact.hpp"

#include <cmath>

#include "postproc/run_data/snapshot.hpp"

namespace mpfem {

ContactTable contact_table(const schema::FileReader& file, int snapshot) {
  namespace run = schema::run;
  const std::string name = snapshot_name(file, snapshot);
  const auto grains = file.read(run::snapshots_pair_grains, name);
  const auto force = file.read(run::snapshots_pair_force, name), area = file.read(run::snapshots_pair_area, name);
  ContactTable table;
  table.relative_density = file.read_scalar(run::snapshots_relative_density, name);
  table.mean_stress = file.read_scalar(run::snapshots_mean_stress, name);
  table.columns = {{"first", "1", {}},   {"second", "1", {}}, {"force_x", "N", {}}, {"force_y", "N", {}},
                   {"force_z", "N", {}}, {"force", "N", {}},  {"area", "mm^2", {}}, {"pressure", "MPa", {}}};
  for (std::size_t pair = 0; pair < area.size(); ++pair) {
    const double* f = force.data() + 3 * pair;
    const double magnitude = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    const double row[] = {static_cast<double>(grains[2 * pair]),
                          static_cast<double>(grains[2 * pair + 1]),
                          f[0],
                          f[1],
                          f[2],
                          magnitude,
                          area[pair],
                          area[pair] > 0 ? magnitude / area[pair] : 0.0};
    for (std::size_t c = 0; c < table.columns.size(); ++c) table.columns[c].values.push_back(row[c]);
  }
  const auto add_where_present = [&](const schema::Dataset<double, 1>& dataset, const char* column) {
    if (file.has(dataset, name)) table.columns.push_back({column, std::string(dataset.unit), file.read(dataset, name)});
  };
  add_where_present(run::snapshots_pair_bonded_area, "bonded_area");
  add_where_present(run::snapshots_pair_damage, "damage");
  add_where_present(run::snapshots_pair_bond_energy, "bond_energy");
  add_where_present(run::snapshots_pair_damage_dissipation, "damage_dissipation");
  const auto grain_count = static_cast<double>(file.rows(run::mesh_grain_tet_offset)) - 1;
  table.coordination_number = 2 * static_cast<double>(area.size()) / grain_count;

  const HistoryTable history(file, NotFinite::kept); // a snapshot may be sound though the run diverged later
  const double time = file.read_scalar(run::snapshots_time, name);
  std::size_t nearest = 0;
  for (std::size_t row = 0; row < history.rows(); ++row)
    if (std::abs(history["time"][row] - time) < std::abs(history["time"][nearest] - time)) nearest = row;
  if (const double surface = history["surface_area"][nearest]; surface > 0)
    table.contact_area_ratio = history["contact_area"][nearest] / surface;
  return table;
}

nlohmann::ordered_json to_json(const ContactTable& table) {
  nlohmann::ordered_json json = {{"relative_density", table.relative_density},
                                 {"mean_stress_MPa", table.mean_stress},
                                 {"coordination_number", table.coordination_number},
                                 {"contact_area_over_surface_area", table.contact_area_ratio},
                                 {"pairs", table.columns.front().values.size()}};
  for (const Column& column : table.columns)
    json["columns"][column.unit == "1" ? column.name : column.name + " [" + column.unit + "]"] = column.values;
  return json;
}

} // namespace mpfem
