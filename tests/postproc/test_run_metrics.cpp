// Quality of loadings, triaxial tests, stress paths and sections, on runs written down row by row.

#include <cmath>
#include <filesystem>
#include <limits>

#include <catch2/catch.hpp>

#include "postproc/drawing/section_statistics.hpp"
#include "postproc/metrics/compaction_curve.hpp"
#include "postproc/metrics/quasi_static.hpp"
#include "postproc/metrics/stress_path.hpp"
#include "postproc/metrics/triaxial_test.hpp"
#include "run_postproc.hpp"
#include "small_run.hpp"
#include "stage_run.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

const HistoryTable history_of(const Folder& folder, RunContents contents) {
  write_run(folder / "run.h5", std::move(contents));
  return HistoryTable(schema::FileReader(folder / "run.h5"));
}

StageRows last_stage(const HistoryTable& history) {
  return stages_of(history, {}).back();
}

} // namespace

TEST_CASE("a loading is as quasi-static as its worst row above a fifth of the largest stress and before the peak") {
  const Folder folder;
  RunContents contents = run_of({{.stage = 0, .axial_stress = 1, .elastic = 1},
                                 {.stage = 1, .axial_stress = 1, .elastic = 1}, // below a fifth: not counted
                                 {.stage = 1, .axial_stress = 6, .plastic = 1, .elastic = 1, .residual = -0.2},
                                 {.stage = 1, .axial_stress = 10, .plastic = 2, .elastic = 2},
                                 {.stage = 1, .axial_stress = 8, .plastic = 2, .elastic = 2}}); // behind the peak
  contents.numbers["/history/kinetic_energy"] = {0, 1, 0.04, 0.02, 5};
  contents.numbers["/history/external_work"] = {0, 1, 2, 4, 4};
  const HistoryTable history = history_of(folder, contents);
  const Measurement m = quasi_static(history, last_stage(history), {});
  CHECK(m.details["kinetic_over_internal"].get<double>() == Approx(0.02).epsilon(1e-12));
  CHECK(m.details["kinetic_over_elastic"].get<double>() == Approx(0.04).epsilon(1e-12));
  CHECK(m.details["residual_over_work"].get<double>() == Approx(0.05).epsilon(1e-12));
  CHECK(m.details["imbalance"].get<double>() == 0);
}

TEST_CASE("a triaxial test says what q is at the end and at its largest, and how well the lateral force was kept") {
  const Folder folder;
  const HistoryTable history = history_of(
      folder,
      run_of({{.axial_strain = 0, .axial_stress = 8, .lateral_stress = 8, .plastic = 1},
              {.axial_strain = 0.05, .lateral_strain = 0.01, .axial_stress = 48, .lateral_stress = 8, .plastic = 2},
              {.axial_strain = 0.15, .lateral_strain = -0.1, .axial_stress = 38, .lateral_stress = 8, .plastic = 4}}));
  const Measurement m = triaxial_test(history, last_stage(history), 8, {});
  CHECK(m.value == Approx(30).epsilon(1e-12));
  CHECK(m.details["largest_deviatoric_stress_MPa"].get<double>() == Approx(40).epsilon(1e-12));
  CHECK(m.details["fall_from_largest_deviatoric_stress"].get<double>() == Approx(0.25).epsilon(1e-12));
  CHECK(m.details["volumetric_strain_at_end"].get<double>() == Approx(-0.05).epsilon(1e-12));
  CHECK(m.details["axial_strain_at_largest_contraction"].get<double>() == Approx(0.05).epsilon(1e-12));
  CHECK(m.details["plastic_dissipation_mJ"].get<double>() == Approx(3).epsilon(1e-12));
  // The same stress on faces of exp(-0.06) and exp(-0.05) of those at the beginning.
  CHECK(m.details["lateral_force_error"].get<double>() == Approx(1 - std::exp(-0.06)).epsilon(1e-12));
}

TEST_CASE("a stress path's ratio of q to p leaves the first quarter of the mean stress out") {
  const Folder folder;
  const HistoryTable history =
      history_of(folder, run_of({{.axial_stress = 3, .lateral_stress = 0},
                                 {.axial_stress = 33, .lateral_stress = 30, .plastic = 1},
                                 {.axial_stress = 60, .lateral_stress = 60, .plastic = 3, .damage = 1}}));
  const Measurement m = stress_path(history);
  CHECK(m.value == Approx(60).epsilon(1e-12));
  CHECK(m.details["largest_ratio"].get<double>() == Approx(3.0 / 31).epsilon(1e-12));
  CHECK(m.details["largest_deviatoric_stress_MPa"].get<double>() == Approx(3).epsilon(1e-12));
  CHECK(m.details["damage_share_at_end"].get<double>() == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("a section's stress is weighted by area, and polygons without area do not count") {
  const SectionStress s = section_stress({{30, 1}, {10, 8}, {20, 1}, {1e9, 0}}, 15);
  CHECK(s.mean == Approx(13).epsilon(1e-12));
  CHECK(s.median == 10);
  CHECK(s.percentile_95 == 30);
  CHECK(s.largest == 30);
  CHECK(s.share_above == Approx(0.2).epsilon(1e-12));
  CHECK_THROWS_WITH(section_stress({{1, 0}}, 0), "the section is empty");
}

TEST_CASE("a section says which snapshot it cuts, at which stress and in which stage") {
  const Folder folder;
  RunContents run = small_run();
  run.numbers["/snapshots/*/mean_stress"] = {7};
  write_run(folder / "run.h5", run);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const Measurement section = measure_section_stress(file, -1, 2, 10);
  CHECK(section.snapshot->number == 0);
  CHECK(section.snapshot->mean_stress == 7);
  CHECK(section.snapshot->stage == 0);
}

TEST_CASE("a section without grains is refused with the run's file, the snapshot and the axis") {
  const Folder folder;
  RunContents run = small_run();
  for (double& coordinate : run.numbers["/snapshots/*/node"]) coordinate += 100; // mm, outside of the box
  write_run(folder / "run.h5", run);
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  CHECK_THROWS_WITH(measure_section_stress(file, 0, 2, 10),
                    folder / "run.h5" + ": found no grain on the middle plane of snapshot 0, normal to z, allowed: a "
                                        "snapshot or axis with grains there");
}

TEST_CASE("a section's damage is weighted by length, and what was never bonded does not count") {
  const auto segment = [](double length, double from, double to) {
    return BoundarySegment{{0, 0}, {length, 0}, from, to, 0};
  };
  const SectionDamage s = section_damage({segment(1, 1, 1), segment(3, 0.2, 0.4), segment(5, -1, -1)}, 0.99);
  CHECK(s.bonded_length == Approx(4).epsilon(1e-12));
  CHECK(s.mean == Approx((1 + 0.9) / 4).epsilon(1e-12));
  CHECK(s.share_above == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("a value at a density lies between the rows around it, and there is none where it was not passed") {
  const std::vector<double> density = {0.62, 0.7, 0.7, 0.8}, values = {1, 5, 6, 16};
  const auto found = values_at_densities(density, values, {0.60, 0.62, 0.66, 0.75, 0.8000005, 0.9});
  CHECK_FALSE(found[0]); // it began denser
  CHECK(*found[1] == 1);
  CHECK(*found[2] == Approx(3).epsilon(1e-12));
  CHECK(*found[3] == Approx(11).epsilon(1e-12));
  CHECK(*found[4] == 16); // a rounding below counts
  CHECK_FALSE(found[5]);
}

TEST_CASE(
    "stresses at densities are numbers by name and rows of a table; a last density that is not reached is reported") {
  const Folder folder;
  history_of(folder, run_of({{.axial_stress = 3, .relative_density = 0.6, .contact_area = 10},
                             {.axial_stress = 9, .relative_density = 0.8, .contact_area = 20}}));
  const schema::FileReader file(folder / "run.h5");
  const Measurement m = measure_stress_at_densities(file, {0.5, 0.7, 0.8});
  CHECK(m.value == Approx(3).epsilon(1e-12));
  CHECK(m.details["at_0.70"].get<double>() == Approx(2).epsilon(1e-12));
  CHECK(m.details["at_0.50"].is_null());
  CHECK(stress_at_densities_csv(file, {0.5, 0.7}) ==
        "name,relative_density [1],mean_stress [MPa],contact_area [mm^2]\nD0.50,0.50,,\nD0.70,0.70,2,15\n");
  write_text(folder / "r.csv", "relative_density,mean_stress_MPa\n0.6,2\n0.8,6\n");
  CHECK(stress_at_densities_csv(file, {0.5, 0.7}, read_compaction_curve(folder / "r.csv")) ==
        "name,relative_density [1],mean_stress [MPa],reference [MPa],over_reference [1],contact_area [mm^2]\n"
        "D0.50,0.50,,,,\nD0.70,0.70,2,4,0.5,15\n");
  write_text(folder / "r.csv", "relative_density,mean_stress_MPa\n0.8,6\n0.6,2\n");
  CHECK_THROWS_WITH(read_compaction_curve(folder / "r.csv"), Catch::Contains("each denser than the one before"));
  write_text(folder / "r.csv", "relative_density,stress\n0.8,6\n");
  CHECK_THROWS_WITH(read_compaction_curve(folder / "r.csv"), Catch::Contains("mean_stress_MPa"));
  CHECK_THROWS_WITH(measure_stress_at_densities(file, {0.9}), Catch::Contains("0.9 is not reached"));
  CHECK_THROWS_WITH(measure_stress_at_densities(file, {0.8, 0.7}), Catch::Contains("each larger than the one before"));
}

TEST_CASE("extremes, numbers of a last row and sections have no known uncertainty: null, and a line without ±") {
  const Folder folder;
  RunContents run = small_run();
  run.numbers["/history/wall_stress"] = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 5, 5, 2, 2, 2, 2, 10, 10};
  write_run(folder / "run.h5", run);
  const std::string out = folder / "out.json";
  for (const std::string command :
       {"quasi-static", "triaxial --stage 0 --lateral-stress 8", "stress-path", "section-stress --threshold 1",
        "stress-at-densities --densities 0.6", "compaction-quality --from-density 0.7"}) {
    const Outcome outcome = postproc(fmt::format("{} {} -o {}", command, folder / "run.h5", out));
    INFO(command << ": " << outcome.output << outcome.messages);
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.output, !Catch::Contains("±") && !Catch::Contains("nan"));
    const auto json = nlohmann::json::parse(read_text(out));
    CHECK(json.at("value").is_number());
    CHECK(json.at("uncertainty").is_null());
    CHECK_THAT(json.at("uncertainty_meaning").get<std::string>(), Catch::StartsWith("not known: "));
  }
}

TEST_CASE("energies and contacts of a stage with too few rows have no known uncertainty, and a note says so") {
  const Folder folder;
  write_run(folder / "run.h5", run_of({{.axial_stress = 9, .relative_density = 0.8, .elastic = 2},
                                       {.stage = 1, .axial_stress = 4, .relative_density = 0.7, .elastic = 1},
                                       {.stage = 1, .axial_stress = 1, .relative_density = 0.6, .elastic = 0.5}}));
  const std::string out = folder / "out.json";
  for (const std::string command : {"energy", "contact --history"}) {
    const Outcome outcome = postproc(fmt::format("{} {} -o {}", command, folder / "run.h5", out));
    INFO(command << ": " << outcome.output << outcome.messages);
    REQUIRE(outcome.exit_code == 0);
    CHECK_THAT(outcome.output, !Catch::Contains("±") && !Catch::Contains("nan"));
    CHECK_THAT(outcome.messages, Catch::Contains("the stage has 3 rows") && Catch::Contains("are not known"));
    CHECK(nlohmann::json::parse(read_text(out)).at("uncertainty").is_null());
  }
}

TEST_CASE("a history with a number that is not finite gives no metric, but can be looked at") {
  const Folder folder;
  const std::string run = folder / "run.h5", out = folder / "out.json";
  RunContents contents = small_run();
  contents.numbers["/history/mean_stress"][2] = std::nan("");
  write_run(run, contents);
  const std::string found = run + ": dataset /history/mean_stress, row 2: found nan";
  for (const std::string command : {"quasi-static", "stress-path", "energy", "contact --history", "strength",
                                    "hysteresis", "heckel", "compaction-quality --from-density 0.7"}) {
    const Outcome outcome = postproc(fmt::format("{} {} -o {}", command, run, out));
    INFO(command << ": " << outcome.output << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.messages, Catch::Contains(found + ", allowed: finite numbers"));
    CHECK_FALSE(std::filesystem::exists(out));
  }
  const Outcome curve = postproc("curve " + run + " --columns mean_stress"), summary = postproc("summary " + run);
  CHECK(curve.exit_code == 0);
  CHECK(curve.output == "mean_stress [MPa]\n0\n5\nnan\n");
  CHECK_THAT(curve.messages, Catch::Contains(found));
  CHECK(summary.exit_code == 0);
  CHECK_THAT(summary.output, Catch::Contains("warning") && Catch::Contains(found));
  // A snapshot may be sound though the run diverged later.
  const Outcome section = postproc("section-stress " + run + " --threshold 1");
  INFO(section.messages);
  CHECK(section.exit_code == 0);
  // Of a component, the row and not the place in the file.
  contents = small_run();
  contents.numbers["/history/wall_stress"][10] = std::numeric_limits<double>::infinity();
  write_run(run, contents);
  CHECK_THAT(postproc("quasi-static " + run).messages,
             Catch::Contains("dataset /history/wall_stress, row 1: found inf"));
}

TEST_CASE("a compaction's quality is that of its worst row from a density on") {
  const Folder folder;
  RunContents contents = run_of({{.relative_density = 0.6, .elastic = 1, .residual = 9},
                                 {.relative_density = 0.7, .plastic = 1, .elastic = 1, .residual = -0.4},
                                 {.relative_density = 0.8, .plastic = 2, .elastic = 2, .residual = 0.1}});
  contents.numbers["/history/kinetic_energy"] = {1, 0.02, 0.02};
  contents.numbers["/history/external_work"] = {1, 4, 8};
  contents.numbers["/history/max_penetration"] = {0.5, 0.01, 0.03};
  contents.numbers["/history/relative_density_current"] = {1.2, 0.9, 0.7};
  history_of(folder, contents);
  const schema::FileReader file(folder / "run.h5");
  const Measurement m = measure_compaction_quality(file, 0.7);
  CHECK(m.details["kinetic_over_internal"].get<double>() == Approx(0.01).epsilon(1e-12));
  CHECK(m.details["residual_over_work"].get<double>() == Approx(0.1).epsilon(1e-12));
  CHECK(m.details["largest_penetration"].get<double>() == Approx(0.03).epsilon(1e-12));
  CHECK(m.details["largest_current_density"].get<double>() == 0.9);
  CHECK_THROWS_WITH(measure_compaction_quality(file, 0.9), Catch::Contains("no row has a relative density of 0.9"));
}
