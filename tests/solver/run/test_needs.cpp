// What a run needs, and that one which cannot fit is refused before it begins.

#include <limits>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/model/model.hpp"
#include "solver/parallel/communicator.hpp"
#include "solver/run/needs.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

Scenario one_stage() {
  Scenario scenario;
  scenario.material.density = 1.55e-9;
  scenario.material.youngs_modulus = 5000;
  scenario.material.poissons_ratio = 0.3;
  scenario.material.hardening = {HardeningLaw::power, 25, 125, 0.3, {}, {}};
  scenario.stages.emplace_back();
  return scenario;
}

/// Grains of 590 tets each, as meshed balls of the coarse packing have.
PackingCounts coarse_grains(int grains) {
  PackingCounts counts;
  counts.nodes = 164 * grains;
  counts.tets.assign(static_cast<std::size_t>(grains), 590);
  return counts;
}

double memory(const Scenario& scenario) {
  return needs_of(coarse_grains(20000), scenario).memory;
}

/// What mpfem used; its messages are dropped. Not called under sanitizers.
[[maybe_unused]] rusage usage_of_mpfem(const std::vector<std::string>& arguments) {
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char*> words{const_cast<char*>(MPFEM_EXECUTABLE)};
    for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    execv(MPFEM_EXECUTABLE, words.data());
    _exit(127);
  }
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  CHECK(WIFEXITED(status));
  CHECK((WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == 5)); // done, or out of time
  return usage;
}

/// The number in front of a word of a text.
double number_before(const std::string& text, const std::string& word) {
  const auto end = text.find(word);
  REQUIRE(end != std::string::npos);
  const auto begin = text.find_last_of(" \n", end - 1);
  return std::stod(text.substr(begin == std::string::npos ? 0 : begin + 1));
}

const std::string undamped_text = material_text + R"([[stages]]
name = "compaction"
type = "isotropic_compaction"
relative_density = 0.62
wall_speed = 20000
)";

} // namespace

TEST_CASE("counts of a packing file are those of its mesh") {
  const Folder folder;
  const MeshedPacking packing = eight_grains(4);
  write_packing(folder / "packing.h5", packing, std::vector<double>(8, 0.1));
  const PackingCounts counts = read_packing_counts(folder / "packing.h5");
  CHECK(counts.nodes == static_cast<std::int64_t>(packing.node.size() / 3));
  CHECK(counts.all_tets() == static_cast<std::int64_t>(packing.tet.size() / 4));
  CHECK(counts.tets.size() == 8);
}

TEST_CASE("a run needs more memory than the arrays of its model, and little more where contact is small") {
  const Folder folder;
  const MeshedPacking packing = eight_grains(16);
  write_packing(folder / "packing.h5", packing, std::vector<double>(8, 0.1));
  Scenario scenario = one_stage();
  const PackingCounts counts = read_packing_counts(folder / "packing.h5");
  PackingCounts nothing;
  for (const Precision precision : {Precision::full, Precision::mixed})
    for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp}) {
      scenario.numerics.precision = precision;
      scenario.numerics.element = element;
      const auto of_model = static_cast<double>(build_model(packing, scenario, "packing").memory());
      const double of_run = needs_of(counts, scenario).memory - needs_of(nothing, scenario).memory;
      CHECK(of_run > of_model);
      CHECK(of_run < 1.6 * of_model);
    }
}

TEST_CASE("bonds and averaged pressure need memory, mixed precision saves some") {
  const Scenario plain = one_stage();
  Scenario other = plain;
  other.bond.emplace();
  CHECK(memory(other) > 1.03 * memory(plain));
  other = plain;
  other.numerics.element = ElementType::tet4_anp;
  CHECK(memory(other) > 1.01 * memory(plain));
  other = plain;
  other.numerics.precision = Precision::mixed;
  CHECK(memory(other) < 0.9 * memory(plain));
}

TEST_CASE("each checkpoint needs disk space for the history so far") {
  Scenario scenario = one_stage();
  const double before = needs_of(coarse_grains(10), scenario).disk;
  constexpr int more = 10000;
  scenario.output.history_rows += more;
  // The run file, the checkpoint of the stage, the rolling one, and the one that is being written.
  CHECK(within(needs_of(coarse_grains(10), scenario).disk - before, 4 * more * bytes_of_row(scenario), rounding));
}

TEST_CASE("every snapshot and checkpoint that stays needs disk space") {
  const PackingCounts packing = coarse_grains(1000);
  Scenario scenario = one_stage();
  const double before = needs_of(packing, scenario).disk;
  scenario.output.checkpoint_relative_densities = {0.8, 0.9};
  const double checkpoints = needs_of(packing, scenario).disk - before;
  CHECK(checkpoints > 2 * 64 * 590e3); // eight numbers of every tet
  scenario.output.snapshot_relative_densities = {0.8, 0.9};
  CHECK(needs_of(packing, scenario).disk - before > 1.1 * checkpoints);
}

TEST_CASE("a run that cannot fit is refused in one line that says what it needs and what there is") {
  CHECK(check_needs("run.h5", {1e9, 1e9}, {no_limit, no_limit}).empty());
  CHECK(check_needs("run.h5", {1e9, 1e9}, {1.2e9, 1.2e9}).empty());
  CHECK_THAT(check_needs("run.h5", {1e9, 1e9}, {1.05e9, 2e9}),
             Catch::Contains("about 1 GB of memory") && Catch::Contains("1.05 GB are available"));
  CHECK_THAT(check_needs("run.h5", {1e9, 1e9}, {0.95e9, 0.95e9}),
             Catch::Contains("of memory") && Catch::Contains("of disk space"));
  CHECK_THROWS_AS(check_needs("run.h5", {1e9, 1e9}, {0.5e9, 2e9}), InputError);
  CHECK_THROWS_WITH(check_needs("run.h5", {1e9, 1e9}, {0.5e9, 2e9}),
                    Catch::StartsWith("run.h5: the run needs about 1 GB of memory, 500 MB are available"));
  CHECK_THROWS_WITH(check_needs("run.h5", {1e9, 1e9}, {2e9, 0.5e9}), Catch::Contains("of disk space"));
}

// Measured in docs/performance.md; what is promised of the forecast is 15 %.
TEST_CASE("ranks need more than their share of memory, because pages hold grains of several") {
  PackingCounts powder;
  powder.nodes = 5300000;
  powder.tets.assign(100000, 134); // 13.4 million tetrahedra
  Scenario scenario = compaction_scenario(0.9, 4000);
  scenario.numerics.element = ElementType::tet4_anp;
  const auto gigabytes = [&](int ranks) { return 1e-9 * needs_of(powder, scenario, ranks).memory; };
  CHECK(gigabytes(1) == Approx(3.0).epsilon(0.15));
  CHECK(gigabytes(2) == Approx(2.0).epsilon(0.15));
  CHECK(gigabytes(4) == Approx(1.4).epsilon(0.15));
  CHECK(4 * gigabytes(4) > 1.5 * gigabytes(1));
  CHECK(gigabytes(100000) > 0.0197); // the program
  CHECK(gigabytes(100000) < 0.05);
}

TEST_CASE("a build without MPI says so when a launcher starts several of it, and once") {
  if (Communicator::has_mpi()) return;
  const auto warnings = [](int rank) {
    const std::string started =
        fmt::format("OMPI_COMM_WORLD_SIZE=2 OMPI_COMM_WORLD_RANK={} '{}' check missing.toml", rank, MPFEM_EXECUTABLE);
    return run_command(started).messages;
  };
  CHECK_THAT(warnings(0), Catch::Contains("2 processes") && Catch::Contains("no MPI"));
  CHECK_THAT(warnings(1), !Catch::Contains("no MPI"));
}

TEST_CASE("a compaction takes the number of steps that check predicts") {
  const Folder folder;
  write_packing(folder / "packing.h5", eight_grains(4), std::vector<double>(8, 0.1));
  write_text(folder / "scenario.toml", undamped_text);
  const Outcome check = run_command(fmt::format("'{}' check {}", MPFEM_EXECUTABLE, folder / "scenario.toml"));
  REQUIRE(check.exit_code == 0);
  const Outcome run =
      run_command(fmt::format("'{}' run {} -o {}", MPFEM_EXECUTABLE, folder / "scenario.toml", folder / "run.h5"));
  REQUIRE(run.exit_code == 0);
  const double predicted = number_before(check.output, " steps: "),
               taken = number_before(run.messages, " steps, relative density");
  CHECK(predicted == Approx(taken).epsilon(0.05));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which need more memory
TEST_CASE("the memory of a run is predicted within 15 %") {
  const Folder folder;
  const MeshedPacking packing = eight_grains(16);
  write_packing(folder / "packing.h5", packing, std::vector<double>(8, 0.1));
  write_text(folder / "scenario.toml", undamped_text);
  const rusage usage = usage_of_mpfem({"run", folder / "scenario.toml", "-o", folder / "run.h5", "--quiet", "--set",
                                       "output.history_rows=20", "--time-limit", "2"});
  const Scenario scenario = one_stage();
  const double predicted = needs_of(read_packing_counts(folder / "packing.h5"), scenario).memory;
  CHECK(1024.0 * static_cast<double>(usage.ru_maxrss) == Approx(predicted).epsilon(0.15));
}
#endif

TEST_CASE("the folder of a run file has space") {
  const Folder folder;
  CHECK(available_disk_space(folder / "run.h5") > 0);
  CHECK(available_disk_space(folder / "run.h5") < 1e18);
}
