#pragma once
// Small statistics that the metrics share.

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mpfem {

/// The value that |t| of Student's distribution with `degrees_of_freedom` >= 1 exceeds with a probability of 5 %
/// (12.706 for 1, 1.960 for many). Closed form for whole degrees: Abramowitz & Stegun 26.7.3, 26.7.4.
double student_t_95(std::size_t degrees_of_freedom);

/// Percentiles of weighted values.
class WeightedPercentiles {
public:
  /// Pairs of value and weight > 0.
  explicit WeightedPercentiles(std::vector<std::pair<double, double>> value_and_weight);
  /// The smallest value up to which at least this share (0 … 1) of the weight lies; 0 without values.
  double at(double share) const;

private:
  std::vector<std::pair<double, double>> value_and_weight_; ///< sorted by value
  double total_ = 0;
};

/// A straight line value = intercept + slope * x.
struct Line {
  double intercept = 0, slope = 0;
  /// Half of the 95 % intervals; that of the intercept by least squares only. NaN where they are not known.
  double slope_half_width = std::numeric_limits<double>::quiet_NaN();
  double intercept_half_width = std::numeric_limits<double>::quiet_NaN();
  double scatter = 0; ///< standard deviation of the residuals
};

/// Ordinary least squares. Needs two different x; below three points half widths are not known and the scatter is 0.
Line least_squares_line(std::span<const double> x, std::span<const double> y);

/// Theil-Sen: the median slope of all pairs of points (Sen 1968), which is robust against up to 29 % of outliers;
/// intercept through the medians. The half width is that of Sen's interval from Kendall's statistic, widened for
/// correlated residuals (ringing) by sqrt((1 + r) / (1 - r)) with their lag-1 autocorrelation r. Needs two different x.
Line theil_sen_line(std::span<const double> x, std::span<const double> y);

/// Values, at each row, of parabolas fitted to `half_rows` rows on either side of it (near an end to as many rows,
/// shifted inwards). A parabola, unlike a running mean, does not cut off peaks. Needs 2 * half_rows + 1 values or more,
/// half_rows >= 1.
std::vector<double> local_parabolas(std::span<const double> y, std::size_t half_rows);

/// Share of the rows' noise (variance, independent from row to row) that local_parabolas leave in a row away from the
/// ends: a third for half_rows = 3 (Savitzky and Golay 1964).
double noise_left_by_parabolas(std::size_t half_rows);

/// A parabola in (x - centre) / scale, so that its coefficients are of the same order.
struct Parabola {
  double centre = 0, scale = 1;
  std::array<double, 3> coefficient{};
  double scatter = 0;      ///< standard deviation of the residuals
  std::size_t freedom = 0; ///< degrees of freedom: number of points minus three
  double at(double x) const {
    const double t = (x - centre) / scale;
    return coefficient[0] + t * (coefficient[1] + t * coefficient[2]);
  }
};

/// Ordinary least squares. Needs three points or more; scatter and freedom are 0 for three.
Parabola least_squares_parabola(std::span<const double> x, std::span<const double> y);

/// A statistic with its uncertainty.
struct Ratio {
  double value = 0;
  double half_width = std::numeric_limits<double>::quiet_NaN(); ///< half of the 95 % interval; NaN: not known
};

/// sum(y) / sum(x) over units that are independent of each other (y and x of one unit need not be): the ratio estimator
/// of cluster samples. Variance by linearisation, n / (n - 1) sum((y - R x)^2) / sum(x)^2 (Cochran, Sampling
/// Techniques, 3rd ed. 1977, chapter 6), interval by Student's t with n - 1 degrees of freedom; that of one unit is not
/// known. Needs sum(x) > 0.
Ratio ratio_of_sums(std::span<const double> y, std::span<const double> x);

/// Standard deviation (n - 1) and half of its 95 % interval from its variance (m_4 - s^4) / (4 n s^2), m_4 the fourth
/// central moment; no normal distribution is assumed. For fewer than two values it is 0 and its interval not known.
Ratio standard_deviation(std::span<const double> values);

/// The middle value, or the mean of the two middle ones; needs at least one value.
double median(std::vector<double> values);

/// Where a value is first reached, rising or falling: a row, and a fraction of the step to the next row.
struct Crossing {
  std::size_t row = 0;
  double fraction = 0; ///< 0 … 1
  /// Linear interpolation of another column there.
  double of(std::span<const double> column) const {
    return fraction > 0 ? column[row] + fraction * (column[row + 1] - column[row]) : column[row];
  }
  /// Half of that column's change between the two rows, as the uncertainty of the interpolation.
  double half_spacing(std::span<const double> column) const;
};

/// Where a column first reaches `value`, from either side, between two of its rows `first` … `last`; empty where it
/// does not.
std::optional<Crossing> first_crossing(std::span<const double> column, std::size_t first, std::size_t last,
                                       double value);

} // namespace mpfem
