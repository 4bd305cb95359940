#include "solver/output/tool_history.hpp"

#include <cstring>
#include <stdexcept>

#include "results-schema/descriptors.hpp"

namespace mpfem {

namespace {

namespace run = schema::run;

constexpr std::size_t row_values = sizeof(ToolRow) / sizeof(double);
static_assert(std::is_trivially_copyable_v<ToolRow> && sizeof(ToolRow) == row_values * sizeof(double));

/// The rows of one tool.
std::vector<ToolRow> rows_of(std::span<const ToolRow> rows, std::size_t tool, std::size_t tools) {
  std::vector<ToolRow> own;
  for (std::size_t i = tool; i < rows.size(); i += tools) own.push_back(rows[i]);
  return own;
}

} // namespace

void write_tool_history(schema::FileWriter& file, std::span<const NamedTool> tools, std::span<const ToolRow> rows) {
  for (std::size_t tool = 0; tool < tools.size(); ++tool) {
    const std::vector<ToolRow> own = rows_of(rows, tool, tools.size());
    const auto write_vectors = [&](const auto& dataset, std::array<double, 3> ToolRow::*member) {
      std::vector<double> values;
      for (const ToolRow& row : own) values.insert(values.end(), (row.*member).begin(), (row.*member).end());
      file.write(dataset, std::span<const double>(values), own.size(), tools[tool].name);
    };
    const auto write_numbers = [&](const auto& dataset, double ToolRow::*member) {
      std::vector<double> values;
      for (const ToolRow& row : own) values.push_back(row.*member);
      file.write(dataset, std::span<const double>(values), own.size(), tools[tool].name);
    };
    write_vectors(run::history_tools_displacement, &ToolRow::displacement);
    write_vectors(run::history_tools_force, &ToolRow::force);
    write_vectors(run::history_tools_moment, &ToolRow::moment);
    write_numbers(run::history_tools_normal_force, &ToolRow::normal_force);
    write_numbers(run::history_tools_work, &ToolRow::work);
    write_numbers(run::history_tools_friction_energy, &ToolRow::friction_energy);
    write_numbers(run::history_tools_friction_dissipation, &ToolRow::friction_dissipation);
    if (!tools[tool].adheres) continue;
    write_numbers(run::history_tools_adhesion_energy, &ToolRow::adhesion_energy);
    write_numbers(run::history_tools_adhesion_dissipation, &ToolRow::adhesion_dissipation);
    write_numbers(run::history_tools_bonded_area, &ToolRow::bonded_area);
  }
}

std::vector<double> flatten(const std::vector<ToolRow>& rows) {
  std::vector<double> values(rows.size() * row_values);
  if (!rows.empty()) std::memcpy(values.data(), rows.data(), values.size() * sizeof(double));
  return values;
}

std::vector<ToolRow> tool_rows_of(const std::vector<double>& values) {
  if (values.size() % row_values != 0) throw std::length_error("not whole rows");
  std::vector<ToolRow> rows(values.size() / row_values);
  if (!rows.empty()) std::memcpy(rows.data(), values.data(), values.size() * sizeof(double));
  return rows;
}

} // namespace mpfem
