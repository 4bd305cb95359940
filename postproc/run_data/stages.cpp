#include "postproc/run_data/stages.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "common/table_reader.hpp"

namespace mpfem {

namespace {

std::optional<double> density_of_all(const toml::table& scenario) {
  const auto density = scenario.at_path("material.density").value<double>();
  if (!density || scenario.at_path("numerics.mass_scaling_step")) return {};
  if (const toml::array* others = scenario["grain_material"].as_array())
    for (const toml::node& other : *others)
      if (const toml::table* table = other.as_table(); !table || (*table)["density"].value<double>() != density)
        return {};
  return *density * scenario.at_path("numerics.mass_scaling").value_or(1.0);
}

} // namespace

ScenarioFacts scenario_facts(const schema::FileReader& file) {
  ScenarioFacts facts;
  try {
    const TomlDocument document =
        TomlDocument::from_text(file.read_scalar(schema::run::provenance_scenario), file.path());
    facts.youngs_modulus = document.root().at_path("material.youngs_modulus").value<double>();
    facts.fracture_energy = document.root().at_path("bond.fracture_energy").value<double>();
    facts.density = density_of_all(document.root());
    if (const toml::array* stages = document.root()["stages"].as_array())
      for (const toml::node& stage : *stages) {
        const toml::table* table = stage.as_table();
        const std::string type = table ? (*table)["type"].value_or(std::string()) : std::string();
        const std::string unnamed = fmt::format("{}-{}", type, facts.stage_types.size() + 1);
        facts.stage_names.push_back(table ? (*table)["name"].value_or(unnamed) : unnamed);
        facts.stage_types.push_back(type);
      }
  } catch (const InputError&) { // scenario of another version: metrics then need more options
    return {};
  }
  return facts;
}

std::vector<StageRows> stages_of(const HistoryTable& history, const ScenarioFacts& facts) {
  constexpr double largest_number = 1e9;
  std::vector<StageRows> stages;
  const auto& number = history["stage"];
  for (std::size_t row = 0; row < history.rows(); ++row) {
    if (!(std::abs(number[row]) <= largest_number))
      throw InputError(
          fmt::format("/history/stage row {}: found {:g}, allowed: the number of a stage", row, number[row]));
    const int stage = static_cast<int>(number[row]);
    if (stages.empty() || stages.back().number != stage) {
      const auto index = static_cast<std::size_t>(stage);
      const bool known = stage >= 0 && index < facts.stage_types.size();
      stages.push_back({stage, known ? facts.stage_types[index] : "", row > 0 ? row - 1 : 0, row,
                        known ? facts.stage_names[index] : ""});
    }
    stages.back().last = row;
  }
  return stages;
}

std::vector<std::size_t> own_rows(const HistoryTable& history, const StageRows& stage) {
  const auto& number = history["stage"];
  std::vector<std::size_t> rows;
  for (std::size_t row = stage.first; row <= stage.last; ++row)
    if (static_cast<int>(number[row]) == stage.number) rows.push_back(row);
  return rows;
}

const StageRows& stage_by_number(const std::vector<StageRows>& stages, int number, std::string_view path) {
  if (number < 0 && static_cast<std::size_t>(-static_cast<long>(number)) <= stages.size())
    return stages[stages.size() - static_cast<std::size_t>(-static_cast<long>(number))];
  const auto found = std::find_if(stages.begin(), stages.end(), [&](const StageRows& s) { return s.number == number; });
  if (found != stages.end()) return *found;
  std::vector<int> numbers;
  for (const StageRows& stage : stages) numbers.push_back(stage.number);
  throw InputError(fmt::format("{}: --stage: found {}, allowed: {} (or from the end, -1 … -{})", one_line(path), number,
                               fmt::join(numbers, ", "), stages.size()));
}

std::optional<StageRows> stage_by_name(const std::vector<StageRows>& stages, std::string_view name) {
  const auto found = std::find_if(stages.begin(), stages.end(), [&](const StageRows& s) { return s.name == name; });
  return found != stages.end() ? std::optional(*found) : std::nullopt;
}

StageRows need_stage(const std::vector<StageRows>& stages, std::string_view name, std::string_view option,
                     std::string_view path) {
  if (const auto stage = stage_by_name(stages, name)) return *stage;
  std::vector<std::string> names;
  for (const StageRows& stage : stages) names.push_back(one_line(stage.name));
  throw InputError(fmt::format("{}: {}: found no stage '{}', allowed: {}", one_line(path), option, one_line(name),
                               fmt::join(names, ", ")));
}

namespace {

/// The last stage of one of these types; null where there is none.
const StageRows* last_of_type(const std::vector<StageRows>& stages, const std::vector<std::string>& types) {
  const auto found = std::find_if(stages.rbegin(), stages.rend(), [&](const StageRows& stage) {
    return std::find(types.begin(), types.end(), stage.type) != types.end();
  });
  return found == stages.rend() ? nullptr : &*found;
}

/// Whether a column falls in the stage by more than this share of its value at the beginning.
bool falls(const std::vector<double>& column, const StageRows& stage, double share) {
  return column[stage.first] - column[stage.last] > share * std::abs(column[stage.first]);
}

} // namespace

const StageRows& choose_stage(const std::vector<StageRows>& stages, std::optional<int> number,
                              const std::vector<std::string>& types, std::string_view path) {
  if (number) return stage_by_number(stages, *number, path);
  const StageRows* last = last_of_type(stages, types);
  return last ? *last : stages.back();
}

std::string note_of_other_stage(const StageRows& stage, const std::vector<std::string>& types) {
  if (stage.type.empty() || std::find(types.begin(), types.end(), stage.type) != types.end()) return {};
  return fmt::format("the stage '{}' is of type {}, not {}", stage.name, stage.type, fmt::join(types, " or "));
}

const StageRows& need_stage_of_type(const std::vector<StageRows>& stages, std::optional<int> number,
                                    const std::vector<std::string>& types, std::string_view path) {
  if (number) return stage_by_number(stages, *number, path);
  if (const StageRows* last = last_of_type(stages, types)) return *last;
  throw InputError(fmt::format("{}: found no stage of type {}, allowed: a run with one, or --stage N", one_line(path),
                               fmt::join(types, " or ")));
}

const StageRows& choose_unloading(const std::vector<StageRows>& stages, std::optional<int> number,
                                  const HistoryTable& history, std::string_view path) {
  if (number) return stage_by_number(stages, *number, path);
  if (const StageRows* last = last_of_type(stages, {"isotropic_unloading"})) return *last;
  const auto &density = history["relative_density"], &stress = history["mean_stress"];
  const auto densest = static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin());
  for (const StageRows& stage : stages)
    if (stage.last > densest && falls(density, stage, 1e-9) && falls(stress, stage, 0.05)) return stage;
  throw InputError(
      fmt::format("{}: no unloading: in no stage after the densest row do relative density and mean stress "
                  "both fall, the stress by more than a twentieth, allowed: a run that unloads, or --stage N",
                  one_line(path)));
}

} // namespace mpfem
