#include "solver/run/energy_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/run/energy_terms.hpp"

namespace mpfem {

namespace {

/// Young's modulus times volume, summed over all grains, mJ.
double stiffness_of(const Model& model) {
  double stiffness = 0;
  for (int grain = 0; grain < model.grains; ++grain)
    stiffness += model.material_of(grain).moduli.youngs() * model.reference_volume[static_cast<std::size_t>(grain)];
  return stiffness;
}

} // namespace

EnergyCheck::EnergyCheck(const Model& model, const std::vector<HistoryRow>& history)
    : EnergyCheck(stiffness_of(model)) {
  for (const HistoryRow& row : history) take(row);
}

double EnergyCheck::take(const HistoryRow& row) {
  double sum = row.external_work; // finite only if all terms are
  largest_ = std::max(largest_, std::abs(row.external_work));
  for (const auto term : energy_terms) {
    largest_ = std::max(largest_, std::abs(row.*term));
    sum += row.*term;
  }
  if (!std::isfinite(sum + row.energy_residual)) return std::numeric_limits<double>::quiet_NaN();
  if (!begin_) begin_ = row.step;
  if (row.step - *begin_ < first_steps) return 0.0;
  return largest_ > negligible_ ? std::abs(row.energy_residual) / largest_ : 0.0;
}

double EnergyCheck::require(const HistoryRow& row) {
  const double error = take(row);
  if (!(error <= allowed))
    throw SimulationError(fmt::format(
        "step {:.0f}, time {:.4g} s, relative density {:.4f}: the energy balance is off by {:.3g} % of its largest "
        "term, allowed: {:g} %; the motion is not stable; lower numerics.time_step_factor or the speed",
        row.step, row.time, row.relative_density, 100 * error, 100 * allowed));
  return error;
}

} // namespace mpfem
