// What finding the grains near its own costs a rank for each grain of all ranks: near-grains GRAINS prints ns per
// grain, the median of 31 searches for the grains near one, on one thread. Grains are boxes of 0.1 mm on a lattice.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

#include "solver/kernels/contact_search.hpp"

namespace {

using namespace mpfem;

std::vector<Bounds> lattice(int grains) {
  const int side = static_cast<int>(std::ceil(std::cbrt(grains)));
  std::vector<Bounds> bounds;
  for (int g = 0; g < grains; ++g) {
    Bounds box;
    const int at[3] = {g / (side * side), g / side % side, g % side};
    for (std::size_t axis = 0; axis < 3; ++axis) box.low[axis] = 0.1 * at[axis], box.high[axis] = box.low[axis] + 0.1;
    bounds.push_back(box);
  }
  return bounds;
}

} // namespace

int main(int argc, char** argv) {
  const int grains = argc == 2 ? std::atoi(argv[1]) : 0;
  if (grains < 1) {
    fmt::print(stderr, "usage: near-grains GRAINS\n");
    return 2;
  }
  const std::vector<Bounds> bounds = lattice(grains);
  ThreadTeam team(1);
  std::vector<double> seconds;
  for (int i = 0; i < 31; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const NearGrains near = find_near_grains(bounds, 0.005, {grains / 2}, team);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (near.other.size() != 1) return 1;
  }
  std::sort(seconds.begin(), seconds.end());
  fmt::print("{:.2f} ns per grain\n", 1e9 * seconds[seconds.size() / 2] / grains);
}
