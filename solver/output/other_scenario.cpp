#include "solver/output/other_scenario.hpp"

#include <fmt/format.h>

#include "common/table_reader.hpp"
#include "common/toml_difference.hpp"

namespace mpfem {

std::string scenario_difference(const std::string& earlier, const std::string& scenario) {
  const TomlDocument before = TomlDocument::from_text(earlier, "earlier run");
  const TomlDocument now = TomlDocument::from_text(scenario, "scenario");
  const auto difference = first_difference(before.root(), now.root());
  if (!difference) return {};
  return fmt::format(": key '{}': {} there, {} in the scenario", difference->key, difference->first,
                     difference->second);
}

} // namespace mpfem
