#include "solver/output/history.hpp"

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "results-schema/descriptors.hpp"

namespace mpfem {

namespace {

static_assert(std::is_trivially_copyable_v<HistoryRow> && sizeof(HistoryRow) % sizeof(double) == 0);
constexpr std::size_t row_values = sizeof(HistoryRow) / sizeof(double);

using Rows = std::vector<HistoryRow>;

template <class T>
void write_column(schema::FileWriter& file, const Rows& rows, const schema::Dataset<T, 1>& dataset,
                  double HistoryRow::*member) {
  std::vector<T> values;
  for (const HistoryRow& row : rows) values.push_back(static_cast<T>(row.*member));
  file.write(dataset, std::span<const T>(values), rows.size());
}

template <std::size_t N>
void write_column(schema::FileWriter& file, const Rows& rows, const schema::Dataset<double, 2>& dataset,
                  std::array<double, N> HistoryRow::*member) {
  std::vector<double> values;
  for (const HistoryRow& row : rows) values.insert(values.end(), (row.*member).begin(), (row.*member).end());
  file.write(dataset, std::span<const double>(values), rows.size());
}

} // namespace

void write_history(schema::FileWriter& file, const Rows& rows) {
  namespace run = schema::run;
  using Row = HistoryRow;
  write_column(file, rows, run::history_time, &Row::time);
  write_column(file, rows, run::history_step, &Row::step);
  write_column(file, rows, run::history_stage, &Row::stage);
  write_column(file, rows, run::history_relative_density, &Row::relative_density);
  write_column(file, rows, run::history_relative_density_current, &Row::relative_density_current);
  write_column(file, rows, run::history_box_lengths, &Row::box_lengths);
  write_column(file, rows, run::history_wall_stress, &Row::wall_stress);
  write_column(file, rows, run::history_mean_stress, &Row::mean_stress);
  write_column(file, rows, run::history_deviatoric_stress, &Row::deviatoric_stress);
  write_column(file, rows, run::history_axial_strain, &Row::axial_strain);
  write_column(file, rows, run::history_volumetric_strain, &Row::volumetric_strain);
  write_column(file, rows, run::history_kinetic_energy, &Row::kinetic_energy);
  write_column(file, rows, run::history_elastic_energy, &Row::elastic_energy);
  write_column(file, rows, run::history_plastic_dissipation, &Row::plastic_dissipation);
  write_column(file, rows, run::history_damage_dissipation, &Row::damage_dissipation);
  write_column(file, rows, run::history_bond_energy, &Row::bond_energy);
  write_column(file, rows, run::history_contact_energy, &Row::contact_energy);
  write_column(file, rows, run::history_viscous_dissipation, &Row::viscous_dissipation);
  write_column(file, rows, run::history_damping_dissipation, &Row::damping_dissipation);
  write_column(file, rows, run::history_external_work, &Row::external_work);
  write_column(file, rows, run::history_energy_residual, &Row::energy_residual);
  write_column(file, rows, run::history_contact_area, &Row::contact_area);
  write_column(file, rows, run::history_surface_area, &Row::surface_area);
  write_column(file, rows, run::history_bonded_area, &Row::bonded_area);
  write_column(file, rows, run::history_bonds, &Row::bonds);
  write_column(file, rows, run::history_mean_damage, &Row::mean_damage);
  write_column(file, rows, run::history_coordination_number, &Row::coordination_number);
  write_column(file, rows, run::history_max_penetration, &Row::max_penetration);
  write_column(file, rows, run::history_damping_drag_ratio, &Row::damping_drag_ratio);
  write_column(file, rows, run::history_time_step, &Row::time_step);
}

std::vector<double> flatten(const Rows& rows) {
  std::vector<double> values(rows.size() * row_values);
  if (!rows.empty()) std::memcpy(values.data(), rows.data(), values.size() * sizeof(double));
  return values;
}

Rows unflatten(const std::vector<double>& values) {
  if (values.size() % row_values != 0) throw std::length_error("not whole rows");
  Rows rows(values.size() / row_values);
  if (!rows.empty()) std::memcpy(rows.data(), values.data(), rows.size() * sizeof(HistoryRow));
  return rows;
}

} // namespace mpfem
