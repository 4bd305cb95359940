#pragma once
// The run of small_run.hpp, the cube [-1, 1]^3 in a box of [-1.5, 1.5]^3, with rigid tools.

#include "small_run.hpp"

namespace mpfem::test {

/// A tool by its datasets below /tools/NAME.
struct WrittenTool {
  std::string name, shape;
  std::map<std::string, std::vector<double>> numbers;
};

inline void add_tool(RunContents& run, const WrittenTool& tool) {
  const std::string folder = "/tools/" + tool.name + "/";
  run.tools.push_back(tool.name);
  run.texts[folder + "shape"] = {tool.shape};
  run.numbers[folder + "inside"] = {0};
  for (const auto& [dataset, values] : tool.numbers) run.numbers[folder + dataset] = values;
}

/// A die of radius 2 along z from -1.5 to 1.8 with a rounding of 0.1, its lower and upper punch at -1.4 and 1.5, each
/// 0.1 below its start, and a plate at x = 1.5 that is away.
inline RunContents die_run() {
  RunContents run = small_run();
  add_tool(run, {"die",
                 "cylinder",
                 {{"inside", {1}},
                  {"point", {0, 0, 0.15}},
                  {"direction", {0, 0, 1}},
                  {"radius", {2}},
                  {"half_length", {1.65}},
                  {"rounding", {0.1}}}});
  add_tool(run, {"lower", "plane", {{"point", {0, 0, -1.3}}, {"direction", {0, 0, 1}}}});
  add_tool(run, {"plate", "plane", {{"point", {1.5, 0, 0}}, {"direction", {-1, 0, 0}}}});
  add_tool(run, {"upper", "plane", {{"point", {0, 0, 1.6}}, {"direction", {0, 0, -1}}}});
  run.extents["*tools"] = 3;
  run.texts["/snapshots/*/tool_name"] = {"die", "lower", "upper"};
  run.numbers["/snapshots/*/tool_displacement"] = {0, 0, 0, 0, 0, -0.1, 0, 0, -0.1};
  return run;
}

} // namespace mpfem::test
