#include "postproc/metrics/elastic_recovery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/run_data/uncertainty.hpp"
#include "postproc/run_data/windows.hpp"

namespace mpfem {

ElasticRecovery elastic_recovery(std::span<const double> density, std::span<const double> mean_stress,
                                 const std::string& path) {
  ElasticRecovery r;
  const std::size_t last = density.size() - 1;
  r.densest_row = static_cast<std::size_t>(std::max_element(density.begin(), density.end()) - density.begin());
  if (r.densest_row == last)
    throw InputError(fmt::format("{}: the densest row is the last one of the unloading, allowed: a stage in which the "
                                 "relative density falls",
                                 one_line(path)));
  r.largest_density = density[r.densest_row];
  r.smallest_density = density[last];
  r.stress_at_largest = mean_stress[r.densest_row];
  r.residual_stress = mean_stress[last];
  r.recovery = (r.largest_density - r.smallest_density) / r.largest_density;
  r.recovery_over_loaded_volume = r.recovery / (1 - r.recovery);

  std::size_t from = last;
  const auto belongs = [&](std::size_t row) {
    return last - row < 5 || mean_stress[row] <= 3 * std::max(r.residual_stress, 0.0);
  };
  while (from > r.densest_row && belongs(from - 1)) --from;
  r.extrapolated_from_row = from;
  const auto stress = mean_stress.subspan(from), part = density.subspan(from);
  double rest = 0, rest_of_hertz = 0, ringing = 0;
  if (*std::max_element(stress.begin(), stress.end()) > *std::min_element(stress.begin(), stress.end())) {
    const auto two_thirds = [](double p) { return std::copysign(std::pow(std::abs(p), 2.0 / 3.0), p); };
    std::vector<double> hertz;
    for (const double p : stress) hertz.push_back(two_thirds(p));
    const Line line = least_squares_line(stress, part), hertz_line = least_squares_line(hertz, part);
    rest = line.slope * r.residual_stress;
    rest_of_hertz = hertz_line.slope * two_thirds(r.residual_stress);
    const bool linear = line.scatter < hertz_line.scatter;
    const Line& better = linear ? line : hertz_line;
    const double last_on_line = better.intercept + (linear ? rest : rest_of_hertz);
    ringing = better.intercept_half_width + std::abs(r.smallest_density - last_on_line);
  } else if (r.residual_stress != 0) { // no line leads from this stress to zero
    rest = rest_of_hertz = std::numeric_limits<double>::quiet_NaN();
  }
  r.recovery_at_zero_stress = r.recovery + rest / r.largest_density;
  r.uncertainty_at_zero_stress = (std::abs(rest - rest_of_hertz) + ringing) / r.largest_density;
  // The residual stress gives a bias of known sign, part of which ringing may hide.
  r.uncertainty = (std::max(std::abs(rest), std::abs(rest_of_hertz)) + ringing) / r.largest_density;
  return r;
}

Measurement measure_elastic_recovery(const schema::FileReader& file, std::optional<int> number) {
  const HistoryTable history(file);
  const auto stages = stages_of(history, scenario_facts(file));
  const StageRows& unloading = choose_unloading(stages, number, history, file.path());
  const std::size_t index = static_cast<std::size_t>(&unloading - stages.data());
  const std::size_t begin = index > 0 ? stages[index - 1].first : unloading.first, rows = unloading.last + 1 - begin;
  const auto part = [&](const char* name) { return std::span<const double>(history[name]).subspan(begin, rows); };
  const ElasticRecovery r = elastic_recovery(part("relative_density"), part("mean_stress"), file.path());

  Measurement m;
  m.metric = "elastic-recovery";
  m.value = r.recovery;
  m.uncertainty = r.uncertainty;
  m.uncertainty_meaning = "change by extrapolation to zero stress, linear or as in Hertz's theory, the 95 % interval "
                          "of that line at zero stress, and the distance of the last row from it";
  m.window = isotropic_window(history, unloading, {begin + r.densest_row, unloading.last});
  m.method =
      fmt::format("(D_max - D_min) / D_max (Eq. 9): D_max at the densest row, D_min at the unloading's last row; "
                  "line through the last {} rows for zero stress; volumetric strain since the run began",
                  rows - r.extrapolated_from_row);
  const auto of_stress = [&](std::size_t row) { // by rows of the unloading, unless the row lies before it
    const RowRange before{begin, unloading.first};
    return row_uncertainty(history, history["mean_stress"], row, row < unloading.first ? before : unloading.rows());
  };
  m.details = {{"relative_density_max", r.largest_density},
               {"relative_density_min", r.smallest_density},
               {"mean_stress_at_max_MPa", r.stress_at_largest},
               {"mean_stress_at_max_uncertainty_MPa", of_stress(m.window.first_row)},
               {"residual_mean_stress_MPa", r.residual_stress},
               {"residual_mean_stress_uncertainty_MPa", of_stress(unloading.last)},
               {"recovery_at_zero_stress", r.recovery_at_zero_stress},
               {"recovery_at_zero_stress_uncertainty", r.uncertainty_at_zero_stress},
               {"recovery_over_loaded_volume", r.recovery_over_loaded_volume},
               {"recovery_over_loaded_volume_uncertainty", r.uncertainty / ((1 - r.recovery) * (1 - r.recovery))}};
  m.brief = fmt::format("D_max {:.4f} at {:.3g} MPa, D_min {:.4f} at {:.3g} MPa", r.largest_density,
                        r.stress_at_largest, r.smallest_density, r.residual_stress);
  if (std::abs(r.residual_stress) > 0.02 * r.stress_at_largest)
    m.notes.push_back(fmt::format("unloading ends at {:.3g} MPa, {:.1f} % of the stress at D_max", r.residual_stress,
                                  100 * r.residual_stress / r.stress_at_largest));
  return m;
}

} // namespace mpfem
