// Bonds before and after a test, and damage by energy.

#include <catch2/catch.hpp>

#include "bonded_run.hpp"
#include "postproc/metrics/bond_energy.hpp"
#include "postproc/metrics/damage_of_test.hpp"
#include "postproc/metrics/damage_statistics.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

BondRow bond(std::int32_t node, std::int32_t grain, double area, double damage) {
  return {node, grain, 0, area, damage, {}, {}};
}

const std::string with_bonds = "[bond]\nfracture_energy = 0.5\n";

} // namespace

TEST_CASE("a test has three kinds of bonds: found by it, formed in it, and broken before it") {
  const std::vector<BondRow> before = {bond(1, 0, 1, 0.2), bond(2, 0, 1, 1), bond(3, 0, 1, 1), bond(1, 4, 1, 0.5)};
  const std::vector<BondRow> now = {bond(1, 0, 1, 0.6), bond(2, 0, 1, 1), bond(3, 0, 1, 0.1), bond(1, 4, 1, 1),
                                    bond(9, 0, 1, 0.3)};
  const BondsSince since = bonds_since(before, now);
  REQUIRE(since.found.size() == 2);
  CHECK(since.found[0].damage == 0.6);
  CHECK(since.found[1].damage == 1);
  REQUIRE(since.found_before.size() == 2);
  CHECK(since.found_before[0].damage == 0.2);
  CHECK(since.found_before[1].damage == 0.5);
  REQUIRE(since.formed.size() == 2); // node 3 again, node 9 for the first time
  CHECK(since.formed[0].node == 3);
  CHECK(since.formed[1].node == 9);
  REQUIRE(since.broken_already.size() == 1);
  CHECK(since.broken_already[0].node == 2);
}

TEST_CASE("damage by energy is what bonds dissipated over half of G^c times their area, and is not mean damage") {
  std::vector<BondRow> bonds = {bond(1, 0, 2, 0.99), bond(2, 0, 4, 1)};
  CHECK_FALSE(bond_energy(bonds)); // neither G^c nor energy is known
  for (BondRow& row : bonds) row.fracture_energy = 0.5;
  CHECK_FALSE(bond_energy(bonds));
  bonds[0].dissipation = 0.1; // of 0.5
  bonds[1].dissipation = 1.0; // broken: all of it
  const auto energy = bond_energy(bonds);
  REQUIRE(energy);
  CHECK(energy->energy_to_break == 1.5);
  CHECK(energy->share() == Approx(1.1 / 1.5).epsilon(1e-14));
}

TEST_CASE("the damage of a test is the growth of damage in the bonds that it found") {
  const Folder folder;
  RunContents before = bonded_run(), now = bonded_run();
  before.texts["/provenance/scenario"] = now.texts["/provenance/scenario"] = {with_bonds};
  auto& damage = now.numbers["/snapshots/*/bond_damage"];
  const auto& area = now.numbers["/snapshots/*/bond_area"];
  const auto& was = before.numbers["/snapshots/*/bond_damage"];
  double grown = 0, whole = 0, energy = 0;
  for (std::size_t b = 0; b < damage.size(); ++b) {
    if (was[b] < 1) { // half way to being broken
      damage[b] = 0.5 * (1 + was[b]);
      grown += area[b] * (damage[b] - was[b]);
      whole += area[b];
    }
    now.numbers["/snapshots/*/bond_dissipation"].push_back(0.1 * area[b]); // of 0.25
    energy += 0.1 * area[b];
  }
  REQUIRE(whole < 8); // some were broken before
  write_run(folder / "before.h5", before);
  write_run(folder / "now.h5", now);
  const schema::FileReader first(folder / "before.h5"), second(folder / "now.h5");
  const Measurement m = measure_damage_of_test(second, -1, first, -1);
  constexpr double single = 1e-6; // damage is stored in single precision
  CHECK(m.value == Approx(grown / whole).epsilon(single));
  CHECK(m.details["found_mean_damage"].get<double>() - m.details["found_mean_damage_before"].get<double>() ==
        Approx(m.value).epsilon(single));
  CHECK(m.details["found_energy_spent_share"].get<double>() == Approx(0.4).epsilon(1e-12));
  CHECK(m.details["formed_bonds"] == 0);
  CHECK(m.details["formed_mean_damage"].is_null());
  CHECK(m.details["broken_already_bonds"].get<int>() > 0);
  const Measurement all = measure_damage(second, -1);
  CHECK(all.details["energy_spent_share"].get<double>() == Approx(0.4).epsilon(1e-12));
  CHECK(all.details["damage_dissipation_mJ"].get<double>() == Approx(energy).epsilon(1e-12));
  CHECK(measure_damage(first, -1).details["energy_spent_share"].is_null());

  RunContents later = before;
  later.numbers["/snapshots/*/time"] = {1};
  write_run(folder / "later.h5", later);
  CHECK_THROWS_WITH(measure_damage_of_test(second, -1, schema::FileReader(folder / "later.h5"), -1),
                    Catch::Contains("later.h5: found the snapshot before later than that of "));
  now.texts["/provenance/packing_hash"] = {"another"};
  write_run(folder / "other.h5", now);
  CHECK_THROWS_WITH(measure_damage_of_test(schema::FileReader(folder / "other.h5"), -1, first, -1),
                    Catch::Contains("its packing is not that of"));
}

TEST_CASE("a bond's fracture energy is that of the law by which it formed") {
  const Folder folder;
  RunContents contents = bonded_run();
  const std::size_t bonds = contents.extents.at("*bonds");
  contents.texts["/provenance/scenario"] = {with_bonds};
  contents.extents["*laws"] = 2;
  contents.numbers["/snapshots/*/bond_laws"] = {25, 18, 0.1, 0, 0, 1, /**/ 25, 18, 0.5, 0, 0, 1};
  for (std::size_t b = 0; b < bonds; ++b) contents.numbers["/snapshots/*/bond_law"].push_back(b == 0 ? 0 : 1);
  write_run(folder / "run.h5", contents);
  const auto rows = read_bond_table(schema::FileReader(folder / "run.h5"), -1);
  CHECK(rows[0].fracture_energy == 0.1);
  CHECK(rows[1].fracture_energy == 0.5);
}
