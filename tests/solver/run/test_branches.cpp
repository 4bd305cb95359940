// Branches: runs that begin at the checkpoint of another.

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
  // The rest of the way is the same, apart from the walls' start and end, and the vibration that follows in eight
  // grains. In ten cases near this one (speeds of 3600 to 4400 mm/s, three or four cells), the stress at the end was
  // 0.93 to 1.10 of that of the whole run, with a standard deviation of 0.055; the dissipation 0.95 to 0.98, 0.009. The
  // bounds are three standard deviations from the means, 1.00 and 0.97.
  write_text(folder / "rest.toml", slow);
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --from {} --quiet", folder / "rest.toml", folder / "rest.h5", from))
              .exit_code == 0);
  const schema::FileReader whole(folder / "run.h5", schema::FileKind::run), rest(folder / "rest.h5");
  const auto density = rest.read(schema::run::history_relative_density);
  CHECK(density.front() == Approx(0.61).epsilon(1e-3)); // the step in which it was passed
  CHECK(rest.read(schema::run::history_mean_stress).back() ==
        Approx(whole.read(schema::run::history_mean_stress).back()).epsilon(0.17));
  CHECK(rest.read(schema::run::history_plastic_dissipation).back() ==
        Approx(whole.read(schema::run::history_plastic_dissipation).back()).epsilon(0.06));
}

TEST_CASE("a branch continues from the checkpoint at which it began, and not from another") {
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
  CHECK(first_density() == Approx(0.5).epsilon(1e-3));
  // What a step took counts the branch's own steps, also where a part of it was resumed.
  const schema::FileReader file(folder / "branch.h5");
  const auto step = file.read(schema::run::history_step);
  const auto tets = static_cast<double>(file.rows(schema::run::mesh_tet));
  const double expected = 1e9 * file.read_scalar(schema::run::provenance_wall_time) /
                          (static_cast<double>(step.back() - step.front()) * tets);
  const std::size_t total = same.messages.find("\ntotal ");
  REQUIRE(total != std::string::npos);
  // Printed after the file was written, which in so short a run takes its time; with the parent's steps it would be
  // less.
  CHECK(std::stod(same.messages.substr(same.messages.find('%', total) + 1)) > 0.95 * expected);
  // A complete branch is complete for its own beginning only.
  CHECK_THAT(branch("0.500", "").messages, Catch::Contains("already complete"));
  const Outcome later = branch("0.610", "--quiet");
  CHECK(later.exit_code == 2);
  CHECK_THAT(later.messages, Catch::Contains("did not begin at"));
  CHECK(first_density() == Approx(0.5).epsilon(1e-3));
}

TEST_CASE("a branch may begin with grips that would hold no node of the initial packing") {
  const Folder folder;
  prepare(folder, 4, bonded_text);
  const std::string grips = bonded_text.substr(bonded_text.find("[[stages]]\nname = \"tearing\""));
  REQUIRE(mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5")).exit_code ==
          0);
  write_text(folder / "tearing.toml", material_text + replaced(grips, "grip_depth = 0.03", "grip_depth = 1e-9"));
  const std::string command = fmt::format("run {} -o {} --quiet ", folder / "tearing.toml", folder / "tearing.h5");
  CHECK(mpfem_command(command).exit_code == 2); // in the packing nothing stands at the walls
  const Outcome branch = mpfem_command(command + "--from " + (folder / "run.compaction.checkpoint.h5"));
  INFO(branch.messages);
  CHECK(branch.exit_code == 0);
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
  CHECK_THAT(further.output, Catch::Contains("density        0.6200"));
  // From 0.62 to 0.64 the way is a fraction of that from the packing.
  const auto steps = [](const std::string& plan) {
    const std::size_t end = plan.find(" steps;");
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

TEST_CASE("a branch may change numerical settings, but not the material") {
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
