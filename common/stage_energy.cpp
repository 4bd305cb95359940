#include "common/stage_energy.hpp"

namespace mpfem {

std::vector<double> stage_internal_energy(std::span<const StageEnergyRow> rows) {
  std::vector<double> energy;
  double before = rows.empty() ? 0.0 : rows.front().dissipated; // when the row's stage began
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (row > 0 && rows[row].stage != rows[row - 1].stage) before = rows[row - 1].dissipated;
    energy.push_back(rows[row].stored + rows[row].dissipated - before);
  }
  return energy;
}

} // namespace mpfem
