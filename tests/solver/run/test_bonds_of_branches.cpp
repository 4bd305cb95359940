// Bonds keep the law by which they formed, in a branch and in a branch of a branch.

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/small_runs.hpp"

using namespace mpfem;
using namespace mpfem::test;
namespace fs = std::filesystem;

namespace {

/// Two cubes pressed together, whose bonds are then torn to a part of their energy.
const std::string torn_cubes_text = "walls = false\n" + material_text + R"([bond]
tensile_strength = 25
shear_strength = 18
fracture_energy = 0.1
[[stages]]
name = "pressing"
type = "grip"
grip_depth = 0.03
displacement = -6e-4
speed = 500
[[stages]]
name = "tearing"
type = "grip"
grip_depth = 0.03
displacement = 5e-3
speed = 500
)";

/// A branch of it, moved by further displacements.
std::string further_grips(const std::string& displacement, double speed) {
  std::string text = torn_cubes_text.substr(0, torn_cubes_text.find("[[stages]]"));
  std::istringstream each(displacement);
  for (std::string d; each >> d;)
    text += fmt::format(
        "[[stages]]\nname = \"moved-{}\"\ntype = \"grip\"\ngrip_depth = 0.03\ndisplacement = {}\nspeed = {}\n",
        text.size(), d, speed);
  return text;
}

/// Of the law by which each bond of the last snapshot formed, N/mm.
std::vector<double> fracture_energies(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::run);
  const auto laws = file.read(schema::run::snapshots_bond_laws, file.snapshots().back());
  std::vector<double> energies;
  for (const std::int32_t law : file.read(schema::run::snapshots_bond_law, file.snapshots().back()))
    energies.push_back(laws.at(6 * static_cast<std::size_t>(law) + 2));
  return energies;
}

} // namespace

TEST_CASE("bonds keep the law by which they formed, and those that form in a branch have the branch's") {
  const Folder folder;
  write_packing(folder / "packing.h5", two_cubes(4), {0.1, 0.1});
  write_text(folder / "scenario.toml", torn_cubes_text);
  const auto run = [&](const std::string& scenario, const std::string& output, const std::string& options) {
    return mpfem_command(fmt::format("run {} -o {} {}", folder / scenario, folder / output, options));
  };
  REQUIRE(run("scenario.toml", "torn.h5", "--quiet").exit_code == 0);
  const schema::FileReader torn(folder / "torn.h5", schema::FileKind::run);
  const double area = 0.5 * torn.read(schema::run::history_bonded_area).back();
  const double spent = torn.read(schema::run::history_damage_dissipation).back();
  REQUIRE(spent > 0.1 * 0.1 * area); // damaged,
  REQUIRE(spent < 0.9 * 0.1 * area); // and not broken
  CHECK_FALSE(torn.has(schema::run::snapshots_bond_law, torn.snapshots().back()));
  const std::string from = fmt::format("--from {} ", folder / "torn.tearing.checkpoint.h5");

  // Torn apart with another law of bonds to come: nothing else happens than with their own.
  write_text(folder / "apart.toml", further_grips("0.08", 4000));
  const Outcome same = run("apart.toml", "same.h5", from + "--quiet");
  INFO(same.messages);
  REQUIRE(same.exit_code == 0);
  const std::string other_law =
      "--set bond.fracture_energy=0.05 --set bond.tensile_strength=20 --set bond.softening=energy ";
  const Outcome apart = run("apart.toml", "other.h5", from + other_law);
  INFO(apart.messages);
  REQUIRE(apart.exit_code == 0);
  CHECK_THAT(apart.messages,
             Catch::Contains("34 bonds formed earlier keep their law (tensile and shear strength 25 and 18 MPa, "
                             "fracture energy 0.1 N/mm, exponential softening); new bonds have tensile and shear "
                             "strength 20 and 18 MPa, fracture energy 0.05 N/mm, energy softening"));
  CHECK(results(folder / "same.h5") == results(folder / "other.h5"));
  CHECK(schema::FileReader(folder / "other.h5").read(schema::run::history_damage_dissipation).back() ==
        Approx(0.1 * area).epsilon(1e-9));
  for (const double energy : fracture_energies(folder / "other.h5")) CHECK(energy == 0.1);

  // Pressed together and torn apart again, in one go and with stops: the new bonds take the new energy.
  write_text(folder / "again.toml", further_grips("0.08 -0.09 0.06", 4000));
  const std::string again = from + "--set bond.fracture_energy=0.06 --set bond.rebond=on_contact --quiet ";
  const Outcome whole = run("again.toml", "again.h5", again);
  REQUIRE(whole.exit_code == 0);
  CHECK(schema::FileReader(folder / "again.h5").read(schema::run::history_damage_dissipation).back() ==
        Approx((0.1 + 0.06) * area).epsilon(1e-9));
  for (const double energy : fracture_energies(folder / "again.h5")) CHECK(energy == 0.06);
  run_in_parts(fmt::format("run {} -o {} {}", folder / "again.toml", folder / "parts.h5", again), folder / "parts.h5",
               whole.seconds);
  CHECK(results(folder / "again.h5") == results(folder / "parts.h5"));

  const Outcome sliding = run("apart.toml", "refused.h5", from + "--set bond.normal_only=true --quiet");
  CHECK(sliding.exit_code == 2);
  CHECK_THAT(sliding.messages, Catch::Contains("normal_only"));
  const std::string text = further_grips("0.08", 4000);
  write_text(folder / "unbonded.toml", text.substr(0, text.find("[bond]")) + text.substr(text.find("[[stages]]")));
  const Outcome unbonded = run("unbonded.toml", "refused.h5", from + "--quiet");
  CHECK(unbonded.exit_code == 2);
  CHECK_THAT(unbonded.messages, Catch::Contains("the scenario has none"));
}

TEST_CASE("a compaction continued with another fracture energy has bonds of both, and a branch of one has three") {
  const Folder folder;
  prepare(folder, 3, replaced(loading_text, "[0.5, 0.61]", "[0.405, 0.55, 0.59]"));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const auto branch = [&](const std::string& name, const std::string& from, const std::string& set) {
    return mpfem_command(fmt::format("run {} -o {} --quiet --from {} {}", folder / "scenario.toml",
                                     folder / (name + ".h5"), folder / from, set));
  };
  const auto kinds = [&](const std::string& name) {
    const auto energies = fracture_energies(folder / (name + ".h5"));
    return std::set<double>(energies.begin(), energies.end());
  };
  const Outcome two = branch("two", "run.D0.550.checkpoint.h5", "--set bond.fracture_energy=0.1");
  REQUIRE(two.exit_code == 0);
  CHECK(kinds("two") == std::set<double>{0.05, 0.1});
  run_in_parts(fmt::format("run {} -o {} --quiet --from {} --set bond.fracture_energy=0.1", folder / "scenario.toml",
                           folder / "parts.h5", folder / "run.D0.550.checkpoint.h5"),
               folder / "parts.h5", two.seconds);
  CHECK(results(folder / "two.h5") == results(folder / "parts.h5"));
  CHECK(fracture_energies(folder / "two.h5") == fracture_energies(folder / "parts.h5"));
  REQUIRE(branch("three", "two.D0.590.checkpoint.h5", "--set bond.fracture_energy=0.2").exit_code == 0);
  CHECK(kinds("three") == std::set<double>{0.05, 0.1, 0.2});
  const Outcome steel = branch("steel", "run.D0.550.checkpoint.h5", "--set material.youngs_modulus=4000");
  CHECK(steel.exit_code == 2);
  CHECK_THAT(steel.messages, Catch::Contains("[material]"));

  // Where no bond has formed yet nothing of an earlier law is left, and the penalty is free.
  const auto plan = [&](const std::string& checkpoint) {
    return mpfem_command(
        fmt::format("check {} --from {} --set bond.fracture_energy=0.2 --set contact.stiffness_factor=12",
                    folder / "scenario.toml", folder / checkpoint));
  };
  const Outcome loose = plan("run.D0.405.checkpoint.h5");
  CHECK(loose.exit_code == 0);
  CHECK_THAT(loose.output, !Catch::Contains("formed earlier"));
  CHECK(plan("run.D0.550.checkpoint.h5").exit_code == 2);
}
