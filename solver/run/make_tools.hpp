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

/// A line for each tool that is probably given in another unit, as it stands at the start: one so far from the
/// packing's box that grains will hardly reach it, such as a die that is 1,000 times too large; an STL tool that
/// encloses the packing and is far larger, or is a body that is far smaller.
std::vector<std::string> implausible_sizes(const Scenario& scenario, const Model& model, const Tools& tools);

} // namespace mpfem
