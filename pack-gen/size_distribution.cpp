#include "pack-gen/size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"

namespace mpfem {

std::vector<double> SizeDistribution::sample(int count) const {
  std::vector<double> diameter(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) diameter[static_cast<std::size_t>(i)] = quantile((i + 0.5) / count);
  return diameter;
}

namespace {

class TableDistribution final : public SizeDistribution {
public:
  TableDistribution(std::vector<double> diameter, std::vector<double> cumulative, SizeWeight weight)
      : diameter_(std::move(diameter)), number_(std::move(cumulative)), weight_(weight) {
    if (weight_ == SizeWeight::number) return;
    std::vector<double> number(diameter_.size(), 0.0);
    for (std::size_t i = 1; i < diameter_.size(); ++i) {
      const double low = diameter_[i - 1], high = diameter_[i];
      const double volume_density = (number_[i] - number_[i - 1]) / (high - low);
      number[i] = number[i - 1] + volume_density * 0.5 * (1 / (low * low) - 1 / (high * high));
    }
    const double total = number.back();
    for (double& value : number) value /= total;
    number_ = std::move(number);
  }

  double quantile(double cumulative) const override {
    const auto above = std::lower_bound(number_.begin() + 1, number_.end() - 1, cumulative);
    const auto i = static_cast<std::size_t>(above - number_.begin());
    const double step = number_[i] - number_[i - 1];
    const double u = step > 0 ? std::clamp((cumulative - number_[i - 1]) / step, 0.0, 1.0) : 1.0;
    const double low = diameter_[i - 1], high = diameter_[i];
    if (weight_ == SizeWeight::number) return low + u * (high - low);
    return 1 / std::sqrt((1 - u) / (low * low) + u / (high * high));
  }

  double cumulative_number(double diameter) const override {
    if (diameter <= diameter_.front()) return number_.front();
    if (diameter >= diameter_.back()) return 1;
    const auto above = std::upper_bound(diameter_.begin(), diameter_.end(), diameter);
    const auto i = static_cast<std::size_t>(above - diameter_.begin());
    const double low = diameter_[i - 1], high = diameter_[i];
    const double u = weight_ == SizeWeight::number
                         ? (diameter - low) / (high - low)
                         : (1 / (low * low) - 1 / (diameter * diameter)) / (1 / (low * low) - 1 / (high * high));
    return number_[i - 1] + u * (number_[i] - number_[i - 1]);
  }

private:
  std::vector<double> diameter_, number_;
  SizeWeight weight_;
};

double standard_normal_cumulative(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

class LogNormalDistribution final : public SizeDistribution {
public:
  LogNormalDistribution(double median, double log_deviation, double smallest, double largest)
      : log_median_(std::log(median)), log_deviation_(log_deviation), smallest_(smallest), largest_(largest) {
    below_ = standard_normal_cumulative(normal(smallest));
    inside_ = standard_normal_cumulative(normal(largest)) - below_;
    if (!(inside_ > 1e-9))
      throw InputError(fmt::format(
          "log-normal size distribution: it has no sizes between {:g} and {:g} mm, allowed: limits around its median",
          smallest, largest));
  }

  double quantile(double cumulative) const override {
    // Bisection in ln d: monotone, and only a few thousand quantiles are ever needed.
    const double target = below_ + cumulative * inside_;
    double low = smallest_ > 0 ? normal(smallest_) : -9, high = std::isfinite(largest_) ? normal(largest_) : 9;
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (standard_normal_cumulative(middle) < target ? low : high) = middle;
    }
    return std::exp(log_median_ + log_deviation_ * 0.5 * (low + high));
  }

  double cumulative_number(double diameter) const override {
    if (diameter <= smallest_) return 0;
    if (diameter >= largest_) return 1;
    return (standard_normal_cumulative(normal(diameter)) - below_) / inside_;
  }

private:
  double normal(double diameter) const { return (std::log(diameter) - log_median_) / log_deviation_; }

  double log_median_, log_deviation_, smallest_, largest_, below_ = 0, inside_ = 1;
};

class ListDistribution final : public SizeDistribution {
public:
  explicit ListDistribution(std::vector<double> diameter) : diameter_(std::move(diameter)), sorted_(diameter_) {
    std::sort(sorted_.begin(), sorted_.end());
  }
  double quantile(double cumulative) const override {
    const auto n = static_cast<double>(sorted_.size());
    return sorted_[static_cast<std::size_t>(std::clamp(std::ceil(cumulative * n) - 1, 0.0, n - 1))];
  }
  double cumulative_number(double diameter) const override {
    const auto above = std::upper_bound(sorted_.begin(), sorted_.end(), diameter);
    return static_cast<double>(above - sorted_.begin()) / static_cast<double>(sorted_.size());
  }
  std::vector<double> sample(int count) const override {
    if (static_cast<std::size_t>(count) != diameter_.size())
      throw InputError(fmt::format("a list of {} sizes cannot give {} spheres, allowed: as many spheres as sizes",
                                   diameter_.size(), count));
    return diameter_;
  }

private:
  std::vector<double> diameter_, sorted_;
};

} // namespace

std::unique_ptr<SizeDistribution> table_distribution(std::vector<double> diameter, std::vector<double> cumulative,
                                                     SizeWeight weight) {
  if (diameter.size() != cumulative.size() || diameter.size() < 2)
    throw InputError(fmt::format("size table: found {} sizes and {} cumulative fractions, allowed: equally many, at "
                                 "least two",
                                 diameter.size(), cumulative.size()));
  for (std::size_t i = 0; i < diameter.size(); ++i) {
    if (!(diameter[i] > 0) || !std::isfinite(diameter[i]))
      throw InputError(fmt::format("size table: size {} is {:g}, allowed: > 0", i + 1, diameter[i]));
    if (i > 0 && !(diameter[i] > diameter[i - 1]))
      throw InputError(fmt::format("size table: size {} ({:g}) is not above the one before ({:g}), allowed: ascending "
                                   "sizes",
                                   i + 1, diameter[i], diameter[i - 1]));
    if (i > 0 && !(cumulative[i] >= cumulative[i - 1]))
      throw InputError(fmt::format("size table: cumulative fraction {} ({:g}) is below the one before ({:g}), allowed: "
                                   "not decreasing",
                                   i + 1, cumulative[i], cumulative[i - 1]));
  }
  if (std::abs(cumulative.front()) > 1e-12 || std::abs(cumulative.back() - 1) > 1e-12)
    throw InputError(fmt::format("size table: cumulative fractions run from {:g} to {:g}, allowed: from 0 to 1",
                                 cumulative.front(), cumulative.back()));
  return std::make_unique<TableDistribution>(std::move(diameter), std::move(cumulative), weight);
}

std::unique_ptr<SizeDistribution> log_normal_distribution(double median, double log_deviation, SizeWeight weight,
                                                          double smallest, double largest) {
  const double number_median =
      weight == SizeWeight::number ? median : median * std::exp(-3 * log_deviation * log_deviation);
  return std::make_unique<LogNormalDistribution>(number_median, log_deviation, smallest, largest);
}

std::unique_ptr<SizeDistribution> list_distribution(std::vector<double> diameter) {
  if (diameter.empty()) throw InputError("size list: found no size, allowed: one or more");
  for (const double value : diameter)
    if (!(value > 0) || !std::isfinite(value))
      throw InputError(fmt::format("size list: found {:g}, allowed: > 0", value));
  return std::make_unique<ListDistribution>(std::move(diameter));
}

double total_sphere_volume(const std::vector<double>& diameter) {
  double cubes = 0;
  for (const double d : diameter) cubes += d * d * d;
  return std::numbers::pi / 6 * cubes;
}

double size_scale(const std::vector<double>& diameter, double relative_density, double box_volume) {
  return std::cbrt(relative_density * box_volume / total_sphere_volume(diameter));
}

} // namespace mpfem
