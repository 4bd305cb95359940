#include "postproc/metrics/stress_path.hpp"

#include <algorithm>
#include <cmath>

namespace mpfem {

Measurement stress_path(const HistoryTable& h) {
  const auto& p = h["mean_stress"];
  const auto& q = h["deviatoric_stress"];
  const std::size_t last = h.rows() - 1;
  const double largest_p = *std::max_element(p.begin(), p.end());
  double largest_q = 0, largest_ratio = 0;
  for (std::size_t row = 0; row <= last; ++row) {
    largest_q = std::max(largest_q, std::abs(q[row]));
    if (p[row] > largest_p / 4) largest_ratio = std::max(largest_ratio, std::abs(q[row] / p[row]));
  }
  const auto dissipated = [&](std::size_t row) { return h["plastic_dissipation"][row] + h["damage_dissipation"][row]; };
  Measurement m;
  m.metric = "stress-path";
  m.value = p[last];
  m.unit = "MPa";
  m.uncertainty_meaning = "not known: read at the last row";
  m.window.stage = static_cast<int>(h["stage"][last]);
  m.window.first_row = 0;
  m.window.last_row = last;
  m.window.strain = range_of(h["axial_strain"], 0, last);
  m.window.stress_name = "mean_stress";
  m.window.stress = range_of(p, 0, last);
  m.method = "mean stress at the end of the run";
  m.details = {{"mean_stress_at_end_MPa", p[last]},
               {"deviatoric_stress_at_end_MPa", q[last]},
               {"largest_mean_stress_MPa", largest_p},
               {"largest_deviatoric_stress_MPa", largest_q},
               {"largest_ratio", largest_ratio},
               {"dissipation_at_start_mJ", dissipated(0)},
               {"dissipation_at_end_mJ", dissipated(last)},
               {"damage_share_at_end", dissipated(last) > 0 ? h["damage_dissipation"][last] / dissipated(last) : 0}};
  return m;
}

Measurement measure_stress_path(const schema::FileReader& file) {
  return stress_path(HistoryTable(file));
}

} // namespace mpfem
