#pragma once
// How often uncertainties hold, and how wide they are, over many trials with different noise.

#include <cmath>

namespace mpfem::test {

class Coverage {
public:
  void add(double error, double uncertainty) {
    ++trials_;
    held_ += std::abs(error) <= uncertainty ? 1 : 0;
    squares_ += error * error;
    widths_ += uncertainty;
  }
  /// Share of the trials in which the error was within the uncertainty.
  double share() const { return held_ / trials_; }
  /// Mean uncertainty over the root mean square of the errors: 1.96 for normal errors of a known standard deviation.
  double width() const { return widths_ / trials_ / std::sqrt(squares_ / trials_); }

private:
  double trials_ = 0, held_ = 0, squares_ = 0, widths_ = 0;
};

} // namespace mpfem::test
