#include "postproc/run_data/stage_curve.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"

namespace mpfem {

StageCurve stage_curve(const HistoryTable& history, const StageRows& rows, const std::string& path) {
  StageCurve c;
  c.stage = rows.number;
  c.type = rows.type;
  c.first_row = rows.first;
  c.path = one_line(path);
  const auto cut = [&](const char* name) {
    const auto& column = history[name];
    return std::vector<double>(column.begin() + static_cast<std::ptrdiff_t>(rows.first),
                               column.begin() + static_cast<std::ptrdiff_t>(rows.last) + 1);
  };
  const auto from_start = [&](const char* name) {
    std::vector<double> column = cut(name);
    const double start = column.front();
    for (double& value : column) value -= start;
    return column;
  };
  c.axial_strain = from_start("axial_strain");
  c.volumetric_strain = from_start("volumetric_strain");
  c.mean_stress = cut("mean_stress");
  c.deviatoric_stress = cut("deviatoric_stress");
  c.relative_density = cut("relative_density");
  c.plastic_dissipation = cut("plastic_dissipation");
  c.damage_dissipation = cut("damage_dissipation");
  const auto z = cut("box_lengths_2");
  std::vector<double> wall[6];
  for (int side = 0; side < 6; ++side) wall[side] = cut(fmt::format("wall_stress_{}", side).c_str());
  for (std::size_t row = 0; row < c.rows(); ++row) {
    c.axial_stress.push_back(0.5 * (wall[4][row] + wall[5][row]));
    c.lateral_stress.push_back(0.25 * (wall[0][row] + wall[1][row] + wall[2][row] + wall[3][row]));
  }
  const auto force = [&](std::size_t row) { return c.axial_stress[row] * history.section(rows.first + row); };
  c.axial_work.push_back(0);
  for (std::size_t row = 1; row < c.rows(); ++row)
    c.axial_work.push_back(c.axial_work.back() + 0.5 * (force(row - 1) + force(row)) * (z[row - 1] - z[row]));

  if (c.rows() < 2) return c;
  const double largest = *std::max_element(c.axial_stress.begin(), c.axial_stress.end());
  c.unconfined = median({c.lateral_stress.begin() + 1, c.lateral_stress.end()}) < 0.01 * largest;
  const double face = history.section(rows.first);
  if (c.unconfined && face > 0)
    for (std::size_t row = 0; row < c.rows(); ++row) c.axial_stress[row] = force(row) / face;
  return c;
}

} // namespace mpfem
