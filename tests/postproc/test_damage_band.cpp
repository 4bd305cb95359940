// Bands of opened bonds.

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "bonded_run.hpp"
#include "postproc/metrics/damage_band.hpp"
#include "run_postproc.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// A thousand pairs of grains on a lattice, of areas between 1 and 2 mm^2; `opened(place)` is the opened share of each.
template <class Opened>
std::vector<PairOpening> lattice(const Opened& opened) {
  std::vector<PairOpening> pairs;
  for (int i = 0; i < 1000; ++i) {
    const auto along = [](int place) { return (place + 0.5) / 10 - 0.5; };
    const Eigen::Vector3d place(along(i % 10), along(i / 10 % 10), along(i / 100));
    const double area = 1 + (i * 7 % 10) / 10.0;
    pairs.push_back({place, area, area * opened(place)});
  }
  return pairs;
}

} // namespace

TEST_CASE("bonds that open in an inclined slab give a band there, which chance does not") {
  const Eigen::Vector3d normal = Eigen::Vector3d(std::sqrt(0.5), 0, std::sqrt(0.5)); // 45 degrees off z
  const auto pairs = lattice([&](const Eigen::Vector3d& place) {
    return std::abs(normal.dot(place) - 0.1) < 0.08 ? 0.9 : 0.1; // thinner than the slabs that are tried
  });
  const auto found = band_by_chance(pairs, 2, 200);
  REQUIRE(found);
  CHECK(found->chance == 1.0 / 201); // none of 200 trials
  CHECK(found->other_excess < found->band.excess);
  CHECK(found->band.normal.dot(normal) > std::cos(0.15)); // the step between normals is 7.5 degrees
  CHECK(std::abs(found->band.offset - 0.1) < 0.051);      // and 0.05 between slabs
  // A slab of opened share s in a sample of share p: s/p. All of it lies in the slab, which is thicker.
  CHECK(found->band.concentration() > 2);
  CHECK(band_by_chance(pairs, 2, 0)->band.excess == found->band.excess);
}

TEST_CASE("bonds that open at random give no band beyond chance") {
  std::mt19937_64 random(5);
  int bands = 0;
  constexpr int samples = 40;
  for (int sample = 0; sample < samples; ++sample) {
    const auto pairs =
        lattice([&](const Eigen::Vector3d&) { return static_cast<double>(random() % 1000) < 300 ? 1.0 : 0.0; });
    if (band_by_chance(pairs, 2, 100)->chance < 0.05) ++bands;
  }
  // 5 % of 40 are 2; more than 7 occur with a probability of 0.0007.
  CHECK(bands <= 7);
}

TEST_CASE("without bonds that open, or with all of them open, there is no band") {
  CHECK_FALSE(band_by_chance(lattice([](const Eigen::Vector3d&) { return 0.0; }), 2, 0));
  CHECK_FALSE(band_by_chance(lattice([](const Eigen::Vector3d&) { return 1.0; }), 2, 0));
  CHECK_FALSE(band_by_chance({}, 2, 10));
}

TEST_CASE("who waits for the trials is told after each how many are done") {
  const auto pairs = lattice([](const Eigen::Vector3d& place) { return place[0] > 0 ? 0.5 : 0.1; });
  std::vector<double> told;
  REQUIRE(band_by_chance(pairs, 2, 4, [&](double fraction) { told.push_back(fraction); }));
  CHECK(told == std::vector<double>{0.25, 0.5, 0.75, 1});
}

TEST_CASE("the measure counts bonds that pass the threshold in the test") {
  const Folder folder;
  RunContents before = bonded_run(), now = bonded_run();
  before.texts["/provenance/scenario"] = now.texts["/provenance/scenario"] = {"[bond]\nfracture_energy = 0.5\n"};
  auto& damage = now.numbers["/snapshots/*/bond_damage"];
  const auto& area = now.numbers["/snapshots/*/bond_area"];
  const auto& was = before.numbers["/snapshots/*/bond_damage"];
  double opened = 0, whole = 0;
  for (std::size_t b = 0; b < damage.size(); ++b) {
    if (was[b] >= 0.5) continue;
    damage[b] = b % 2 == 0 ? 0.7 : was[b];
    opened += b % 2 == 0 ? area[b] : 0;
    whole += area[b];
  }
  write_run(folder / "before.h5", before);
  write_run(folder / "now.h5", now);
  const schema::FileReader first(folder / "before.h5"), second(folder / "now.h5");
  const Measurement m = measure_damage_band(second, -1, first, -1, {.threshold = 0.5, .trials = 20});
  CHECK(m.details["opened_share"].get<double>() == Approx(opened / whole).epsilon(1e-6)); // stored in single precision
  CHECK(m.details["pairs"] == 1);
  CHECK(m.value == Approx(1).epsilon(1e-6)); // a single pair: every slab that has bonds has them all
  CHECK(m.details["chance"] == 1);
  const Outcome quick =
      postproc(fmt::format("damage-band {} --before {} --trials 20", folder / "now.h5", folder / "before.h5"));
  CHECK(quick.exit_code == 0);
  CHECK_THAT(quick.output, Catch::Contains("damage-band"));
  CHECK_THAT(quick.messages, !Catch::Contains("elapsed") && !Catch::Contains("done in"));
  RunContents damaged = before;
  for (double& d : damaged.numbers["/snapshots/*/bond_damage"]) d = std::max(d, 0.5);
  write_run(folder / "damaged.h5", damaged);
  CHECK_THROWS_WITH(measure_damage_band(second, -1, schema::FileReader(folder / "damaged.h5"), -1, {.trials = 20}),
                    Catch::Contains("now.h5: all bonds have a damage of 0.5 or more before the test"));
  CHECK_THROWS_WITH(measure_damage_band(second, -1, first, -1, {.threshold = 0.9, .trials = 20}),
                    Catch::Contains("now.h5: the test opens none or all of the 1 pairs of grains"));
}
