#pragma once
// The stages of a run: their rows in the history, and what the scenario says about them.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "postproc/run_data/history_table.hpp"

namespace mpfem {

/// Rows first … last, both included.
struct RowRange {
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first + 1; }
  std::span<const double> of(std::span<const double> column) const { return column.subspan(first, count()); }
};

/// Rows of one stage. `first` is the state in which it begins: the last row of the stage before, or its own first row
/// where the history begins with it.
struct StageRows {
  int number = 0;        ///< as in the scenario, from 0
  std::string type;      ///< as in the scenario ("isotropic_unloading"); empty where it is not known
  std::size_t first = 0; ///< row of the history
  std::size_t last = 0;  ///< row of the history, included
  std::string name;      ///< as in the scenario; without one there, TYPE-NUMBER with numbers from 1
  RowRange rows() const { return {first, last}; }
};

/// What metrics need from the scenario in a run file; any part may be missing.
struct ScenarioFacts {
  std::vector<std::string> stage_types, stage_names;
  std::optional<double> youngs_modulus;  ///< of the grains, MPa
  std::optional<double> fracture_energy; ///< N/mm, G^c of [bond]
  /// tonne/mm^3, of all grains, times numerics.mass_scaling. Empty where grains differ in it, or where masses are
  /// scaled to a step, node by node.
  std::optional<double> density;
};

/// Never fails: empty for a scenario that cannot be read.
ScenarioFacts scenario_facts(const schema::FileReader& file);

/// The stages in the order of the history. Throws InputError for a stage number that is NaN or beyond 1e9.
std::vector<StageRows> stages_of(const HistoryTable& history, const ScenarioFacts& facts);

/// Rows of the stage itself: without `first` where that is the last row of the stage before.
std::vector<std::size_t> own_rows(const HistoryTable& history, const StageRows& stage);

/// Stage `number` as in the scenario; negative from the end (-1 the last). Throws InputError that lists the stages.
const StageRows& stage_by_number(const std::vector<StageRows>& stages, int number, std::string_view path);

/// The stage with this name in the scenario; empty where the history has none.
std::optional<StageRows> stage_by_name(const std::vector<StageRows>& stages, std::string_view name);

/// The same, but throws InputError that names `option` and the stages.
StageRows need_stage(const std::vector<StageRows>& stages, std::string_view name, std::string_view option,
                     std::string_view path);

/// Stage `number` where given, otherwise the last of one of these types, otherwise the last of all. Throws InputError.
const StageRows& choose_stage(const std::vector<StageRows>& stages, std::optional<int> number,
                              const std::vector<std::string>& types, std::string_view path);

/// A note for a number that was measured in a stage of none of these types; empty where it has one, or is of unknown
/// type.
std::string note_of_other_stage(const StageRows& stage, const std::vector<std::string>& types);

/// The same as choose_stage, but throws InputError where no stage has one of these types.
const StageRows& need_stage_of_type(const std::vector<StageRows>& stages, std::optional<int> number,
                                    const std::vector<std::string>& types, std::string_view path);

/// Stage `number` where given, otherwise the last of type isotropic_unloading, otherwise the first that ends after the
/// densest row of all and unloads: relative density and mean stress fall by more than shares of 1e-9 and 0.05. While
/// walls stand still the density changes by rounding only, and while they hold a force the stress by what rings.
/// Throws InputError where there is none.
const StageRows& choose_unloading(const std::vector<StageRows>& stages, std::optional<int> number,
                                  const HistoryTable& history, std::string_view path);

} // namespace mpfem
