#pragma once
// Where rigid tools are and what they look like, so that programs that read a run can draw them: /tools of a run file,
// and of each snapshot the tools that are in place.

#include <string>

#include "results-schema/file.hpp"
#include "solver/boundary/tools.hpp"

namespace mpfem {

/// Writes /tools/NAME: the surface of every tool at the start of the run. Writes nothing if there are no tools.
void write_tool_geometry(schema::FileWriter& file, const Tools& tools);

/// Writes the tools of a snapshot that are not away, and their displacements (mm). Nothing if there are none.
void write_placed_tools(schema::FileWriter& file, const std::string& snapshot, const Tools& tools);

} // namespace mpfem
