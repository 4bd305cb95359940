#include "solver/bench/machine.hpp"

#include <algorithm>
#include <vector>

#include "solver/model/aligned.hpp"
#include "solver/physics/pack.hpp"
#include "solver/run/profile.hpp"

namespace mpfem {

namespace {

constexpr int repetitions = 7;

template <class Body>
double best_time(ThreadTeam& team, const Body& body) {
  double best = 1e300;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = Profile::Clock::now();
    team.for_each(team.size(), [&](int part, int) { body(part); });
    best = std::min(best, Profile::since(start));
  }
  return best;
}

} // namespace

double measure_triad(ThreadTeam& team) {
  constexpr std::size_t length = 8U << 20U; // 64 MB an array and thread
  struct Arrays {
    AlignedVector<double> a, b, c;
  };
  std::vector<Arrays> arrays(static_cast<std::size_t>(team.size()));
  team.for_each(team.size(), [&](int part, int) {
    Arrays& own = arrays[static_cast<std::size_t>(part)];
    own.a.assign(length, 0.0), own.b.assign(length, 1.0), own.c.assign(length, 2.0);
  });
  double scale = 0.5;
  const double time = best_time(team, [&](int part) {
    Arrays& own = arrays[static_cast<std::size_t>(part)];
    for (std::size_t i = 0; i < length; i += static_cast<std::size_t>(native_lanes))
      (NativePack::load(&own.b[i]) + NativePack(scale) * NativePack::load(&own.c[i])).store(&own.a[i]);
  });
  return 24e-9 * static_cast<double>(length) * team.size() / time;
}

double measure_fma(ThreadTeam& team) {
  constexpr int chains = 12, rounds = 2'000'000; // latency 4 or 5, two units: ten chains or more keep them busy
  std::vector<double> sink(static_cast<std::size_t>(team.size()) * 8);
  const double time = best_time(team, [&](int part) {
    NativePack x[chains];
    for (int k = 0; k < chains; ++k) x[k] = NativePack(1.0 + 1e-3 * k);
    const NativePack factor(0.999999), term(1e-6);
    for (int i = 0; i < rounds; ++i)
      for (auto& chain : x) chain = factor * chain + term;
    double total = 0;
    for (const auto& chain : x) total += sum(chain);
    sink[static_cast<std::size_t>(part) * 8] = total;
  });
  // Reading the sums keeps the compiler from removing them.
  const double factor = std::all_of(sink.begin(), sink.end(), [](double s) { return s == s; }) ? 1.0 : 0.0;
  return factor * 2e-9 * chains * native_lanes * static_cast<double>(rounds) * team.size() / time;
}

} // namespace mpfem
