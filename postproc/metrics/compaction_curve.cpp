#include "postproc/metrics/compaction_curve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/files/csv_file.hpp"
#include "postproc/metrics/inertia.hpp"

namespace mpfem {

namespace {

constexpr double reached = 1e-6; ///< tolerance of a relative density

/// The values of a column of the history at these relative densities.
std::vector<std::optional<double>> at_densities(const HistoryTable& history, const std::vector<double>& wanted,
                                                const char* column) {
  if (wanted.empty() || std::adjacent_find(wanted.begin(), wanted.end(), std::greater_equal<>()) != wanted.end())
    throw InputError(fmt::format("--densities: found '{}', allowed: one or more, each larger than the one before",
                                 fmt::join(wanted, ",")));
  return values_at_densities(history["relative_density"], history[column], wanted);
}

Measurement of_rows(const char* metric, const HistoryTable& history, std::size_t first) {
  Measurement m;
  m.metric = metric;
  m.window.first_row = first;
  m.window.last_row = history.rows() - 1;
  m.window.strain_name = "relative_density";
  m.window.strain = range_of(history["relative_density"], first, m.window.last_row);
  m.window.stress_name = "mean_stress";
  m.window.stress = range_of(history["mean_stress"], first, m.window.last_row);
  return m;
}

} // namespace

std::vector<std::optional<double>> values_at_densities(const std::vector<double>& density,
                                                       const std::vector<double>& values,
                                                       const std::vector<double>& wanted) {
  std::vector<std::optional<double>> found(wanted.size());
  std::size_t next = 0;
  for (std::size_t row = 0; row < density.size(); ++row)
    for (; next < wanted.size() && density[row] >= wanted[next] - reached; ++next) {
      if (row == 0 && density[row] > wanted[next] + reached) continue; // the run began denser
      const double before = row > 0 ? density[row - 1] : density[row];
      const double share = density[row] > before ? std::min(1.0, (wanted[next] - before) / (density[row] - before)) : 1;
      const double from = row > 0 ? values[row - 1] : values[row];
      found[next] = from + share * (values[row] - from);
    }
  return found;
}

Measurement measure_stress_at_densities(const schema::FileReader& file, const std::vector<double>& wanted) {
  const HistoryTable history(file);
  const auto found = at_densities(history, wanted, "mean_stress");
  Measurement m = of_rows("stress-at-densities", history, 0);
  m.unit = "MPa";
  m.uncertainty_meaning = "not known: between two rows of the history";
  m.method = "mean stress where the relative density is passed first, linear between the neighbouring rows";
  if (!found.back())
    throw InputError(fmt::format("{}: a relative density of {} is not reached, allowed: densities that the run reaches",
                                 one_line(file.path()), wanted.back()));
  m.value = *found.back();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    auto& entry = m.details[fmt::format("at_{:.2f}", wanted[i])];
    if (found[i]) entry = *found[i];
  }
  return m;
}

CompactionCurve read_compaction_curve(const std::string& path) {
  const std::vector<Column> columns = read_csv(path, {{"relative_density"}, {"mean_stress_MPa"}});
  CompactionCurve curve{columns[0].values, columns[1].values};
  const auto& density = curve.relative_density;
  if (density.empty() || std::adjacent_find(density.begin(), density.end(), std::greater_equal<>()) != density.end())
    throw InputError(
        fmt::format("{}: column relative_density: found {}, allowed: one or more rows, each denser than the one before",
                    one_line(path), density.empty() ? "no rows" : "a row that is not denser"));
  return curve;
}

std::string stress_at_densities_csv(const schema::FileReader& file, const std::vector<double>& wanted,
                                    const std::optional<CompactionCurve>& reference) {
  const HistoryTable history(file);
  const auto found = at_densities(history, wanted, "mean_stress"), area = at_densities(history, wanted, "contact_area");
  std::vector<std::optional<double>> expected(wanted.size());
  if (reference) expected = values_at_densities(reference->relative_density, reference->mean_stress, wanted);
  std::string text = fmt::format("name,relative_density [1],mean_stress [MPa]{},contact_area [mm^2]\n",
                                 reference ? ",reference [MPa],over_reference [1]" : "");
  const auto cell = [](const std::optional<double>& value) { return value ? fmt::format("{:.10g}", *value) : ""; };
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    text += fmt::format("D{0:.2f},{0:.2f},{1}", wanted[i], cell(found[i]));
    const bool comparable = found[i] && expected[i] && *expected[i] != 0;
    if (reference) text += fmt::format(",{},{}", cell(expected[i]), comparable ? cell(*found[i] / *expected[i]) : "");
    text += fmt::format(",{}\n", cell(area[i]));
  }
  return text;
}

Measurement measure_compaction_quality(const schema::FileReader& file, double from_density) {
  const HistoryTable history(file);
  const auto& density = history["relative_density"];
  std::size_t first = history.rows();
  double residual = 0, penetration = 0, current_density = 0;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < history.rows(); ++row) {
    if (density[row] < from_density) continue;
    first = std::min(first, row);
    const double work = history["external_work"][row];
    rows.push_back(row);
    if (work != 0) residual = std::max(residual, std::abs(history["energy_residual"][row] / work));
    penetration = std::max(penetration, history["max_penetration"][row]);
    current_density = std::max(current_density, history["relative_density_current"][row]);
  }
  if (first == history.rows())
    throw InputError(fmt::format("{}: no row has a relative density of {} or more, allowed: a smaller --from-density",
                                 one_line(file.path()), from_density));
  Measurement m = of_rows("compaction-quality", history, first);
  const Inertia inertia = inertia_of_rows(history, rows, grain_inertia(file, history));
  m.value = inertia.kinetic_over_internal;
  m.uncertainty_meaning = "not known: a largest value over rows";
  m.method = fmt::format("largest values over the rows from a relative density of {:g} on", from_density);
  m.details = {{"kinetic_over_internal", inertia.kinetic_over_internal},
               {"residual_over_work", residual},
               {"largest_penetration", penetration},
               {"inertial_number", number_or_null(inertia.inertial_number)},
               {"largest_inertial_number", number_or_null(inertia.largest_inertial_number)},
               {"largest_current_density", current_density}};
  return m;
}

} // namespace mpfem
