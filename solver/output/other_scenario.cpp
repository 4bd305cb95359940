#include "solver/output/other_scenario.hpp"

#include <fmt/format.h>

#include "common/table_reader.hpp"
#include "common/toml_difference.hpp"

namespace mpfem {

std::string scenario_difference(const std::string& in_checkpoint, const std::string& scenario) {
  const TomlDocument before = TomlDocument::from_text(in_checkpoint, "checkpoint");
  const TomlDocument now = TomlDocument::from_text(scenario, "scenario");
  const auto difference = first_difference(before.root(), now.root());
  if (!difference) return {};
  return fmt::format(": key '{}': {} in the checkpoint, {} in the scenario", difference->key, difference->first,
                     difference->second);
}

} // namespace mpfem
