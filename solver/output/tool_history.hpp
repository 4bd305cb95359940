#pragma once
// What the history keeps of rigid tools: /history/tools of a run file.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "results-schema/file.hpp"

namespace mpfem {

/// One tool in one row of the history.
struct ToolRow {
  std::array<double, 3> displacement; ///< mm, since the start of the run
  std::array<double, 3> force;        ///< N, of the grains on the tool
  std::array<double, 3> moment;       ///< N mm, of this force about the tool's reference point
  double normal_force;                ///< N, sum of the normal forces, pulls of bonds negative
  double work;                        ///< mJ, on the grains so far
  double friction_energy;             ///< mJ, stored in its stick springs
  double friction_dissipation;        ///< mJ, so far
  double adhesion_energy;             ///< mJ, stored in bonds to the tool
  double adhesion_dissipation;        ///< mJ, by damage of these bonds so far
  double bonded_area;                 ///< mm^2, of bonds that are not broken
};

/// A tool of the history.
struct NamedTool {
  std::string name;
  bool adheres; ///< grains may stick to it
};

/// Writes /history/tools/NAME; `rows` holds the rows of all tools at a time level, one level after the other.
void write_tool_history(schema::FileWriter& file, std::span<const NamedTool> tools, std::span<const ToolRow> rows);

/// Rows as plain numbers, one after another, and back (for checkpoints). tool_rows_of throws std::length_error if the
/// numbers are not whole rows.
std::vector<double> flatten(const std::vector<ToolRow>& rows);
/// The reverse of flatten().
std::vector<ToolRow> tool_rows_of(const std::vector<double>& values);

} // namespace mpfem
