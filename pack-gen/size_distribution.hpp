#pragma once
// Size distributions of spheres, as quantile functions of the number-cumulative fraction.
//
// A distribution may be stated by number or by volume, in diameters or in radii; everything is converted to diameters
// by number. Sizes of a sample are the quantiles at (i + 1/2)/n, so that a sample of few spheres still follows the
// curve: its empirical cumulative fraction differs from the target by at most 1/(2n).

#include <memory>
#include <string>
#include <vector>

namespace mpfem {

/// What the cumulative fraction counts.
enum class SizeWeight { number, volume };

/// Diameters (mm, > 0) as a function of the cumulative number fraction.
class SizeDistribution {
public:
  virtual ~SizeDistribution() = default;
  /// Diameter in mm below which the fraction `cumulative` (0 … 1) of all spheres lies.
  virtual double quantile(double cumulative) const = 0;
  /// Fraction (0 … 1) of spheres whose diameter is at most `diameter` (mm).
  virtual double cumulative_number(double diameter) const = 0;
  /// `count` diameters in mm, ascending: the quantiles at (i + 1/2)/count.
  virtual std::vector<double> sample(int count) const;
};

/// Piecewise-linear cumulative curve through (diameter[i], cumulative[i]). Within an interval the density of the stated
/// weight is constant; by volume the number density then falls as 1/d^3, which is integrated exactly.
/// `diameter` ascending, > 0, mm; `cumulative` from 0 to 1, not decreasing. Throws InputError.
std::unique_ptr<SizeDistribution> table_distribution(std::vector<double> diameter, std::vector<double> cumulative,
                                                     SizeWeight weight);

/// Log-normal in diameter with `median` (mm, of the stated weight) and `log_deviation` (standard deviation of ln d),
/// cut to smallest … largest (mm). By volume the number median is median exp(-3 s^2) (Hatch & Choate 1929).
std::unique_ptr<SizeDistribution> log_normal_distribution(double median, double log_deviation, SizeWeight weight,
                                                          double smallest, double largest);

/// Exactly these diameters (mm, any order); a sample must have as many spheres, and keeps their order.
std::unique_ptr<SizeDistribution> list_distribution(std::vector<double> diameter);

/// Sum of sphere volumes (mm^3) of these diameters (mm).
double total_sphere_volume(const std::vector<double>& diameter);

/// Uniform factor on the diameters that makes their volume `relative_density` times `box_volume` (mm^3).
double size_scale(const std::vector<double>& diameter, double relative_density, double box_volume);

} // namespace mpfem
