#pragma once
// The tools of a scenario in the box of its packing.

#include <array>
#include <string>
#include <vector>

#include "solver/boundary/tools.hpp"
#include "solver/scenario/scenario.hpp"

namespace mpfem {

/// The surface of a tool in the packing's box, `low` to `high` (mm), in its starting position. Throws InputError if an
/// STL file cannot be used.
ToolSurface make_surface(const ToolShape& shape, const std::array<double, 3>& low, const std::array<double, 3>& high);

/// All tools of a scenario, as they stand at the start.
Tools make_tools(const Scenario& scenario, const Model& model);

/// A line for each STL tool whose scale is probably wrong: one that encloses the packing and is far larger than its
/// box, or a body that is far smaller. (A body may be far larger, such as a plate, and a grain in it is refused.)
std::vector<std::string> implausible_sizes(const Scenario& scenario, const Model& model, const Tools& tools);

} // namespace mpfem
