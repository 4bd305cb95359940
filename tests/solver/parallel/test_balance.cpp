// Ranks that have more work than others give grains away. One rank has no other to compare with: these cases are run
// with mpirun only, see CMakeLists.txt.

#include <algorithm>
#include <vector>

#include <catch2/catch.hpp>

#include "common/index.hpp"
#include "common/table_reader.hpp"
#include "solver/run/balance.hpp"
#include "solver/scenario/read_scenario.hpp"
#include "tests/solver/parallel/test_ranks.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Model model_of_eight_grains() {
  const Scenario scenario = read_scenario(TomlDocument::from_text(material_text + R"([[stages]]
name = "hold"
type = "hold"
duration = 1
)",
                                                                  "test"));
  MeshedPacking packing = eight_grains(4);
  divide(packing, test_ranks());
  return build_model(packing, scenario, "test", test_ranks());
}

/// Measures ranks that work for a time (s) on tetrahedra and on contact, with each grain's work on contact.
Balance measured(const Model& model, double on_tets, double on_contact = 0, std::vector<double> contact_work = {}) {
  contact_work.resize(at(model.grains), 0);
  return measure_balance(test_ranks(), model, contact_work, {on_tets, on_contact});
}

} // namespace

TEST_CASE("The imbalance of ranks is the largest share of the work over the mean", "[.several-ranks]") {
  const Model model = model_of_eight_grains();
  const int ranks = test_ranks().size();
  REQUIRE(ranks > 1);
  const Balance even = measured(model, 2.0);
  CHECK(within(even.imbalance, 1, rounding));
  CHECK_FALSE(pays(even, 1, 1e9, 0));
  // The first rank works three times as long: 3 over (3 + (n - 1)) / n.
  const Balance uneven = measured(model, test_ranks().is_root() ? 3.0 : 1.0);
  CHECK(within(uneven.imbalance, 3.0 * ranks / (2 + ranks), rounding));
  CHECK(pays(uneven, 1, 100, 1));
  CHECK_FALSE(pays(uneven, 1, 1, 1));
  CHECK_FALSE(pays(uneven, uneven.imbalance, 1e9, 0));
}

TEST_CASE("Grains that cannot be divided more evenly stay where they are", "[.several-ranks]") {
  const Model model = model_of_eight_grains();
  // Equal grains with equal costs: three ranks have 3, 3 and 2 of eight, which no division betters.
  const double own = static_cast<double>(model.own().size());
  const Balance balance = measured(model, own);
  const auto owner = redistribute(test_ranks(), model, balance);
  const int ranks = test_ranks().size();
  CHECK(within(expected_imbalance(balance, model.ownership.owner, ranks), balance.imbalance, rounding));
  CHECK(expected_imbalance(balance, owner, ranks) >= balance.imbalance * (1 - rounding));
  CHECK_FALSE(pays(balance, expected_imbalance(balance, owner, ranks), 1e9, 0));
}

TEST_CASE("A rank that is three times as slow hands over work", "[.several-ranks]") {
  const Model model = model_of_eight_grains();
  const int ranks = test_ranks().size();
  REQUIRE(ranks > 1);
  const Balance balance = measured(model, test_ranks().is_root() ? 3.0 : 1.0);
  const auto owner = redistribute(test_ranks(), model, balance);
  REQUIRE(owner.size() == 8);
  // s of the busiest rank, where each grain costs what it has cost its first owner.
  const auto busiest = [&](const std::vector<std::int32_t>& owners) {
    std::vector<double> busy(at(ranks), 0.0);
    for (std::size_t g = 0; g < owners.size(); ++g) busy[at(owners[g])] += balance.cost[g];
    CHECK(std::ranges::all_of(busy, [](double seconds) { return seconds > 0; })); // none is without grains
    return *std::ranges::max_element(busy);
  };
  CHECK(busiest(owner) <= busiest(model.ownership.owner));
  CHECK(within(expected_imbalance(balance, owner, ranks) / balance.imbalance,
               busiest(owner) / busiest(model.ownership.owner), rounding));
  // Two ranks: grains of weight 3, 3, 3, 3, 1, 1, 1, 1 are cut to at most 9 of 16.
  if (ranks == 2) CHECK(busiest(owner) <= 0.75 * busiest(model.ownership.owner) * (1 + rounding));
}

TEST_CASE("Time spent on contact belongs to the grains that have work on contact", "[.several-ranks]") {
  const Model model = model_of_eight_grains();
  // Each rank works 2 s on its equal grains, and 6 s on contact: three quarters of it on its first grain, the rest on
  // its last one.
  std::vector<double> work(8, 0);
  const std::int32_t first = model.own().front(), last = model.own().back();
  REQUIRE(first != last);
  work[at(first)] = 3, work[at(last)] = 1;
  const Balance balance = measured(model, 2.0, 6.0, work);
  const double own = static_cast<double>(model.own().size());
  for (const std::int32_t g : model.own()) CHECK(within(balance.cost[at(g)], 2 / own + 1.5 * work[at(g)], rounding));
  CHECK(std::ranges::all_of(balance.cost, [](double seconds) { return seconds > 0; })); // of other ranks' grains, too
}

TEST_CASE("Time spent on contact belongs to all grains while none are near others", "[.several-ranks]") {
  const Model model = model_of_eight_grains();
  const Balance balance = measured(model, 2.0, 1.0);
  const double own = static_cast<double>(model.own().size());
  for (const std::int32_t g : model.own()) CHECK(within(balance.cost[at(g)], 3 / own, rounding));
}
