#include "solver/run/untouched_tools.hpp"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

namespace mpfem {

namespace {

bool is_driven(const Scenario& scenario, std::size_t tool) {
  return std::ranges::any_of(scenario.stages, [tool](const Stage& stage) {
    const auto* loading = std::get_if<ToolLoading>(&stage.type);
    return loading != nullptr && (loading->speed > 0 || loading->servo_speed > 0) &&
           std::ranges::any_of(loading->drives, [tool](const ToolDrive& drive) { return drive.tool == tool; });
  });
}

} // namespace

std::vector<std::string> untouched_tools(const Scenario& scenario, std::span<const ToolRow> rows) {
  std::vector<std::string> texts;
  const std::size_t tools = scenario.tools.size();
  for (std::size_t tool = 0; tool < tools; ++tool) {
    bool touched = !is_driven(scenario, tool);
    for (std::size_t row = tool; row < rows.size() && !touched; row += tools)
      touched = rows[row].force != std::array<double, 3>{} || rows[row].work != 0;
    if (!touched)
      texts.push_back(fmt::format("the tool '{}' was driven and touched no grain: check its place and its units",
                                  scenario.tools[tool].name));
  }
  return texts;
}

} // namespace mpfem
