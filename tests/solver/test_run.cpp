// Whole runs through the executable: reproducibility, resuming, what is written, and what is refused.

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "solver/output/run_lock.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

namespace fs = std::filesystem;

Outcome mpfem_command(const std::string& arguments) {
  return run_command(fmt::format("'{}' {}", MPFEM_EXECUTABLE, arguments));
}

const std::string grains_text = R"(packing = "packing.h5"
[material]
density = 1.55e-9
youngs_modulus = 5000
poissons_ratio = 0.3
[material.hardening]
law = "power"
yield_stress = 25
coefficient = 125
exponent = 0.3
)";

const std::string scenario_text = grains_text + R"([output]
history_rows = 20
snapshot_relative_densities = [0.52]
[[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = 0.62
wall_speed = 20000
damping_rate = 1e6
damping_fade_stress = 5
)";

/// The same with bonds, unloaded and torn apart by grips.
const std::string bonded_text = scenario_text + R"(
[[stages]]
name = "unloading"
type = "isotropic_unloading"
mean_stress = 0
wall_speed = 20000
[[stages]]
name = "tearing"
type = "grip"
grip_depth = 0.03
displacement = 0.015
sliding = [0.01, 0, 0]
speed = 20000
[element]
type = "tet4-anp"
[bond]
tensile_strength = 25
shear_strength = 18
fracture_energy = 0.05
rebond = "on_contact"
)";

/// With bonds and every kind of loading: walls held by servos, taken away, and back.
const std::string loading_text = grains_text + R"([bond]
tensile_strength = 25
shear_strength = 18
fracture_energy = 0.05
[output]
history_rows = 10
checkpoint_relative_densities = [0.5, 0.61]
[[stages]]
name = "compaction"
type = "isotropic_compaction"
mean_stress = 20
wall_speed = 20000
damping_rate = 1e6
damping_fade_stress = 5
[[stages]]
name = "cycles"
type = "stress_cycles"
lowest_mean_stress = 5
highest_mean_stress = 20
cycles = 1
wall_speed = 10000
quasi_static = { kinetic_tolerance = 0.02, stress_tolerance = 0.1 }
[[stages]]
name = "triaxial"
type = "triaxial_compression"
wall_speed = 5000
axial_strain = 0.02
[[stages]]
name = "probe"
type = "probe"
direction = [1, -1]
wall_speed = 3000
dissipation_ratio = 1.005
[[stages]]
name = "unconfined"
type = "unconfined_compression"
wall_speed = 10000
axial_strain = 0.03
stress_drop = 0.5
[[stages]]
name = "die"
type = "die_compression"
wall_speed = 10000
duration = 2e-6
[[stages]]
name = "held"
type = "hold"
mean_stress = 15
duration = 1e-6
)";

/// Packing and scenario of eight grains in a folder.
void prepare(const Folder& folder, int cells = 4, const std::string& text = scenario_text) {
  write_packing(folder / "packing.h5", eight_grains(cells), std::vector<double>(8, 0.1));
  write_text(folder / "scenario.toml", text);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Every number of history and snapshots, in order.
std::vector<double> results(const std::string& path) {
  const schema::FileReader file(path, schema::FileKind::run);
  std::vector<double> all;
  const auto take = [&](const auto& dataset, const std::string& snapshot) {
    for (const auto value : file.read(dataset, snapshot)) all.push_back(static_cast<double>(value));
  };
  namespace run = schema::run;
  take(run::history_time, "");
  take(run::history_wall_stress, "");
  take(run::history_kinetic_energy, "");
  take(run::history_elastic_energy, "");
  take(run::history_plastic_dissipation, "");
  take(run::history_contact_energy, "");
  take(run::history_energy_residual, "");
  take(run::history_contact_area, "");
  take(run::history_bonds, "");
  take(run::history_damage_dissipation, "");
  for (const std::string& name : file.snapshots()) {
    take(run::snapshots_node, name);
    take(run::snapshots_velocity, name);
    take(run::snapshots_von_mises, name);
    take(run::snapshots_contact_pressure, name);
    take(run::snapshots_pair_force, name);
    if (!file.has(run::snapshots_bond_damage, name)) continue;
    take(run::snapshots_bond_damage, name);
    take(run::snapshots_bond_separation, name);
    take(run::snapshots_pair_damage_dissipation, name);
  }
  return all;
}

void check_threads(const std::string& text, int cells) {
  const Folder folder;
  prepare(folder, cells, text);
  std::vector<std::vector<double>> all;
  for (const int threads : {1, 2, 4}) {
    const std::string run = folder / fmt::format("run{}.h5", threads);
    const Outcome outcome =
        mpfem_command(fmt::format("run {} -o {} --threads {} --quiet", folder / "scenario.toml", run, threads));
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.messages.empty()); // --quiet
    all.push_back(results(run));
  }
  REQUIRE(all[0].size() > 1000);
  CHECK(all[0] == all[1]);
  CHECK(all[0] == all[2]);
}

/// Runs a command that writes `output`, stopping it and resuming, twice at least. Where the machine has become faster since
/// the whole run took its `seconds`, it begins anew with shorter parts.
void run_in_parts(const std::string& command, const std::string& output, double seconds) {
  int stops = 0;
  for (double limit = seconds / 5; stops < 2; limit /= 2) {
    REQUIRE(limit > seconds / 100);
    fs::remove(output);
    stops = 0;
    for (int code = 5; code == 5; stops += code == 5 ? 1 : 0) {
      const Outcome outcome = mpfem_command(fmt::format("{} --resume --time-limit {}", command, limit));
      code = outcome.exit_code;
      INFO(outcome.messages);
      REQUIRE((code == 0 || code == 5));
      CHECK(schema::validate(output).empty()); // readable at every stop
      REQUIRE(stops < 200);
    }
  }
}

void check_resuming(const std::string& text, int cells) {
  const Folder folder;
  prepare(folder, cells, text);
  const std::string common = fmt::format("run {} --threads 2 --quiet -o ", folder / "scenario.toml");
  const Outcome whole = mpfem_command(common + (folder / "whole.h5"));
  REQUIRE(whole.exit_code == 0);
  run_in_parts(common + (folder / "parts.h5"), folder / "parts.h5", whole.seconds);
  CHECK(results(folder / "whole.h5") == results(folder / "parts.h5"));
  const schema::FileReader in_one(folder / "whole.h5"), in_parts(folder / "parts.h5");
  for (const auto& dataset : {schema::run::provenance_stage_overshoot, schema::run::provenance_stage_hold_error,
                              schema::run::provenance_stage_hold_rms})
    CHECK(in_one.read(dataset) == in_parts.read(dataset));
  CHECK_FALSE(fs::exists(folder / "parts.checkpoint.h5"));
  CHECK(fs::exists(folder / "parts.compaction.checkpoint.h5"));
}

} // namespace

TEST_CASE("a run is bitwise the same on one, two and four threads") {
  check_threads(scenario_text, 4);
}

TEST_CASE("a run with bonds, unloading and grips is bitwise the same on one, two and four threads") {
  check_threads(bonded_text, 3);
  // There were bonds, and some broke.
  const Folder folder;
  prepare(folder, 3, bonded_text);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.read(schema::run::history_bonds).back() > 0);
  CHECK(file.read(schema::run::history_damage_dissipation).back() > 0);
}

/// A scenario that is bitwise the same on any number of threads and when it is resumed, and whose plan says `what` it has.
void check_variant(const std::string& text, const std::string& what) {
  check_threads(text, 4);
  check_resuming(text, 4);
  const Folder folder;
  prepare(folder, 3, text);
  CHECK_THAT(mpfem_command(fmt::format("check {}", folder / "scenario.toml")).output, Catch::Contains(what));
}

std::string with_smooth_surface(const std::string& text) {
  return replaced(text, "[output]", "[contact]\nsurface = \"smooth\"\n[output]");
}

TEST_CASE(
    "a run with smooth contact surfaces is bitwise the same on one, two and four threads, and when it is resumed") {
  check_variant(with_smooth_surface(bonded_text), "smooth surfaces");
}

TEST_CASE("snapshots show the pressure that walls and grains exert, whichever surface the contact takes") {
  // A gap read off nodes instead of contact points would show K times their height, a multiple of all stresses here.
  double largest[2] = {};
  for (const bool smooth : {false, true}) {
    const Folder folder;
    prepare(folder, 4, smooth ? with_smooth_surface(scenario_text) : scenario_text);
    REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
            0);
    const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
    const auto pressure = file.read(schema::run::snapshots_contact_pressure, file.snapshots().back());
    largest[smooth ? 1 : 0] = *std::max_element(pressure.begin(), pressure.end());
  }
  CAPTURE(largest[0], largest[1]);
  CHECK(largest[1] > 0.2 * largest[0]);
  CHECK(largest[1] < 1.5 * largest[0]);
}

TEST_CASE("a run in mixed precision is bitwise the same on one, two and four threads, and when it is resumed") {
  check_variant(replaced(bonded_text, "type = \"tet4-anp\"", "type = \"tet4-anp\"\nprecision = \"mixed\""),
                "tet4-anp, mixed precision");
}

TEST_CASE("a run through every loading is bitwise the same on one, two and four threads") {
  check_threads(loading_text, 3);
}

TEST_CASE("a run through every loading that is stopped and resumed ends bitwise as if it had not been") {
  check_resuming(loading_text, 4);
}

TEST_CASE("spheres that a packing file holds with meshes of their volume touch by their smooth surfaces, and the run "
          "says so") {
  const Folder folder;
  const MeshedPacking packing = eight_grains(4);
  const double volume = build_model(packing, holding_scenario(1), "test").reference_volume[0];
  for (const double factor : {1.0, 0.99}) {
    write_packing(folder / "packing.h5", packing, std::vector<double>(8, factor * std::cbrt(volume * 3 / (4 * M_PI))));
    write_text(folder / "scenario.toml", scenario_text);
    const std::string run = folder / fmt::format("run-{}.h5", factor);
    CHECK_THAT(mpfem_command(fmt::format("check {}", folder / "scenario.toml")).output,
               Catch::Contains(factor == 1 ? "by the grains' smooth surfaces" : "by the facets of the grains' meshes"));
    REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", run)).exit_code == 0);
    const schema::FileReader file(run, schema::FileKind::run);
    CHECK(file.read_scalar(schema::run::provenance_smooth_grains) == (factor == 1 ? 8 : 0));
  }
  // The same scenario text, another contact: not to be gone on with.
  const Outcome other =
      mpfem_command(fmt::format("run {} -o {} --from {} --quiet --set contact.surface=smooth", folder / "scenario.toml",
                                folder / "other.h5", folder / "run-0.99.compaction.checkpoint.h5"));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.messages, Catch::Contains("0 of 8 grains") && Catch::Contains("contact.surface"));
}

TEST_CASE("a run says what ended its stages, and how well stresses were held") {
  const Folder folder;
  prepare(folder, 3, loading_text);
  const Outcome plan = mpfem_command(fmt::format("check {}", folder / "scenario.toml"));
  CHECK(plan.exit_code == 0);
  CHECK_THAT(plan.output, Catch::Contains("held at constant force") && Catch::Contains("x and y walls away") &&
                              Catch::Contains("all walls held at 15 MPa"));
  const Outcome outcome = mpfem_command(fmt::format("run {} -o {}", folder / "scenario.toml", folder / "run.h5"));
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.messages, Catch::Contains("stage 'triaxial' ended by axial strain 0.02; stresses held within"));
  CHECK_THAT(outcome.messages,
             Catch::Contains("stage 'cycles' ended by 1 cycle") && Catch::Contains("wall speed chosen between"));
  CHECK(schema::validate(folder / "run.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const auto name = file.read(schema::run::provenance_stage_name), end = file.read(schema::run::provenance_stage_end);
  REQUIRE(name == std::vector<std::string>{"compaction", "cycles", "triaxial", "probe", "unconfined", "die", "held"});
  CHECK(end[0] == "mean stress 20 MPa");
  CHECK_THAT(end[1], Catch::StartsWith("1 cycle; wall speed chosen between"));
  CHECK(end[5] == "duration 2e-06 s");
  CHECK(end[6] == "duration 1e-06 s");
  CHECK(file.read(schema::run::provenance_stage_hold_error)[6] > 0);
  CHECK(file.read(schema::run::provenance_stage_hold_error)[2] > 0);
  CHECK(file.read(schema::run::provenance_stage_hold_error)[5] == 0);
  const auto rms = file.read(schema::run::provenance_stage_hold_rms);
  CHECK(rms[2] > 0);
  CHECK(rms[3] > 0);
  CHECK(rms[5] == 0);
  CHECK_THAT(outcome.messages, Catch::Contains(fmt::format("{:.3g} MPa in the root mean square", rms[2])));
  CHECK(file.read(schema::run::provenance_stage_overshoot)[0] > 0);
}

TEST_CASE("a compaction leaves checkpoints at densities, from which branches begin") {
  const Folder folder;
  const std::string slow = replaced(scenario_text, "wall_speed = 20000", "wall_speed = 4000");
  prepare(folder, 3, replaced(slow, "[output]", "[output]\ncheckpoint_relative_densities = [0.3, 0.5, 0.61, 0.7]"));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  CHECK_FALSE(fs::exists(folder / "run.D0.300.checkpoint.h5")); // was never passed
  CHECK(fs::exists(folder / "run.D0.500.checkpoint.h5"));
  CHECK_FALSE(fs::exists(folder / "run.D0.700.checkpoint.h5"));
  const std::string from = folder / "run.D0.610.checkpoint.h5";
  CHECK(schema::validate(from).empty());
  // The rest of the way is the same, apart from the walls' start and end, and what that shakes up in eight grains.
  write_text(folder / "rest.toml", slow);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --from {} --quiet", folder / "rest.toml", folder / "rest.h5", from))
              .exit_code == 0);
  const schema::FileReader whole(folder / "run.h5", schema::FileKind::run), rest(folder / "rest.h5");
  const auto density = rest.read(schema::run::history_relative_density);
  CHECK(density.front() == Approx(0.61).epsilon(1e-3)); // the step in which it was passed
  CHECK(rest.read(schema::run::history_mean_stress).back() ==
        Approx(whole.read(schema::run::history_mean_stress).back()).epsilon(0.1));
  CHECK(rest.read(schema::run::history_plastic_dissipation).back() ==
        Approx(whole.read(schema::run::history_plastic_dissipation).back()).epsilon(0.05));
}

TEST_CASE("a branch goes on from the checkpoint that it began at, and not from another") {
  const Folder folder;
  prepare(folder, 3, replaced(scenario_text, "[output]", "[output]\ncheckpoint_relative_densities = [0.5, 0.61]"));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  write_text(folder / "further.toml", replaced(scenario_text, "relative_density = 0.62", "relative_density = 0.64"));
  const auto branch = [&](const std::string& density, const std::string& more) {
    return mpfem_command(fmt::format("run {} -o {} --resume --from {} {}", folder / "further.toml",
                                     folder / "branch.h5", folder / ("run.D" + density + ".checkpoint.h5"), more));
  };
  const auto first_density = [&] {
    return schema::FileReader(folder / "branch.h5").read(schema::run::history_relative_density).front();
  };
  REQUIRE(branch("0.500", "--time-limit 1e-9").exit_code == 5);
  const Outcome other = branch("0.610", "--quiet");
  CHECK(other.exit_code == 2);
  CHECK(other.one_error_line("mpfem"));
  CHECK_THAT(other.messages, Catch::Contains("did not begin at") && Catch::Contains("run.D0.610"));
  const Outcome same = branch("0.500", "");
  REQUIRE(same.exit_code == 0);
  CHECK(first_density() == Approx(0.5).epsilon(1e-2));
  // What a step took counts the branch's own steps, also where a part of it was resumed.
  const schema::FileReader file(folder / "branch.h5");
  const auto step = file.read(schema::run::history_step);
  const auto tets = static_cast<double>(file.rows(schema::run::mesh_tet));
  const double expected = 1e9 * file.read_scalar(schema::run::provenance_wall_time) /
                          (static_cast<double>(step.back() - step.front()) * tets);
  const std::size_t total = same.messages.find("\ntotal ");
  REQUIRE(total != std::string::npos);
  // Printed after the file was written, which in so short a run takes its time; with the parent's steps it would be less.
  CHECK(std::stod(same.messages.substr(same.messages.find('%', total) + 1)) > 0.95 * expected);
  // A complete branch is complete for its own beginning only.
  CHECK_THAT(branch("0.500", "").messages, Catch::Contains("complete already"));
  CHECK(branch("0.610", "--quiet").exit_code == 0);
  CHECK(first_density() == Approx(0.61).epsilon(1e-2));
}

TEST_CASE("a branch may begin with grips that would hold nothing of the packing as it was") {
  const Folder folder;
  prepare(folder, 4, bonded_text);
  const std::string grips = bonded_text.substr(bonded_text.find("[[stages]]\nname = \"tearing\""));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  write_text(folder / "tearing.toml", grains_text + replaced(grips, "grip_depth = 0.03", "grip_depth = 1e-9"));
  const std::string command = fmt::format("run {} -o {} --quiet ", folder / "tearing.toml", folder / "tearing.h5");
  CHECK(mpfem_command(command).exit_code == 3); // in the packing nothing stands at the walls
  const Outcome branch = mpfem_command(command + "--from " + (folder / "run.compaction.checkpoint.h5"));
  INFO(branch.messages);
  CHECK(branch.exit_code == 0);
}

TEST_CASE("one process at a time works on a run, and what a killed one left stops nobody") {
  const Folder folder;
  prepare(folder, 3);
  const std::string command = fmt::format("run {} -o {} --quiet --resume", folder / "scenario.toml", folder / "run.h5");
  {
    const RunLock lock(folder / "run.h5");
    const Outcome second = mpfem_command(command);
    CHECK(second.exit_code == 2);
    CHECK(second.one_error_line("mpfem"));
    CHECK_THAT(second.messages, Catch::Contains("another mpfem is at work") && Catch::Contains("run.lock"));
    CHECK_FALSE(fs::exists(folder / "run.h5"));
    CHECK(mpfem_command(replaced(command, "run.h5", "other.h5")).exit_code == 0);
  }
  CHECK_FALSE(fs::exists(folder / "run.lock"));
  write_text(folder / "run.lock", "");
  CHECK(mpfem_command(command).exit_code == 0);
  CHECK_FALSE(fs::exists(folder / "run.lock"));
}

TEST_CASE("a loading that cannot reach its end exits with 3 and keeps what was computed") {
  const Folder folder;
  prepare(folder, 3, scenario_text + R"(
[[stages]]
type = "probe"
direction = [-1, 0]
wall_speed = 10000
dissipation_ratio = 2
)");
  const Outcome outcome =
      mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.messages, Catch::Contains("probe-2") && Catch::Contains("pull"));
  CHECK(schema::validate(folder / "run.h5").empty());
}

TEST_CASE("a run says what mass scaling does and what damping takes") {
  const Folder folder;
  prepare(folder, 3);
  const Outcome outcome = mpfem_command(
      fmt::format("run {} -o {} --set numerics.mass_scaling=4", folder / "scenario.toml", folder / "run.h5"));
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.messages, Catch::Contains("all masses times 4: steps 2 times as long") &&
                                   Catch::Contains("ended by relative density 0.62; damping ") &&
                                   Catch::Contains("% of the elastic energy"));
}

TEST_CASE("a step too large for the motion to be stable exits with 3, says so, and keeps what was computed") {
  const Folder folder;
  prepare(folder, 4);
  const auto run = [&](double factor) {
    return mpfem_command(fmt::format("run {} -o {} --quiet --set element.type=tet4 --set numerics.time_step_factor={}",
                                     folder / "scenario.toml", folder / "run.h5", factor));
  };
  CHECK(run(1.0).exit_code == 0);
  const Outcome outcome = run(2.0);
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 3);
  CHECK_THAT(outcome.messages, Catch::Contains("energy balance") && Catch::Contains("time_step_factor"));
  CHECK(schema::validate(folder / "run.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.read(schema::run::history_time).size() > 1);
  CHECK(run(2.1).exit_code == 2);
}

namespace {

/// Two cubes pressed together, whose bonds are then torn to a part of their energy.
const std::string torn_cubes_text = "walls = false\n" + grains_text + R"([bond]
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
    energies.push_back(laws.at(4 * static_cast<std::size_t>(law) + 2));
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
             Catch::Contains("34 bonds formed earlier keep their law (25 and 18 MPa, 0.1 N/mm, softening exponential); "
                             "those to come have 20 and 18 MPa, 0.05 N/mm, softening energy"));
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

TEST_CASE("a compaction that goes on with another fracture energy has bonds of both, of a branch's branch of three") {
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

TEST_CASE("a branch's plan begins at its checkpoint, and is refused as its run would be") {
  const Folder folder;
  prepare(folder, 3);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  const std::string from = " --from " + (folder / "run.compaction.checkpoint.h5");
  write_text(folder / "further.toml", replaced(scenario_text, "relative_density = 0.62", "relative_density = 0.64"));
  const Outcome further = mpfem_command(fmt::format("check {}{}", folder / "further.toml", from));
  CHECK(further.exit_code == 0);
  CHECK_THAT(further.output, Catch::Contains("relative density at the start  0.6200"));
  // From 0.62 to 0.64 the way is a fraction of that from the packing.
  const auto steps = [](const std::string& plan) {
    const std::size_t end = plan.find(" steps at the present step");
    return std::stod(plan.substr(plan.rfind(' ', end - 1)));
  };
  const Outcome whole = mpfem_command(fmt::format("check {}", folder / "further.toml"));
  CHECK(steps(further.output) < 0.2 * steps(whole.output));
  const Outcome there = mpfem_command(fmt::format("check {}{}", folder / "scenario.toml", from));
  CHECK(there.exit_code == 2);
  CHECK_THAT(there.messages, Catch::Contains("relative_density"));
  const Outcome steel =
      mpfem_command(fmt::format("check {}{} --set material.density=2e-9", folder / "further.toml", from));
  CHECK(steel.exit_code == 2);
  CHECK_THAT(steel.messages, Catch::Contains("[material]"));
}

TEST_CASE("grains of another material are named by numbers that the packing has, each once") {
  const Folder folder;
  prepare(folder, 2);
  const auto check = [&](const std::string& grains) {
    write_text(folder / "scenario.toml", replaced(scenario_text, "[output]",
                                                  "[[grain_material]]\ngrains = " + grains +
                                                      "\ndensity = 1e-9\nyoungs_modulus = 500\npoissons_ratio = 0.2\n"
                                                      "[grain_material.hardening]\nlaw = 'elastic'\n[output]"));
    return mpfem_command("check " + (folder / "scenario.toml"));
  };
  CHECK(check("[0, 7]").exit_code == 0);
  for (const auto& [grains, expected] :
       std::vector<std::pair<std::string, std::string>>{{"[8]", "found grain 8, allowed 0 … 7"},
                                                        {"[1, 1]", "found 1 twice"},
                                                        {"[]", "no grain"},
                                                        {"[0.5]", "whole"}}) {
    const Outcome outcome = check(grains);
    INFO(grains << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.messages, Catch::Contains(expected) && Catch::Contains("grain_material"));
  }
}

TEST_CASE("keys of loadings are checked like all others") {
  const Folder folder;
  prepare(folder, 2);
  struct Case {
    std::string stage;
    std::vector<std::string> expected;
  };
  const std::vector<Case> cases = {
      {"type = 'isotropic_compaction'\nwall_speed = 1\nmean_stress = 1\nrelative_density = 0.9",
       {"mean_stress", "relative_density"}},
      {"type = 'isotropic_compaction'\nwall_speed = 1", {"relative_density", "missing"}},
      {"type = 'unconfined_compression'\nwall_speed = 1", {"without an end", "axial_strain"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain = 0", {"axial_strain", "found 0"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain = 2", {"axial_strain", "2"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain = 0.1\nhold = 'force'",
       {"hold", "no meaning", "unconfined_compression"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\nstress_drop = 1", {"stress_drop", "< 1"}},
      {"type = 'triaxial_compression'\nwall_speed = 1\naxial_strain = 0.1\nhold = 'strain'", {"hold", "strain"}},
      {"type = 'die_compression'\nwall_speed = 1\nstress_drop = 0.5", {"stress_drop", "no meaning"}},
      {"type = 'die_compression'\nwall_speed = 1e9\naxial_strain = 0.1", {"wall_speed", "allowed at most"}},
      {"type = 'triaxial_compression'\nwall_speed = 1\nservo_speed = 1e9\naxial_strain = 0.1",
       {"servo_speed", "allowed at most"}},
      {"type = 'probe'\nwall_speed = 1\ndissipation_ratio = 1.1\ndirection = [1]", {"direction", "two numbers"}},
      {"type = 'probe'\nwall_speed = 1\ndissipation_ratio = 1.1\ndirection = [0, 0]", {"direction", "not both 0"}},
      {"type = 'probe'\nwall_speed = 1\ndissipation_ratio = 0.9\ndirection = [1, 0]", {"dissipation_ratio", "> 1"}},
      {"type = 'stress_cycles'\nwall_speed = 1\nlowest_mean_stress = 5\nhighest_mean_stress = 5\ncycles = 1",
       {"lowest_mean_stress", "5"}},
      {"type = 'stress_cycles'\nwall_speed = 1\nlowest_mean_stress = 1\nhighest_mean_stress = 5\ncycles = 0",
       {"cycles", "0"}},
      {"type = 'hold'\nduration = 1e-6\nquasi_static = {}", {"quasi_static", "nothing moves"}},
      {"type = 'die_compression'\nwall_speed = 5\naxial_strain = 0.1\nquasi_static = { fastest_speed = 4 }",
       {"quasi_static.fastest_speed", "4", "≥ 5"}},
      {"type = 'die_compression'\nwall_speed = 5\naxial_strain = 0.1\nquasi_static = { kinetic = 0.1 }",
       {"quasi_static.kinetic", "kinetic_tolerance"}},
      {"type = 'die_compression'\nwall_speed = 5\nduration = 1\nquasi_static = {}", {"duration", "no meaning"}},
      {"type = 'die_compression'\nwall_speed = 5\naxial_strain = 0.1\nquasi_static = { fastest_speed = 1e9 }",
       {"quasi_static.fastest_speed", "allowed at most"}},
  };
  for (const Case& c : cases) {
    write_text(folder / "scenario.toml", scenario_text + "[[stages]]\n" + c.stage + "\n");
    const Outcome outcome = mpfem_command("check " + (folder / "scenario.toml"));
    INFO(c.stage << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    for (const std::string& part : c.expected) CHECK_THAT(outcome.messages, Catch::Contains(part));
  }
  write_text(folder / "scenario.toml",
             replaced(scenario_text, "[output]", "[output]\ncheckpoint_relative_densities = [0.5, 0.5001]"));
  const Outcome outcome = mpfem_command("check " + (folder / "scenario.toml"));
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Catch::Contains("checkpoint_relative_densities") && Catch::Contains("0.001"));
}

TEST_CASE("a run that is stopped and resumed again and again ends bitwise as if it had not been") {
  check_resuming(scenario_text, 6);
}

TEST_CASE("a run with bonds, unloading and grips that is stopped and resumed ends bitwise as if it had not been") {
  check_resuming(bonded_text, 4);
  check_resuming(replaced(bonded_text, "rebond = \"on_contact\"", "rebond = \"never\""), 4);
}

TEST_CASE("a killed run goes on from its checkpoint, and ends bitwise as if it had not been killed") {
  const Folder folder;
  prepare(folder, 6);
  const std::string common = fmt::format("run {} --threads 2 --quiet -o ", folder / "scenario.toml");
  const Outcome whole = mpfem_command(common + (folder / "whole.h5"));
  REQUIRE(whole.exit_code == 0);
  write_text(
      folder / "scenario.toml",
      replaced(scenario_text, "[output]\n", fmt::format("[output]\ncheckpoint_interval = {}\n", whole.seconds / 20)));
  int kills = 0;
  for (int code = -1; code != 0;) {
    code = run_command(fmt::format("timeout -s KILL {} '{}' {} --resume", whole.seconds / 3, MPFEM_EXECUTABLE,
                                   common + (folder / "killed.h5")))
               .exit_code;
    REQUIRE((code == 0 || code == 137));
    kills += code != 0;
    REQUIRE(kills < 100);
  }
  CHECK(kills >= 1);
  CHECK(results(folder / "whole.h5") == results(folder / "killed.h5"));
}

TEST_CASE("a run that is asked several times at once to stop, as batch systems do, saves its state and stops") {
  const Folder folder;
  prepare(folder, 6);
  // The first checkpoint, at a density just above the start's, says that the time loop has begun.
  const std::string command =
      fmt::format("'{}' run {} -o {} --threads 1 --quiet --set output.checkpoint_relative_densities=[0.44]",
                  MPFEM_EXECUTABLE, folder / "scenario.toml", folder / "run.h5");
  const Outcome outcome = run_command(fmt::format("{} & pid=$!; while [ ! -e {} ] && kill -0 $pid; do sleep 0.01; "
                                                  "done; for i in 1 2 3 4 5 6 7 8; do kill -TERM $pid "
                                                  "2>/dev/null; sleep 0.002; done; wait $pid",
                                                  command, folder / "run.D0.440.checkpoint.h5"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 5);
  CHECK_THAT(outcome.messages, Catch::Contains("go on with --resume"));
  CHECK(schema::validate(folder / "run.checkpoint.h5").empty());
}

TEST_CASE("files of a run hold to the schema, and the ledger closes") {
  const Folder folder;
  prepare(folder);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  CHECK(schema::validate(folder / "run.h5").empty());
  CHECK(schema::validate(folder / "packing.h5").empty());
  CHECK(schema::validate(folder / "run.compaction.checkpoint.h5").empty());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK(file.snapshots().size() == 2); // at 0.52 and at the end
  CHECK(file.read_scalar(schema::run::provenance_status) == "complete");
  const auto density = file.read(schema::run::history_relative_density);
  CHECK(density.back() == Approx(0.62).epsilon(1e-12)); // the walls end exactly on target
  const auto residual = file.read(schema::run::history_energy_residual);
  const auto work = file.read(schema::run::history_external_work);
  CHECK(std::abs(residual.back()) < 0.01 * work.back());
  CHECK(file.read(schema::run::history_mean_stress).back() > 1); // it was compacted
  double accounted = 0;
  for (const double part : file.read(schema::run::provenance_profile_seconds)) accounted += part;
  CHECK(accounted == Approx(file.read_scalar(schema::run::provenance_wall_time)));
}

TEST_CASE("a stage checkpoint is the start of another run") {
  const Folder folder;
  prepare(folder);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "first.h5")).exit_code ==
          0);
  write_text(folder / "second.toml",
             replaced(replaced(scenario_text, "relative_density = 0.62", "relative_density = 0.64"), "[0.52]", "[]"));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --from {} --quiet", folder / "second.toml", folder / "second.h5",
                                    folder / "first.compaction.checkpoint.h5"))
              .exit_code == 0);
  const schema::FileReader file(folder / "second.h5", schema::FileKind::run);
  const auto density = file.read(schema::run::history_relative_density);
  CHECK(density.front() == Approx(0.62).epsilon(1e-9));
  CHECK(density.back() == Approx(0.64).epsilon(1e-9));
  CHECK(file.read(schema::run::history_mean_stress).front() > 1); // stresses came along
}

TEST_CASE("every bad input is refused with one clear line and exit code 2") {
  const Folder folder;
  prepare(folder, 2);
  const std::string good = folder / "packing.h5";
  MeshedPacking inverted = eight_grains(2);
  std::swap(inverted.tet[4 * 70], inverted.tet[4 * 70 + 1]);
  write_packing(folder / "inverted.h5", inverted, std::vector<double>(8, 0.1));
  MeshedPacking overlapping = eight_grains(2);
  for (std::int32_t n = overlapping.grain_node_offset[3]; n < overlapping.grain_node_offset[4]; ++n)
    overlapping.node[3 * static_cast<std::size_t>(n)] -= 0.05;
  write_packing(folder / "overlapping.h5", overlapping, std::vector<double>(8, 0.1));
  write_text(folder / "nothing.h5", "not an HDF5 file");
  MeshedPacking twice = eight_grains(2); // a tet of the last grain a second time
  twice.tet.insert(twice.tet.end(), twice.tet.end() - 4, twice.tet.end());
  ++twice.grain_tet_offset.back();
  write_packing(folder / "twice.h5", twice, std::vector<double>(8, 0.1));
  MeshedPacking copies = eight_grains(2);
  std::copy_n(copies.node.begin(), 3 * copies.grain_node_offset[1],
              copies.node.begin() + 3 * copies.grain_node_offset[1]);
  write_packing(folder / "copies.h5", copies, std::vector<double>(8, 0.1));
  MeshedPacking flat = eight_grains(2);
  flat.box_lengths[1] = 0;
  write_packing(folder / "flat.h5", flat, std::vector<double>(8, 0.1));

  struct Case {
    std::string from, to;              ///< change of the good scenario
    std::vector<std::string> expected; ///< all of these stand in the message
  };
  const std::vector<Case> cases = {
      {"density = 1.55e-9", "density = = 1", {"scenario.toml:3"}},
      {"exponent = 0.3", "exponent = 0.3\nexponnent = 1", {"scenario.toml:11", "exponnent", "exponent"}},
      {"exponent = 0.3", "exponent = 1.3", {"scenario.toml:10", "exponent", "1.3", "> 0 and ≤ 1"}},
      {"youngs_modulus = 5000", "youngs_modulus = nan", {"youngs_modulus", "nan"}},
      {"youngs_modulus = 5000", "", {"youngs_modulus", "missing"}},
      {"packing.h5", "absent.h5", {"absent.h5", "no such file"}},
      {"packing.h5", "nothing.h5", {"nothing.h5", "not an HDF5 file"}},
      {"packing.h5", "inverted.h5", {"inverted.h5", "row 70", "inverted"}},
      {"packing.h5", "overlapping.h5", {"overlapping.h5", "grains 2 and 3"}},
      {"packing.h5\"",
       "overlapping.h5\"\nbond = {tensile_strength = 25, shear_strength = 18, fracture_energy = 0.5}",
       {"overlapping.h5", "grains 2 and 3"}},
      {"packing.h5", "twice.h5", {"twice.h5", "grain 7"}},
      {"packing.h5", "copies.h5", {"copies.h5", "grains 0 and 1", "same place"}},
      {"packing.h5", "flat.h5", {"flat.h5", "/box/lengths"}},
      {"[output]", "[contact]\nsearch_margin = 1e-6\n[output]", {"search_margin", "0.05"}},
      {"[output]", "[contact]\nsurface = \"round\"\n[output]", {"surface", "round", "facets", "smooth"}},
      {"[output]", "[initial]\ngrain_velocity = [[1, 0, 0]]\n[output]", {"1 rows for 8 grains"}},
      {"damping_fade_stress = 5",
       "damping_fade_stress = 5\n[[stages]]\ntype = \"isotropic_compaction\"\nrelative_density = 0.61\nwall_speed = "
       "1e4",
       {"0.61", "0.6200"}},
      {"wall_speed = 20000", "wall_speed = 1e300", {"wall_speed", "allowed at most"}},
      {"relative_density = 0.62", "relative_density = 1.4", {"relative_density", "1.4"}},
      {"relative_density = 0.62", "relative_density = 0.1", {"relative_density", "0.1", "0.3467"}},
      {"\"isotropic_compaction\"", "\"squeeze\"", {"squeeze", "isotropic_compaction", "hold"}},
      {"wall_speed = 20000", "wall_speed = -1", {"wall_speed", "-1", "> 0"}},
  };
  for (const Case& c : cases) {
    write_text(folder / "scenario.toml", replaced(scenario_text, c.from, c.to));
    for (const std::string command : {"run", "check"}) {
      const Outcome outcome = mpfem_command(command + " " + (folder / "scenario.toml") +
                                            (command == "run" ? " -o " + (folder / "run.h5") : ""));
      INFO(c.to << ": " << outcome.messages);
      CHECK(outcome.exit_code == 2);
      CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), '\n') == 1);
      CHECK(outcome.messages.starts_with("mpfem: error: "));
      for (const std::string& part : c.expected) CHECK_THAT(outcome.messages, Catch::Contains(part));
      CHECK_FALSE(fs::exists(folder / "run.h5"));
      CHECK_FALSE(fs::exists(folder / "run.h5.partial"));
    }
  }

  write_text(folder / "scenario.toml", scenario_text);
  for (const std::string& arguments :
       {fmt::format("run {} -o {}", folder / "absent.toml", folder / "run.h5"),
        fmt::format("run {} -o {}", folder / "scenario.toml", folder / "no-such-folder/run.h5"),
        fmt::format("run {} -o {} --set stages.3.wall_speed=1", folder / "scenario.toml", folder / "run.h5"),
        fmt::format("run {} -o {} --from {}", folder / "scenario.toml", folder / "run.h5", folder / "packing.h5"),
        fmt::format("run {} -o {}", folder / "scenario.toml", folder / "packing.h5"),
        fmt::format("run {} -o {}", folder / "scenario.toml", folder / "scenario.toml"),
        fmt::format("run {} -o ''", folder / "scenario.toml")}) {
    const Outcome outcome = mpfem_command(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), '\n') == 1);
  }
}

TEST_CASE("a packing that was unloaded is compacted again to less than before, from its checkpoint") {
  const Folder folder;
  prepare(folder, 3, bonded_text);
  REQUIRE(mpfem_command(fmt::format("check {}", folder / "scenario.toml")).exit_code == 0); // stages after an unloading
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "first.h5")).exit_code ==
          0);
  const std::string bond = bonded_text.substr(bonded_text.find("[element]"));
  const schema::FileReader first(folder / "first.h5", schema::FileKind::run);
  const auto stage = first.read(schema::run::history_stage);
  const auto density = first.read(schema::run::history_relative_density);
  double unloaded = 0;
  for (std::size_t i = 0; i < stage.size(); ++i)
    if (stage[i] == 1) unloaded = density[i];
  REQUIRE(unloaded < 0.619);
  const double target = 0.5 * (unloaded + 0.62);
  write_text(folder / "again.toml",
             replaced(scenario_text + bond, "relative_density = 0.62", fmt::format("relative_density = {}", target)));
  const std::string from = folder / "first.unloading.checkpoint.h5";
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --from {} --quiet", folder / "again.toml", folder / "again.h5", from))
              .exit_code == 0);
  const schema::FileReader again(folder / "again.h5", schema::FileKind::run);
  CHECK(again.read(schema::run::history_relative_density).back() == Approx(target).epsilon(1e-9));
  // Damaged bonds belong to the stiffness with which they were damaged.
  const Outcome other = mpfem_command(fmt::format("run {} -o {} --from {} --quiet --set contact.stiffness_factor=30",
                                                  folder / "again.toml", folder / "other.h5", from));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.messages, Catch::Contains("penalty"));
  const Outcome smooth = mpfem_command(fmt::format("run {} -o {} --from {} --quiet --set contact.surface=smooth",
                                                   folder / "again.toml", folder / "other.h5", from));
  CHECK(smooth.exit_code == 2);
  CHECK_THAT(smooth.messages, Catch::Contains("contact.surface"));
  const Outcome pushed = mpfem_command(fmt::format("run {} -o {} --from {} --quiet --set initial.velocity=[1,0,0]",
                                                   folder / "again.toml", folder / "other.h5", from));
  CHECK(pushed.exit_code == 2);
  CHECK_THAT(pushed.messages, Catch::Contains("[initial]"));
  // Unloading that has nothing to do ends where it began.
  write_text(folder / "idle.toml", replaced(scenario_text, "type = \"isotropic_compaction\"\nrelative_density = 0.62",
                                            "type = \"isotropic_unloading\"\nmean_stress = 0"));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "idle.toml", folder / "idle.h5")).exit_code == 0);
  const schema::FileReader idle(folder / "idle.h5", schema::FileKind::run);
  CHECK(idle.read(schema::run::history_relative_density).back() ==
        Approx(idle.read(schema::run::history_relative_density).front()).epsilon(1e-12));
}

TEST_CASE("a branch may change how it is computed, but not the matter") {
  const Folder folder;
  prepare(folder);
  const std::string from = " --quiet --from " + (folder / "first.compaction.checkpoint.h5");
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "first.h5")).exit_code ==
          0);
  const std::string further = replaced(scenario_text, "relative_density = 0.62", "relative_density = 0.64");
  write_text(folder / "second.toml",
             replaced(further, "[output]",
                      "[contact]\nsearch_margin = 1\nstiffness_factor = 12\n[numerics]\nmass_scaling = 4\n"
                      "[element]\nprecision = \"mixed\"\n[output]"));
  REQUIRE(mpfem_command(fmt::format("run {} -o {}{}", folder / "second.toml", folder / "second.h5", from)).exit_code ==
          0);
  const schema::FileReader file(folder / "second.h5", schema::FileKind::run);
  const auto residual = file.read(schema::run::history_energy_residual),
             work = file.read(schema::run::history_external_work);
  CHECK(residual.front() == 0);
  CHECK(std::abs(residual.back()) < 0.01 * work.back());

  write_text(folder / "third.toml", replaced(further, "yield_stress = 25", "yield_stress = 30"));
  const Outcome other = mpfem_command(fmt::format("run {} -o {}{}", folder / "third.toml", folder / "third.h5", from));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.messages, Catch::Contains("material"));
  // The checkpoint that a branch starts from is not written over.
  const Outcome same = mpfem_command(fmt::format("run {} -o {}{}", folder / "second.toml", folder / "first.h5", from));
  CHECK(same.exit_code == 2);
  CHECK(fs::exists(folder / "first.compaction.checkpoint.h5"));
}

TEST_CASE("resuming a complete run leaves it as it is, and a fresh run does not mix with an unfinished one") {
  const Folder folder;
  prepare(folder);
  fs::create_directories(folder / "run.parts");
  write_text(folder / "run.parts/mine.txt", "a user's own file");
  const std::string command = fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5");
  REQUIRE(mpfem_command(command).exit_code == 0);
  CHECK(fs::exists(folder / "run.parts/mine.txt"));
  CHECK_FALSE(fs::exists(folder / "run.parts/snapshot-0000.h5"));
  const auto written = fs::last_write_time(folder / "run.h5");
  CHECK(mpfem_command(command + " --resume --time-limit 0.001").exit_code == 0);
  CHECK(fs::last_write_time(folder / "run.h5") == written);
  REQUIRE(mpfem_command(command + " --time-limit 0.001").exit_code == 5);
  CHECK(fs::exists(folder / "run.checkpoint.h5"));
  const Outcome anew =
      run_command(fmt::format("'{}' run {} -o {}", MPFEM_EXECUTABLE, folder / "scenario.toml", folder / "run.h5"));
  CHECK(anew.exit_code == 0);
  CHECK_THAT(anew.messages, Catch::Contains("begins anew"));
}

TEST_CASE("a run may be resumed from another working folder") {
  const Folder folder;
  prepare(folder, 6);
  fs::create_directories(folder / "out");
  const std::string program = fmt::format("'{}'", MPFEM_EXECUTABLE);
  const Outcome first = run_command(fmt::format("cd '{}' && {} run scenario.toml -o out/run.h5 --quiet --set "
                                                "output.snapshot_relative_densities=[0.35] --time-limit 0.2",
                                                folder / "", program));
  REQUIRE(first.exit_code == 5);
  const Outcome second = run_command(fmt::format(
      "cd '{}' && {} run ../scenario.toml -o run.h5 --quiet --set output.snapshot_relative_densities=[0.35] --resume",
      folder / "out", program));
  INFO(second.messages);
  CHECK(second.exit_code == 0);
  CHECK(schema::FileReader(folder / "out/run.h5").snapshots().size() == 2);
}

TEST_CASE("a damaged checkpoint is refused and nothing is lost") {
  const Folder folder;
  prepare(folder, 6);
  const std::string command =
      fmt::format("run {} -o {} --threads 2 --quiet --resume", folder / "scenario.toml", folder / "run.h5");
  REQUIRE(mpfem_command(command + " --time-limit 0.02").exit_code == 5);
  const std::string checkpoint = folder / "run.checkpoint.h5";
  const auto size = static_cast<std::streamoff>(fs::file_size(checkpoint));
  std::fstream file(checkpoint, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(size * 2 / 3);
  file.write("damage, damage, damage", 22);
  file.close();
  const Outcome outcome = mpfem_command(command);
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Catch::Contains("run.checkpoint.h5"));
  CHECK(fs::exists(folder / "run.h5")); // the history up to the stop
}

TEST_CASE("help and version are there for every command") {
  for (const std::string arguments :
       {"--help", "run --help", "check --help", "bench --help", "bond --help", "--version"})
    CHECK(mpfem_command(arguments).exit_code == 0);
  CHECK(mpfem_command("").exit_code == 2);
  CHECK(mpfem_command("fly").exit_code == 2);
}

TEST_CASE("bench prints one object with what a step costs") {
  const auto bench = mpfem_command("bench --tets 3000 --grains 6 --steps 6 --threads 2 --element tet4-anp --json");
  REQUIRE(bench.exit_code == 0);
  for (const std::string key : {"threads", "tets", "element_pass_ns_per_tet_step", "contact_ns_per_tet_step",
                                "search_ns_per_tet_step", "whole_step_ns_per_tet_step", "output_ns_per_tet_step",
                                "integration_GB_per_s", "triad_GB_per_s", "fma_GFlop_per_s"}) {
    CAPTURE(key, bench.output);
    const auto at = bench.output.find("\"" + key + "\": ");
    REQUIRE(at != std::string::npos);
    CHECK(std::stod(bench.output.substr(at + key.size() + 4)) > 0);
  }
  CHECK(bench.output.front() == '{');
  CHECK(mpfem_command("bench --element brick").exit_code == 2);
  CHECK(mpfem_command("bench --from /nowhere").exit_code == 2);
}
