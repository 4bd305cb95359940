// Numbers from run files with known results, and what the command refuses.

#include <algorithm>

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "postproc/metrics/energy.hpp"
#include "postproc/metrics/summary.hpp"
#include "postproc/run_data/contact.hpp"
#include "run_postproc.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

TEST_CASE("a branch's cost a step is that of its own steps") {
  const Folder folder;
  RunContents branch = small_run();
  branch.numbers["/history/step"] = {1000, 1010, 1020};
  write_run(folder / "run.h5", branch);
  const Summary s = summarise(schema::FileReader(folder / "run.h5", schema::FileKind::run));
  CHECK(s.steps == 1020);
  CHECK(within(s.nanoseconds_per_tet_step, 0.96e9 / (20 * 48), rounding));
}

TEST_CASE("the steps of a run that failed are those to its failed state, of which it has no row") {
  const Folder folder;
  RunContents failed = small_run();
  failed.numbers["/snapshots/*/step"] = {32};
  write_run(folder / "run.h5", failed);
  const Summary s = summarise(schema::FileReader(folder / "run.h5", schema::FileKind::run));
  CHECK(s.steps == 32);
  CHECK(within(s.nanoseconds_per_tet_step, 0.96e9 / (32 * 48), rounding));
}

TEST_CASE("what runs took together adds up their steps, and their time times threads") {
  Summary one, two;
  one.wall_time = 10;
  one.threads = 2;
  one.nanoseconds_per_tet_step = 20;
  two.wall_time = 1;
  two.threads = 1; // without a cost: it took no step
  CHECK(cost_of_runs({one, two}) == "2,5e+08,11.0,21.0\n");
  CHECK(cost_of_runs({}) == "0,0,0.0,0.0\n");
  CHECK_THAT(to_csv(one), Catch::StartsWith("name,value\n") && Catch::Contains("\nthreads,2\n"));
}

TEST_CASE("a summary holds the numbers of the run") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const Summary s = summarise(schema::FileReader(folder / "run.h5", schema::FileKind::run));
  CHECK(s.status == "complete");
  CHECK(s.tets == 48);
  CHECK(s.grains == 2);
  CHECK(s.steps == 20);
  CHECK(within(s.nanoseconds_per_tet_step, 0.96e9 / (20 * 48), rounding));
  CHECK(s.relative_density == 0.8);
  CHECK(within(s.largest_residual, 0.06 / 4, rounding));  // over the largest work
  CHECK(within(s.kinetic_over_internal, 0.02, rounding)); // the row at 5 MPa; the one at rest is not under load
  CHECK(s.loaded_from_density == 0.7);
  CHECK(within(s.kinetic_over_largest_internal, 0.5 / 4, rounding)); // the first row's over the last's
  CHECK(s.kinetic_small_from_density == 0.8);                        // 2 % at 0.7, 0.5 % at 0.8
  const auto energy = [&](const std::string& name) {
    const auto found =
        std::find_if(s.energies.begin(), s.energies.end(), [&](const auto& term) { return term.first == name; });
    return found == s.energies.end() ? -1.0 : found->second;
  };
  CHECK(s.energies.size() == 10);
  CHECK(energy("plastic_dissipation") == 3);
  CHECK(energy("external_work") == 4);
  CHECK(energy("energy_residual") == 0.02);
  CHECK(s.largest_penetration == 0.03);
  CHECK(s.smallest_time_step == 5e-8);
  CHECK(s.largest_time_step == 1e-7);
  CHECK(within(s.contact_area_ratio, 0.4, rounding));
  REQUIRE(s.profile_share.size() == 2);
  CHECK(within(s.profile_share[0], 0.75, rounding));

  REQUIRE(postproc(fmt::format("summary {} -o {}", folder / "run.h5", folder / "s.json")).exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(folder / "s.json"));
  CHECK(json["tets"] == 48);
  CHECK(within(json["wall_time_share"]["element forces"].get<double>(), 0.75, rounding));
  CHECK(json["energies_mJ"]["plastic_dissipation"] == 3);
}

TEST_CASE("a run that ends in motion has no density from which it is quasi-static") {
  const Folder folder;
  RunContents contents = small_run();
  contents.numbers["/history/kinetic_energy"] = {0, 0, 1};
  write_run(folder / "run.h5", contents);
  const Summary s = summarise(schema::FileReader(folder / "run.h5", schema::FileKind::run));
  CHECK_FALSE(s.kinetic_small_from_density.has_value());
  CHECK(to_json(s)["relative_density_from_which_kinetic_below_1_percent"].is_null());
  CHECK_THAT(to_text(s), Catch::Contains("it is larger at the end of the run"));
}

TEST_CASE("a curve has the requested columns, with units, and its numbers read back exactly") {
  const Folder folder;
  RunContents contents = small_run();
  contents.numbers["/history/mean_stress"] = {0.1, 1.0 / 3.0, 1e-300};
  write_run(folder / "run.h5", contents);
  const Outcome outcome =
      postproc(fmt::format("curve {} --columns relative_density,mean_stress,wall_stress", folder / "run.h5"));
  REQUIRE(outcome.exit_code == 0);
  std::istringstream lines(outcome.output);
  std::string line;
  std::getline(lines, line);
  CHECK(line == "relative_density [1],mean_stress [MPa],wall_stress_0 [MPa],wall_stress_1 [MPa],wall_stress_2 "
                "[MPa],wall_stress_3 [MPa],"
                "wall_stress_4 [MPa],wall_stress_5 [MPa]");
  std::getline(lines, line);
  std::getline(lines, line);
  CHECK(line.starts_with("0.7,"));
  CHECK(std::stod(line.substr(4)) == 1.0 / 3.0);
  CHECK(line.ends_with(",1,2,3,4,5,6"));
  // All columns: every dataset of /history that a file must have, and no other where it has no more.
  const HistoryTable history(schema::FileReader(folder / "run.h5"));
  std::size_t expected = 0;
  for (const auto& dataset : schema::run::all)
    if (dataset.path.starts_with("/history/") && dataset.required)
      expected += dataset.rank == 1 ? 1 : dataset.extent[1].fixed;
  CHECK(history.columns().size() == expected);
}

TEST_CASE("the ledger has every term, and the ratios of the rows") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const schema::FileReader file(folder / "run.h5");
  const auto ledger = energy_ledger(HistoryTable(file));
  const Column &residual = ledger[ledger.size() - 2], &kinetic = ledger.back();
  CHECK(residual.name == "residual_over_work");
  CHECK(residual.values[0] == 0);
  CHECK(within(residual.values[1], -0.03, rounding));
  CHECK(within(kinetic.values[2], 0.005, rounding));
}

TEST_CASE("the ledger of a run with friction has what it stores and dissipates, and internal energy counts both") {
  const Folder folder;
  RunContents contents = small_run();
  contents.numbers["/history/friction_energy"] = {0, 0.2, 0.5};
  contents.numbers["/history/friction_dissipation"] = {0, 0.3, 1};
  write_run(folder / "run.h5", contents);
  const schema::FileReader file(folder / "run.h5");
  const auto ledger = energy_ledger(HistoryTable(file));
  const auto of = [&](const std::string& name) {
    const auto found = std::find_if(ledger.begin(), ledger.end(), [&](const Column& c) { return c.name == name; });
    REQUIRE(found != ledger.end());
    return found->values[2];
  };
  CHECK(of("friction_energy") == 0.5);
  CHECK(of("friction_dissipation") == 1);
  CHECK(of("kinetic_over_internal") == Approx(0.02 / (1 + 3 + 0.5 + 1)).epsilon(1e-12));
}

TEST_CASE("a contact table has force, area and pressure of every pair") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const ContactTable table = contact_table(schema::FileReader(folder / "run.h5"), -1);
  REQUIRE(table.columns[5].values.size() == 1);
  CHECK(within(table.columns[5].values[0], 5, rounding));  // |(3, 0, 4)|
  CHECK(within(table.columns[7].values[0], 10, rounding)); // over 0.5 mm^2
  CHECK(table.coordination_number == 1);
  CHECK(within(table.contact_area_ratio, 0.4, rounding));
}

TEST_CASE("postproc refuses what it cannot use with one line and exit code 2") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  write_text(folder / "text.h5", "no HDF5");
  const std::string run = folder / "run.h5";
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {"summary " + (folder / "absent.h5"), "no such file"},
           {"summary " + (folder / "text.h5"), "not an HDF5 file"},
           {"curve " + run + " --columns mean_stres", "mean_stress"},
           {"curve " + run + " --columns zzz", "--columns: found no column 'zzz', allowed: time, "},
           {"contact " + run + " --snapshot 4", "allowed: 0 … 0"},
           {"section " + run + " --field colour -o " + (folder / "x.png"),
            "--field: found 'colour', allowed: von_mises, "},
           {"section " + run + " --position 7 -o " + (folder / "x.png"), "cuts no grain"},
           {"section " + run + " --range 5,5 -o " + (folder / "x.png"), "low < high"},
           {"section " + run + " --packing " + run + " -o " + (folder / "x.png"), "exactly one"},
           {"section --packing " + run + " -o " + (folder / "x.png"), "allowed: a packing file"},
           {"section " + run + " --view 5,6,5,6 -o " + (folder / "x.png"),
            "--view: no grain is cut in 5 … 6, 5 … 6 mm, allowed"},
           {"section " + run, "found neither of --output and --data, allowed: one or both"},
           {"summary " + run + " -o " + run, "would overwrite the input"},
           {fmt::format("stress-at-densities {0} --densities 0.8 --reference {1} --data {1}", run, folder / "text.h5"),
            "would overwrite the input"},
           {fmt::format("powder {0} -o {0}", folder / "text.h5"), "would overwrite the input"},
           {fmt::format("section {} -o {}", run, folder / "x.jpg"), "the ending '.jpg', allowed: .png"},
           {fmt::format("contact {} --pair 0,1 --view {}", run, folder / "x"), "no ending, allowed: .png"},
           {fmt::format("density-map {} -o {}", run, folder / "x.svg"), "the ending '.svg', allowed: .csv or .png"},
           {"vtk -o " + (folder / "x"), "found neither of RUN.h5 and --packing, allowed: exactly one"}}) {
    const Outcome outcome = postproc(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    CHECK_FALSE(std::filesystem::exists(folder / "x.png"));
  }
  CHECK(schema::validate(run).empty()); // still the run
  const Outcome bare =
      run_command(fmt::format("PATH=/nonexistent '{}' section {} -o {}", MPFEM_POSTPROC, run, folder / "x.png"));
  CHECK(bare.exit_code == 3);
  CHECK(bare.one_error_line("postproc"));
  CHECK_THAT(bare.messages, Catch::Contains("gnuplot is not installed"));
  CHECK_FALSE(std::filesystem::exists(folder / "x.png"));
  CHECK(postproc("curve " + run + " -o " + (folder / "no/such/folder.csv")).exit_code == 2);
  CHECK(postproc("--help").exit_code == 0);
  CHECK(postproc("section --help").exit_code == 0);
  CHECK(postproc("juggle").exit_code == 2);
}

TEST_CASE("two outputs of one command have two names") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  write_text(folder / "points.csv", "a,b\n1,2\n2,3\n3,5\n");
  const std::string run = folder / "run.h5", one = folder / "one.png", other = folder / "sub/../one.png";
  std::filesystem::create_directory(folder / "sub");
  for (const std::string& command :
       {"section " + run + " -o " + one + " --data " + other,
        "contact " + run + " --pair 0,1 -o " + other + " --data " + one,
        "contact " + run + " --pair 0,1 --view " + one + " --data " + other,
        "hysteresis " + run + " -o " + one + " --cycles " + other, "damage " + run + " -o " + one + " --data " + other,
        "stress-at-densities " + run + " --densities 0.6 -o " + one + " --data " + other,
        "diametral " + run + " -o " + one + " --data " + other,
        "density-map " + run + " -o " + one + " --data " + other,
        "fit " + (folder / "points.csv") + " --x a --y b --model linear -o " + one + " --curve " + other}) {
    const Outcome outcome = postproc(command);
    INFO(command << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains("would overwrite the output of --"));
    CHECK_FALSE(std::filesystem::exists(one));
  }
}

TEST_CASE("outputs are files, and text may go to a pipe or standard output too") {
  const Folder folder;
  const std::string run = folder / "run.h5", fifo = folder / "fifo";
  write_run(run, small_run());
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  const std::string curve = postproc("curve " + run + " --columns time").output;
  CHECK(postproc("curve " + run + " --columns time -o /dev/stdout").output == curve);
  CHECK(
      run_command(fmt::format("cat '{0}' & '{1}' curve '{2}' --columns time -o '{0}'; wait", fifo, MPFEM_POSTPROC, run))
          .output == curve);
  std::filesystem::create_symlink("target.csv", folder / "link.csv");
  CHECK(postproc("curve " + run + " --columns time -o " + (folder / "link.csv")).exit_code == 0);
  CHECK(std::filesystem::is_symlink(folder / "link.csv"));
  CHECK(read_text(folder / "target.csv") == curve);
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {"summary " + run + " -o .", "--output .: found a folder, allowed: a file"},
           {"curve " + run + " -o " + (folder / ""), "found a folder"},
           {"yield " + run + " -o .", "--output .: found a folder"},
           {"hysteresis " + run + " --cycles .", "--cycles .: found a folder"},
           {"section " + run + " -o " + fifo, "found a FIFO, allowed: a file"},
           {"section " + run + " --data .", "--data .: found a folder"},
           {"contact " + run + " --pair 0,1 --view " + fifo, "--view " + fifo + ": found a FIFO"},
           {"vtk " + run + " -o " + fifo, "found a file, allowed: a folder"}}) {
    const Outcome outcome = postproc(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    CHECK(std::filesystem::is_fifo(fifo));
  }
}

TEST_CASE("validate says which file has no checksums, and where a checked one is damaged") {
  const Folder folder;
  const std::string good = folder / "good.h5", bad = folder / "bad.h5";
  write_run(good, small_run());
  CHECK(postproc("validate " + good).output == good + ": valid (run, schema 1.0)\n");
  std::string bytes = read_text(good);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  write_text(bad, bytes);
  const Outcome outcome = postproc("validate " + bad);
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.one_error_line("postproc"));
  CHECK_THAT(outcome.output,
             Catch::StartsWith(bad + ": the file is damaged: its structure does not match its checksum\n"));
  const Outcome reading = postproc("summary " + bad);
  CHECK(reading.exit_code == 2);
  CHECK_THAT(reading.messages, Catch::Contains(bad + ": the file is damaged"));
}

TEST_CASE("a missing postproc-picture is reported with what adds it, to a build and to an installation") {
  const Folder folder;
  const std::string program = folder / "bin/postproc";
  std::filesystem::create_directories(folder / "bin");
  std::filesystem::copy_file(MPFEM_POSTPROC, program);
  const Outcome installed = run_command(program + " picture run.h5");
  CHECK(installed.exit_code == 3);
  CHECK(installed.one_error_line("postproc"));
  CHECK_THAT(installed.messages,
             Catch::Contains(program + "-picture is not installed: run ./bootstrap pictures") &&
                 Catch::Contains("--component pictures --prefix " +
                                 std::filesystem::path(program).parent_path().parent_path().string()));
  write_text(folder / "CMakeCache.txt", "");
  CHECK_THAT(run_command(program + " picture run.h5").messages,
             Catch::Contains("is not built: ./bootstrap pictures builds it"));
  const Outcome help = run_command(program + " picture --help");
  CHECK(help.exit_code == 0);
  CHECK_THAT(help.output, Catch::Contains("--camera") && Catch::Contains("Needs the executable postproc-picture"));
}

TEST_CASE("validate says that a file has lost its seal though all of its values are there") {
  const Folder folder;
  const std::string path = folder / "run.h5";
  write_run(path, small_run());
  CHECK_THAT(postproc("validate " + path).output, !Catch::Contains("seal"));
  const std::string bytes = read_text(path);
  write_text(path, bytes.substr(0, bytes.size() - 1));
  const Outcome cut = postproc("validate " + path);
  CHECK(cut.exit_code == 0);
  CHECK_THAT(cut.output,
             Catch::StartsWith(fmt::format("{0}: valid (run, schema 1.0)\n{0}: note: has no seal: ", path)));
}

TEST_CASE("validate passes a good file and finds a bad one") {
  const Folder folder;
  write_run(folder / "good.h5", small_run());
  RunContents contents = small_run();
  contents.numbers["/mesh/tet"][5] = 1000;
  write_run(folder / "bad.h5", contents);
  CHECK(postproc("validate " + (folder / "good.h5")).exit_code == 0);
  // Bytes changed after writing: half of the file is missing.
  write_text(folder / "cut.h5", read_text(folder / "good.h5").substr(0, 2000));
  const Outcome outcome = postproc(fmt::format("validate {} {} {} {}", folder / "absent.h5", folder / "cut.h5",
                                               folder / "good.h5", folder / "bad.h5"));
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.one_error_line("postproc"));
  CHECK_THAT(outcome.messages, Catch::Contains("3 of 4"));
  CHECK_THAT(outcome.output, Catch::Contains("absent.h5: no such file") && Catch::Contains("cut.h5: "));
  CHECK_THAT(outcome.output, Catch::Contains("good.h5: valid") && Catch::Contains("/mesh/tet holds the index 1000"));
}
