// Damage of all bonds of a snapshot: against numbers worked out by hand, and against populations of contacts that are
// known.

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "bonded_run.hpp"
#include "coverage.hpp"
#include "postproc/metrics/damage_statistics.hpp"
#include "run_postproc.hpp"
#include "stage_run.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Numbers from 0 to 1, evenly distributed.
class Uniform {
public:
  explicit Uniform(unsigned seed) : engine_(seed) {}
  double operator()() { return (static_cast<double>(engine_()) + 0.5) / 4294967296.0; }

private:
  std::mt19937 engine_;
};

/// Contacts of one to eight bonds. A contact's u in (0, 1) makes its bonds' area grow as 1/2 + u; below 1/4 all of them
/// are broken, else their damage is 1 - u v with v in (0, 1) of the bond.
std::vector<BondSample> population(std::size_t pairs, unsigned seed) {
  Uniform uniform(seed);
  std::vector<BondSample> bonds;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const double u = uniform(), count = std::ceil(8 * uniform());
    for (int b = 0; b < count; ++b) bonds.push_back({pair, 0.01 * (0.5 + u), u < 0.25 ? 1.0 : 1 - u * uniform()});
  }
  return bonds;
}

/// Share of that population's area with damage 1 - s or less, for s > 1/4: the integral of (1/2 + u) (1 - s/u) from s
/// to 1.
double population_share(double s) {
  return 1 - 1.5 * s + 0.5 * s * s + 0.5 * s * std::log(s);
}

} // namespace

TEST_CASE("three contacts have the damage worked out by hand") {
  // Contact 0: areas 1 and 1, damage 0 and 1. Contact 1: area 2, broken. Contact 2: area 4, damage 1/4.
  const std::vector<BondSample> bonds = {{0, 1, 0}, {2, 4, 0.25}, {1, 2, 1}, {0, 1, 1}};
  const DamageStatistics s = damage_statistics(bonds);
  CHECK(s.bonds == 4);
  CHECK(s.pairs == 3);
  CHECK(s.area == 8);
  CHECK(s.mean.value == 0.5); // (1 + 2 + 1) / 8
  // The pairs' sums less half their areas: 0, 1, -1; Student's t of two degrees of freedom 4.3027.
  CHECK(within(s.mean.half_width, 4.3027 * std::sqrt(3.0 / 2 * 2) / 8, 1e-4));
  CHECK(s.broken_share.value == 0.375);
  // 1 - 3/8 * 2, 2 - 3/8 * 2, -3/8 * 4: 1/4, 5/4, -3/2.
  CHECK(within(s.broken_share.half_width, 4.3027 * std::sqrt(1.5 * (0.0625 + 1.5625 + 2.25)) / 8, 1e-4));
  CHECK(s.undamaged_share.value == 0.125);
  CHECK(within(s.wholly_broken_pairs.value, 1.0 / 3, rounding));
  // Means of 1/2, 1 and 1/4 about 7/12.
  CHECK(within(s.between_pairs.value, std::sqrt((1.0 + 25 + 16) / 144 / 2), rounding));
  // Shares of 1/8 at 0, 5/8 at 1/4, 1 at 1.
  const double expected[] = {0, 0.25, 0.25, 1, 1};
  for (std::size_t i = 0; i < damage_percentiles.size(); ++i) CHECK(s.percentile[i].value == expected[i]);
  const std::vector<Column> distribution = damage_distribution(bonds);
  CHECK(distribution[0].values == std::vector<double>{0, 0.25, 1});
  CHECK(distribution[1].values == std::vector<double>{0.125, 0.625, 1});
  CHECK(damage_percentile(distribution, 0.625) == 0.25); // reached, not only approached
  CHECK(damage_percentile(distribution, 0.626) == 1);
  CHECK(damage_percentile(distribution, -0.1) == 0);
  CHECK(damage_percentile(distribution, 1.1) == 1);
}

TEST_CASE("the damage of a population of contacts lies within its interval in 95 of 100 samples") {
  // Of the area: mean 1 - integral of (1/2 + u) u/2 from 1/4 to 1 = 0.71875, broken that of 1/2 + u up to 1/4.
  const double mean = 0.71875, broken = 0.15625, wholly_broken = 0.25;
  double low = 0.25, high = 1; // of s = 1 - D at the 25th percentile
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (population_share(middle) > 0.25 ? low : high) = middle;
  }
  const double lower_quartile = 1 - low;
  Coverage of_mean, of_broken, of_pairs, of_quartile, as_if_single;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::vector<BondSample> bonds = population(200, seed);
    const DamageStatistics s = damage_statistics(bonds);
    of_mean.add(s.mean.value - mean, s.mean.half_width);
    of_broken.add(s.broken_share.value - broken, s.broken_share.half_width);
    of_pairs.add(s.wholly_broken_pairs.value - wholly_broken, s.wholly_broken_pairs.half_width);
    of_quartile.add(s.percentile[1].value - lower_quartile, s.percentile[1].half_width);
    for (std::size_t b = 0; b < bonds.size(); ++b) bonds[b].pair = b;
    as_if_single.add(s.mean.value - mean, damage_statistics(bonds).mean.half_width);
  }
  // 300 samples know a share of 95 % to 1.3 %: 0.88 and 0.99 are five and three times that away.
  for (const auto& [name, c] :
       {std::pair{"mean", of_mean}, {"broken", of_broken}, {"pairs", of_pairs}, {"quartile", of_quartile}}) {
    INFO(name << " holds in " << c.share() << ", width " << c.width());
    CHECK(c.share() >= 0.88);
    CHECK(c.share() <= 0.99);
    CHECK(c.width() > 1.6); // 1.96 for normal errors
    CHECK(c.width() < 2.4);
  }
  // Were bonds taken as independent, the interval would be too narrow by a half.
  INFO("bonds as independent: " << as_if_single.share());
  CHECK(as_if_single.share() < 0.8);
}

TEST_CASE("a share of 0 or 1 has the uncertainty that follows from the number of contacts") {
  std::vector<BondSample> bonds;
  for (std::size_t pair = 0; pair < 60; ++pair) bonds.push_back({pair, 1, 0.5});
  const DamageStatistics s = damage_statistics(bonds);
  CHECK(s.broken_share.value == 0);
  CHECK(within(s.broken_share.half_width, 3.0 / 60, rounding));
  CHECK(within(s.wholly_broken_pairs.half_width, 3.0 / 60, rounding));
  CHECK(s.between_pairs.value == 0);
  // Where 4 % of all contacts are broken, none of 60 is in 0.96^60 = 9 % of the samples; where 5 % are, in 4.6 %: 3/60
  // is the limit.
  CHECK(std::pow(1 - 3.0 / 60, 60) < 0.05);
}

TEST_CASE("damage reports the bonds of a snapshot as JSON, as one line and as a distribution") {
  const Folder folder;
  RunContents contents =
      bonded_run(); // damage rises from 0 to 1 over five lines of nodes, of an eighth, a quarter … of the area
  contents.numbers["/snapshots/*/mean_stress"] = {12.5};
  contents.numbers["/history/stage"] = {0, 0, 1};
  contents.texts["/provenance/scenario"] = {
      "[[stages]]\ntype = 'isotropic_compaction'\n[[stages]]\ntype = 'isotropic_unloading'\n"};
  write_run(folder / "run.h5", contents);
  const Outcome outcome =
      postproc(fmt::format("damage {} -o {} --data {}", folder / "run.h5", folder / "d.json", folder / "d.csv"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Catch::StartsWith("damage: 0.5; 12.5 % of the area broken, 12.5 % undamaged"));
  CHECK_THAT(outcome.output, Catch::Contains("(stage 1, snapshot 0)"));
  CHECK_THAT(outcome.messages, Catch::Contains("one pair of grains"));
  const auto json = nlohmann::json::parse(read_text(folder / "d.json"));
  CHECK(json["metric"] == "damage");
  CHECK(json["unit"] == "1");
  CHECK(within(json["value"].get<double>(), 0.5, rounding));
  CHECK(json["uncertainty"].is_null()); // unknown, not 0
  CHECK_THAT(json["uncertainty_meaning"].get<std::string>(), Catch::Contains("pairs of grains"));
  CHECK(json["window"]["snapshot"] == 0);
  CHECK(json["window"]["relative_density"] == 0.8);
  CHECK(json["window"]["mean_stress_MPa"] == 12.5);
  CHECK(json["window"]["stage"] == 1);
  CHECK(json["window"]["stage_type"] == "isotropic_unloading");
  CHECK(within(json["broken_share"].get<double>(), 0.125, rounding));
  CHECK(json["broken_share_uncertainty"].is_null());
  CHECK(within(json["undamaged_share"].get<double>(), 0.125, rounding));
  const double percentiles[] = {0, 0.25, 0.5, 0.75, 1};
  for (std::size_t i = 0; i < damage_percentiles.size(); ++i)
    CHECK(json[fmt::format("damage_percentile_{}", damage_percentiles[i])] == percentiles[i]);
  CHECK(json["wholly_broken_pairs_share"] == 0);
  CHECK(json["pairs"] == 1);
  CHECK(json["bonds"] == 50);
  CHECK(within(json["bond_area_mm2"].get<double>(), 8, rounding));
  CHECK_THAT(read_text(folder / "d.csv"), Catch::StartsWith("damage [1],area_share [1]\n0,0.125\n0.25,0.375\n"));
  CHECK(postproc(fmt::format("damage {} --quiet", folder / "run.h5")).output.empty());
  CHECK_THAT(postproc("damage --help").output, Catch::Contains("Example: postproc damage"));
}

TEST_CASE("bonds count for the pair of grains that they join, whichever side they stand on") {
  const Folder folder;
  RunContents contents = bonded_run();
  // A bond of grain 2 to grain 1: the second pair. Its node is the last one of all.
  contents.numbers["/snapshots/*/bond_node"].push_back(static_cast<double>(contents.extents.at("nodes")) - 1);
  contents.numbers["/snapshots/*/bond_grain"].push_back(1);
  contents.numbers["/snapshots/*/bond_damage"].push_back(1);
  contents.numbers["/snapshots/*/bond_area"].push_back(2);
  contents.numbers["/snapshots/*/bond_separation"].insert(contents.numbers["/snapshots/*/bond_separation"].end(),
                                                          {0, 0});
  ++contents.extents["*bonds"];
  write_run(folder / "run.h5", contents);
  const Measurement m = measure_damage(schema::FileReader(folder / "run.h5"), 0);
  CHECK(m.details["pairs"] == 2);
  CHECK(within(m.value, 0.6, rounding)); // (4 + 2) / (8 + 2)
  CHECK(m.details["wholly_broken_pairs_share"] == 0.5);
  CHECK(within(m.details["standard_deviation_between_pairs"].get<double>(), 0.5 / std::sqrt(2.0), rounding));
  CHECK(m.uncertainty > 0);
  CHECK(m.notes.empty());
}

TEST_CASE("damage refuses runs and snapshots without bonds with one line and exit code 2") {
  const Folder folder;
  write_run(folder / "plain.h5", small_run());
  RunContents early = bonded_run();
  for (const char* name : {"node", "grain", "damage", "area", "separation"})
    early.numbers[fmt::format("/snapshots/*/bond_{}", name)].clear();
  early.extents["*bonds"] = 0;
  write_run(folder / "early.h5", early);
  const std::string plain = folder / "plain.h5", without = folder / "early.h5";
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {plain, "has no bonds, allowed: a run with bonds"},
           {without, "no bond was formed by snapshot 0000"},
           {without + " --snapshot 3", "no snapshot 3"},
           {folder / "absent.h5", "no such file"},
           {without + " --data " + without, "would overwrite the input"}}) {
    const Outcome outcome = postproc("damage " + arguments + (arguments == plain ? " -o " + (folder / "x.json") : ""));
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    CHECK_FALSE(std::filesystem::exists(folder / "x.json"));
  }
}

TEST_CASE("bonds of nodes or grains that a run does not have are refused with one line and exit code 2") {
  const Folder folder;
  const auto refused = [&](const char* dataset, double changed, const std::string& expected) {
    RunContents contents = bonded_run();
    contents.numbers[dataset].back() = changed;
    write_run(folder / "run.h5", contents);
    const Outcome outcome = postproc("damage " + (folder / "run.h5"));
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
  };
  const auto nodes = static_cast<double>(bonded_run().extents.at("nodes"));
  refused("/mesh/grain_node_offset", nodes - 1, "grain_node_offset does not rise from 0 to the number of nodes");
  refused("/snapshots/*/bond_node", nodes, fmt::format("bond_node names node {}, allowed: 0 … {}", nodes, nodes - 1));
  refused("/snapshots/*/bond_grain", -1, "bond_grain names grain -1, allowed: 0 … 2");
}
