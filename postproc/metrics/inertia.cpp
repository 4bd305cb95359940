#include "postproc/metrics/inertia.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "postproc/fits/statistics.hpp"
#include "postproc/run_data/stages.hpp"

namespace mpfem {

namespace {

/// Logarithmic strain rate (1/s) of the box's fastest axis, from the row before to this one; 0 where no time has
/// passed.
double strain_rate(const HistoryTable& history, std::size_t row) {
  const double elapsed = history["time"][row] - history["time"][row - 1];
  if (!(elapsed > 0)) return 0;
  double strain = 0;
  for (const char* length : {"box_lengths_0", "box_lengths_1", "box_lengths_2"})
    strain = std::max(strain, std::abs(std::log(history[length][row - 1] / history[length][row])));
  return strain / elapsed;
}

} // namespace

std::optional<GrainInertia> grain_inertia(const schema::FileReader& file, const HistoryTable& history) {
  const ScenarioFacts facts = scenario_facts(file);
  const auto grains = static_cast<double>(file.rows(schema::run::mesh_grain_tet_offset)) - 1;
  const double volume = history["relative_density"].front() * history.container_volume(0);
  if (!facts.density || !(grains > 0) || !(volume > 0)) return {};
  return GrainInertia{*facts.density, std::cbrt(6 * volume / (grains * std::numbers::pi))};
}

std::vector<double> inertial_numbers(const HistoryTable& history, const GrainInertia& grains) {
  const auto &stage = history["stage"], &stress = history["mean_stress"];
  std::vector<double> numbers(history.rows(), 0.0);
  for (std::size_t row = 1; row < history.rows(); ++row)
    if (stage[row] == stage[row - 1] && stress[row] > 0)
      numbers[row] = strain_rate(history, row) * grains.diameter * std::sqrt(grains.density / stress[row]);
  return numbers;
}

Inertia inertia_of_rows(const HistoryTable& history, std::span<const std::size_t> rows,
                        const std::optional<GrainInertia>& grains) {
  const std::vector<double> internal = internal_energy(history);
  const std::vector<double> numbers = grains ? inertial_numbers(history, *grains) : std::vector<double>();
  const auto& kinetic = history["kinetic_energy"];
  Inertia inertia;
  std::vector<double> known;
  for (const std::size_t row : rows) {
    if (internal[row] > 0)
      inertia.kinetic_over_internal = std::max(inertia.kinetic_over_internal, kinetic[row] / internal[row]);
    if (grains && numbers[row] > 0) known.push_back(numbers[row]);
  }
  if (known.empty()) return inertia;
  inertia.largest_inertial_number = *std::max_element(known.begin(), known.end());
  inertia.inertial_number = median(std::move(known));
  return inertia;
}

} // namespace mpfem
