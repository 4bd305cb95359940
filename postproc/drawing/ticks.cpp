#include "postproc/drawing/ticks.hpp"

#include <cmath>

namespace mpfem {

double tick_distance(std::pair<double, double> range, int most) {
  const double width = range.second - range.first;
  double distance = std::pow(10.0, std::floor(std::log10(width / most)));
  for (const double factor : {2.0, 2.5, 2.0}) // 1, 2, 5, 10
    if (width / distance > most) distance *= factor;
  return distance;
}

std::vector<double> round_ticks(std::pair<double, double> range, int most) {
  const double width = range.second - range.first, distance = tick_distance(range, most);
  std::vector<double> ticks;
  for (double k = std::ceil(range.first / distance - 1e-9); k * distance <= range.second + 1e-9 * width; ++k)
    ticks.push_back(k * distance + 0.0); // no -0
  return ticks;
}

} // namespace mpfem
