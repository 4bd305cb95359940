#pragma once
// Small statistics that the metrics share.

#include <cstddef>
#include <span>
#include <vector>

namespace mpfem {

/// The value that Student's t with `degrees_of_freedom` >= 1 exceeds in absolute value with a probability of 5 %
/// (12.706 for 1, 1.960 for many). Closed distribution function of whole degrees: Abramowitz & Stegun 26.7.3, 26.7.4.
double student_t_95(std::size_t degrees_of_freedom);

/// A straight line value = intercept + slope * x.
struct Line {
  double intercept = 0, slope = 0;
  double slope_half_width = 0;     ///< half of the 95 % interval of the slope
  double intercept_half_width = 0; ///< and of the intercept; of least squares only
  double scatter = 0;              ///< standard deviation of the residuals
};

/// Ordinary least squares. Needs two different x; half widths and scatter are 0 below three points.
Line least_squares_line(std::span<const double> x, std::span<const double> y);

/// Theil-Sen: the median slope of all pairs of points (Sen 1968), which up to 29 % of outliers do not move; intercept
/// through the medians. The half width is that of Sen's interval from Kendall's statistic, widened for residuals that
/// follow each other (ringing) by sqrt((1 + r) / (1 - r)) with their lag-1 autocorrelation r. Needs two different x.
Line theil_sen_line(std::span<const double> x, std::span<const double> y);

/// Values at each row of parabolas that are fitted around it, to `half_rows` rows on either side (near the ends to as many
/// rows, none beyond the end). A parabola, unlike a running mean, does not cut off peaks.
/// Needs 2 * half_rows + 1 values or more, half_rows >= 1.
std::vector<double> local_parabolas(std::span<const double> y, std::size_t half_rows);

double median(std::vector<double> values); ///< of at least one value

/// Row and fraction towards the next one where a value is first reached, rising or falling.
struct Crossing {
  std::size_t row = 0;
  double fraction = 0; ///< 0 … 1
  /// Linear interpolation of another column there.
  double of(std::span<const double> column) const {
    return fraction > 0 ? column[row] + fraction * (column[row + 1] - column[row]) : column[row];
  }
  /// Half of that column's change between the two rows: what lies between them is not known better.
  double half_spacing(std::span<const double> column) const;
};

} // namespace mpfem
