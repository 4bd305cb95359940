#pragma once
// The stages of a run: which rows of its history belong to each, and what its scenario says of them.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "postproc/history_table.hpp"

namespace mpfem {

/// Rows first … last, both included.
struct RowRange {
  std::size_t first = 0, last = 0;
  std::size_t count() const { return last - first + 1; }
  std::span<const double> of(std::span<const double> column) const { return column.subspan(first, count()); }
};

/// Rows of one stage. `first` is the state in which it begins: the last row of the stage before, or, where the history
/// begins with it, its own first row.
struct StageRows {
  int number = 0;        ///< as in the scenario, from 0
  std::string type;      ///< as in the scenario ("isotropic_unloading"); empty where it is not known
  std::size_t first = 0; ///< row of the history
  std::size_t last = 0;  ///< row of the history, included
  std::string name;      ///< as in the scenario; where it gives none, TYPE-NUMBER
  RowRange rows() const { return {first, last}; }
};

/// What a metric needs of the scenario that a run file carries; nothing of it must be there.
struct ScenarioFacts {
  std::vector<std::string> stage_types, stage_names;
  std::optional<double> youngs_modulus;  ///< of the grains, MPa
  std::optional<double> fracture_energy; ///< N/mm, G^c of [bond]
  /// tonne/mm^3, by which all grains move: with numerics.mass_scaling. None where grains differ in it, or where masses
  /// are scaled to a step, node by node.
  std::optional<double> density;
};

/// Never fails: of a text that cannot be read nothing is known.
ScenarioFacts scenario_facts(const schema::FileReader& file);

/// In the order of the history.
std::vector<StageRows> stages_of(const HistoryTable& history, const ScenarioFacts& facts);

/// Rows of the stage itself, without the state in which it begins where that is the last row of the stage before.
std::vector<std::size_t> own_rows(const HistoryTable& history, const StageRows& stage);

/// Stage `number` as in the scenario; negative from the end (-1 the last). Throws InputError listing what there is.
const StageRows& stage_by_number(const std::vector<StageRows>& stages, int number, std::string_view path);

/// The stage of this name in the scenario that the run carries; nothing where none of the history has it.
std::optional<StageRows> stage_by_name(const std::vector<StageRows>& stages, std::string_view name);

/// The same, but throws InputError, naming `option` and the stages that there are.
StageRows need_stage(const std::vector<StageRows>& stages, std::string_view name, std::string_view option,
                     std::string_view path);

/// The stage that was named, else the last of one of these types, else the last of all.
const StageRows& choose_stage(const std::vector<StageRows>& stages, std::optional<int> number,
                              const std::vector<std::string>& types, std::string_view path);

/// The stage that was named, else the last of type isotropic_unloading, else the first after the densest row of all in
/// which density and mean stress both fall. Throws InputError where there is none.
const StageRows& choose_unloading(const std::vector<StageRows>& stages, std::optional<int> number,
                                  const HistoryTable& history, std::string_view path);

} // namespace mpfem
