#include "postproc/metrics/heckel.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "postproc/fits/statistics.hpp"

namespace mpfem {

namespace {

/// ln 1/(1 - D)
std::vector<double> heckel_ordinate(std::span<const double> density) {
  std::vector<double> y;
  for (const double d : density) y.push_back(-std::log1p(-d));
  return y;
}

/// Cumulative sums over rows, so that the R^2 of any window needs no loop over its rows.
class WindowSums {
public:
  WindowSums(std::span<const double> x, std::span<const double> y) : sums_(x.size() + 1) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Sums more{1, x[i], y[i], x[i] * x[i], x[i] * y[i], y[i] * y[i]};
      for (std::size_t k = 0; k < more.size(); ++k) sums_[i + 1][k] = sums_[i][k] + more[k];
    }
  }

  /// R^2 of the least-squares line through rows first … last; 0 where x or y does not vary or the slope is not > 0.
  double r_squared(std::size_t first, std::size_t last) const {
    Sums s{};
    for (std::size_t k = 0; k < s.size(); ++k) s[k] = sums_[last + 1][k] - sums_[first][k];
    const long double xx = s[3] - s[1] * s[1] / s[0], xy = s[4] - s[1] * s[2] / s[0], yy = s[5] - s[2] * s[2] / s[0];
    return xx > 0 && yy > 0 && xy > 0 ? static_cast<double>(xy * xy / (xx * yy)) : 0;
  }

private:
  using Sums = std::array<long double, 6>; ///< of 1, x, y, x x, x y, y y
  std::vector<Sums> sums_;
};

/// Rows up to the largest pressure and up to the largest density, from the row after which all have a pressure > 0.
RowRange usable_rows(std::span<const double> pressure, std::span<const double> density, double largest_density) {
  const auto peak = static_cast<std::size_t>(std::max_element(pressure.begin(), pressure.end()) - pressure.begin());
  std::size_t end = 0;
  while (end < density.size() && end <= peak && density[end] <= largest_density) ++end;
  std::size_t first = end;
  while (first > 0 && pressure[first - 1] > 0 && density[first - 1] > 0) --first;
  return {first, end - 1}; // without rows, count() wraps around to 0
}

/// Factor on half widths for correlated residuals, from their lag-1 correlation.
double widening(const std::vector<double>& residual) {
  double product = 0, squares = 0;
  for (std::size_t i = 0; i < residual.size(); ++i) {
    squares += residual[i] * residual[i];
    if (i > 0) product += residual[i] * residual[i - 1];
  }
  const double r = squares > 0 ? std::clamp(product / squares, 0.0, 0.99) : 0;
  return std::sqrt((1 + r) / (1 - r));
}

/// Half of the difference of 1/slope between the halves of the rows; 0 where one of them has no slope.
double half_difference_of_halves(std::span<const double> x, std::span<const double> y) {
  const std::size_t half = x.size() / 2;
  if (half < 3) return 0;
  const Line low = least_squares_line(x.first(half), y.first(half)),
             high = least_squares_line(x.last(half), y.last(half));
  return low.slope > 0 && high.slope > 0 ? 0.5 * std::abs(1 / low.slope - 1 / high.slope) : 0;
}

} // namespace

std::optional<HeckelFit> heckel_line(std::span<const double> pressure, std::span<const double> density, RowRange rows) {
  const std::span<const double> x = rows.of(pressure);
  const std::vector<double> y = heckel_ordinate(rows.of(density));
  const Line line = least_squares_line(x, y);
  if (!(line.slope > 0)) return {};
  std::vector<double> residual;
  for (std::size_t i = 0; i < y.size(); ++i) residual.push_back(y[i] - line.intercept - line.slope * x[i]);
  const double wider = widening(residual);
  HeckelFit fit{rows.first, rows.last, 1 / line.slope, 0, line.intercept, wider * line.intercept_half_width, 0};
  fit.yield_pressure_uncertainty =
      std::hypot(wider * line.slope_half_width / (line.slope * line.slope), half_difference_of_halves(x, y));
  fit.r_squared = WindowSums(x, y).r_squared(0, y.size() - 1);
  return fit;
}

std::optional<HeckelFit> heckel_window(std::span<const double> pressure, std::span<const double> density,
                                       const HeckelRule& rule) {
  const RowRange usable = usable_rows(pressure, density, rule.largest_density);
  const std::span<const double> x = usable.of(pressure);
  const std::vector<double> y = heckel_ordinate(usable.of(density));
  const WindowSums sums(x, y);
  std::optional<RowRange> longest;
  double length = 0;
  for (std::size_t first = 0; first < x.size(); ++first)
    for (std::size_t last = first + rule.fewest_rows - 1; last < x.size(); ++last) {
      if (!(x[last] - x[first] > length) || sums.r_squared(first, last) < rule.r_squared) continue;
      longest = RowRange{usable.first + first, usable.first + last};
      length = x[last] - x[first];
    }
  return longest ? heckel_line(pressure, density, *longest) : std::nullopt;
}

double density_without_elastic_compression(double density, double pressure, double bulk_modulus) {
  return density / (1 + pressure / bulk_modulus);
}

namespace {

/// Adds P_y and its uncertainty, over the same rows with another density, under `name`.
void add_corrected(Measurement& m, const std::string& name, const HeckelFit& fit, std::span<const double> pressure,
                   const std::vector<double>& density) {
  const auto corrected = heckel_line(pressure, density, {fit.first, fit.last});
  m.details[name + "_MPa"] = corrected ? nlohmann::ordered_json(corrected->yield_pressure) : nlohmann::ordered_json();
  if (corrected) m.details[name + "_uncertainty_MPa"] = corrected->yield_pressure_uncertainty;
}

/// The part of the measurement that follows from the fit alone.
Measurement in_die_measurement(const HeckelFit& fit, const HeckelRule& rule) {
  Measurement m;
  m.metric = "heckel";
  m.value = fit.yield_pressure;
  m.unit = "MPa";
  m.uncertainty = fit.yield_pressure_uncertainty;
  m.uncertainty_meaning = "half of the 95 % interval, widened for correlated residuals, and half of the difference "
                          "between the window's halves";
  m.method = fmt::format("longest window of ln 1/(1 - D) = P/P_y + A over the upper punch's stress with R^2 >= {:g}, "
                         "in-die",
                         rule.r_squared);
  m.details = {{"mean_yield_pressure_MPa", m.value},
               {"intercept", fit.intercept},
               {"intercept_uncertainty", fit.intercept_uncertainty},
               {"density_at_zero_pressure", 1 - std::exp(-fit.intercept)},
               {"r_squared", fit.r_squared}};
  return m;
}

} // namespace

Measurement measure_heckel(const schema::FileReader& file, const StageRows& stage, const HistoryTable& history,
                           const HeckelRule& rule, std::optional<double> bulk_modulus) {
  const auto cut = [&](const char* name) {
    const auto rows = stage.rows().of(history[name]);
    return std::vector<double>(rows.begin(), rows.end());
  };
  const std::vector<double> pressure = cut("wall_stress_5"), density = cut("relative_density");
  const auto fit = heckel_window(pressure, density, rule);
  if (!fit)
    throw InputError(fmt::format("{}: stage {}: no window of {} rows or more, with pressure and relative densities up "
                                 "to {:g}, has R^2 of {:g} or more, allowed: a stage that presses, or a smaller "
                                 "--r-squared",
                                 one_line(file.path()), stage.number, rule.fewest_rows, rule.largest_density,
                                 rule.r_squared));
  Measurement m = in_die_measurement(*fit, rule);
  m.window = {stage.number,
              stage.type,
              stage.first + fit->first,
              stage.first + fit->last,
              "relative_density",
              range_of(density, fit->first, fit->last),
              "upper_punch_stress",
              range_of(pressure, fit->first, fit->last)};
  if (bulk_modulus) {
    std::vector<double> corrected;
    for (std::size_t i = 0; i < density.size(); ++i)
      corrected.push_back(density_without_elastic_compression(density[i], pressure[i], *bulk_modulus));
    add_corrected(m, "mean_yield_pressure_without_elastic_compression", *fit, pressure, corrected);
    m.details["bulk_modulus_MPa"] = *bulk_modulus;
  }
  add_corrected(m, "mean_yield_pressure_of_present_volumes", *fit, pressure, cut("relative_density_current"));
  if (*std::max_element(density.begin(), density.end()) > rule.largest_density)
    m.notes.push_back(
        fmt::format("rows denser than {:g} are left out: there ln 1/(1 - D) magnifies errors of the density",
                    rule.largest_density));
  m.brief = fmt::format("A = {:.3f}, D from {:.3f} to {:.3f}", fit->intercept, m.window.strain[0], m.window.strain[1]);
  return m;
}

} // namespace mpfem
