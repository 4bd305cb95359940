// postproc watch: what is seen of a run while it works, and that the run does not notice.

#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <thread>

#include "postproc/watch/character_plot.hpp"
#include "postproc/watch/watch_frame.hpp"
#include "tests/common/one_line_error.hpp"
#include "tests/support/small_runs.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

namespace fs = std::filesystem;

/// With many checkpoints. At 20,000 mm/s a run takes a second.
std::string often_saved(int history_rows, double wall_speed) {
  return replaced(replaced(replaced(scenario_text, "history_rows = 20",
                                    fmt::format("history_rows = {}\ncheckpoint_interval = 0.02", history_rows)),
                           "name = \"compaction\"", "name = \"first\""),
                  "wall_speed = 20000", fmt::format("wall_speed = {}", wall_speed)) +
         "[[stages]]\ntype = \"isotropic_unloading\"\nmean_stress = 0\nwall_speed = 20000\n";
}

std::string run_text(const Folder& folder, const std::string& output, const std::string& options = "") {
  return fmt::format("'{}' run {} -o {} --quiet {}", MPFEM_EXECUTABLE, folder / "scenario.toml", output, options);
}

Outcome watch(const std::string& arguments) {
  return run_command(fmt::format("'{}' watch {}", MPFEM_POSTPROC, arguments));
}

/// Leaves what an interrupted run leaves: two checkpoints of its first stage, which takes long, and a run file.
void make_unfinished(const Folder& folder) {
  prepare(folder, 4, often_saved(2000, 500));
  for (double limit = 0.4; !fs::exists(folder / "run.checkpoint.previous.h5"); limit *= 1.5) {
    const Outcome outcome = run_command(run_text(folder, folder / "run.h5", fmt::format("--time-limit {}", limit)));
    REQUIRE(outcome.exit_code == 5);
    REQUIRE(limit < 60);
  }
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

RunProgress halfway() {
  RunProgress progress;
  progress.file = "run.checkpoint.h5";
  progress.written = 1000;
  progress.at_work = AtWork::yes;
  progress.plan = {{{"first", "isotropic_compaction"}, {"second", "isotropic_unloading"}, {"third", "hold"}}, 10};
  progress.stage_ends = {"relative density 0.62"};
  progress.rows = {{.stage = 0, .relative_density = 0.5, .stored = 1, .dissipated = 4},
                   {.stage = 0, .relative_density = 0.6, .mean_stress = 20, .stored = 2, .dissipated = 9}};
  for (int i = 0; i <= 4; ++i)
    progress.rows.push_back({.stage = 1,
                             .step = 100.0 + 2 * i,
                             .time = 1e-6,
                             .relative_density = 0.6 - 0.01 * i,
                             .mean_stress = 20.0 - i,
                             .time_step = 2e-10,
                             .kinetic = 0.01,
                             .stored = 2,
                             .dissipated = 10,
                             .external_work = 20,
                             .residual = 0.02});
  progress.step = 109; // half of the way to the next row
  progress.seconds_per_stage = 500;
  return progress;
}

} // namespace

TEST_CASE("a curve is drawn from corner to corner, with the ends of its axes") {
  const std::vector<double> x{0, 1, 2}, y{0, 1, 2};
  CHECK(draw({.x_label = "x", .y_label = "y", .columns = 5, .rows = 3}, x, y) == "   y\n"
                                                                                 "2 |    *\n"
                                                                                 "  |  **\n"
                                                                                 "0 |**\n"
                                                                                 "  +-----\n"
                                                                                 "   0 x 2\n");
}

TEST_CASE("points that are not finite are left out of a curve, and no point gives no drawing") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const CharacterPlot plot{.x_label = "x", .y_label = "y", .columns = 5, .rows = 3};
  const std::vector<double> x{0, 1, none, 2}, y{0, none, 1, 2}, both{0, 2};
  CHECK(draw(plot, x, y) == draw(plot, both, both));
  CHECK(draw(plot, std::vector{none}, std::vector{1.0}).empty());
  const std::vector<double> same{3, 3};
  CHECK(contains(draw(plot, same, same), "  |  *\n")); // without extent: in the middle
}

TEST_CASE("a frame shows the stage, its state, energies over those of the stage, and when the stage may end") {
  const std::string frame = watch_frame(halfway(), 1100);
  INFO(frame);
  CHECK(contains(frame, "run.checkpoint.h5: mpfem is running, written 1:40 ago\n"));
  CHECK(contains(frame, "done      first: ended by relative density 0.62\n"));
  CHECK(contains(frame, "stage     2 of 3: second (isotropic_unloading), 45 % of its expected time\n"));
  CHECK(contains(frame, "step      109, time 1.0000 µs, time step 0.2000 ns\n"));
  CHECK(contains(frame, "mean stress p 16 MPa"));
  CHECK(contains(frame, "kinetic/internal 3.33e-03, residual/work 1.00e-03")); // internal: 2 stored, 1 dissipated
  CHECK(contains(frame, "remaining 2:55 to the expected end of the stage, then 1 more stage\n")); // 0.55 * 500 - 100 s
  for (std::size_t begin = 0; begin < frame.size(); begin = frame.find('\n', begin) + 1)
    CHECK(frame.find('\n', begin) - begin <= 80);
  RunProgress unknown = halfway();
  unknown.seconds_per_stage.reset();
  unknown.plan = {};
  CHECK(contains(watch_frame(unknown, 1100), "stage     2, "));
  CHECK(contains(watch_frame(unknown, 1100), "remaining not known yet\n"));
}

TEST_CASE("watching a run does not change its results, and the watch ends with the run") {
  const Folder folder;
  prepare(folder, 4, often_saved(20, 20000));
  REQUIRE(run_command(run_text(folder, folder / "alone.h5")).exit_code == 0);
  const Outcome both = run_command(fmt::format("{} & while ! [ -e {} ]; do sleep 0.01; done; '{}' watch {} --interval "
                                               "0.1 || exit 100; wait $!",
                                               run_text(folder, folder / "run.h5"), folder / "run.lock", MPFEM_POSTPROC,
                                               folder / "run.h5"));
  INFO(both.output + both.messages);
  CHECK(both.exit_code == 0);
  CHECK(both.only_warnings("mpfem"));
  CHECK(contains(both.output, "run.checkpoint.h5: mpfem is running"));
  CHECK(contains(both.output, "stage     1 of 2: first (isotropic_compaction)"));
  CHECK(contains(both.output, "run.h5: complete"));
  CHECK(contains(both.output, "stage     2 of 2: isotropic_unloading-2 (isotropic_unloading)\n"));
  CHECK(results(folder / "run.h5") == results(folder / "alone.h5"));
  CHECK_FALSE(fs::exists(folder / "run.checkpoint.h5"));
}

TEST_CASE("the state that a killed run has left is shown, even between the renames of its checkpoints") {
  const Folder folder;
  make_unfinished(folder);
  const Outcome stopped = watch((folder / "run.h5") + " --once");
  CHECK(stopped.exit_code == 0);
  CHECK(contains(stopped.output, "run.h5: interrupted"));
  fs::remove(folder / "run.h5");
  const Outcome killed = watch((folder / "run.h5") + " --once");
  INFO(killed.output);
  CHECK(killed.exit_code == 0);
  CHECK(contains(killed.output, "run.checkpoint.h5: no mpfem is running (--resume continues)"));
  CHECK(contains(killed.output, "p / MPa"));
  CHECK_FALSE(contains(killed.output, "remaining not known"));
  write_text(folder / "run.lock", "");
  CHECK(contains(watch((folder / "run.h5") + " --once").output, "running on another machine, or was killed, written"));
  fs::remove(folder / "run.lock");
  fs::remove(folder / "run.checkpoint.h5");
  CHECK(contains(watch((folder / "run.h5") + " --once").output, "run.checkpoint.previous.h5: no mpfem is running"));
}

TEST_CASE("rows of a checkpoint are those of the run file that is written with it") {
  const Folder folder;
  make_unfinished(folder);
  const RunProgress finished = read_progress(folder / "run.h5");
  fs::remove(folder / "run.h5");
  const RunProgress running = read_progress(folder / "run.h5");
  REQUIRE(running.rows.size() == finished.rows.size());
  for (std::size_t i = 0; i < running.rows.size(); ++i) {
    const ProgressRow &a = running.rows[i], &b = finished.rows[i];
    CHECK((a.stage == b.stage && a.step == b.step && a.time == b.time && a.time_step == b.time_step));
    CHECK((a.relative_density == b.relative_density && a.mean_stress == b.mean_stress));
    CHECK((a.deviatoric_stress == b.deviatoric_stress && a.penetration == b.penetration));
    CHECK((a.kinetic == b.kinetic && a.stored == b.stored && a.dissipated == b.dissipated));
    CHECK((a.external_work == b.external_work && a.residual == b.residual));
  }
}

TEST_CASE("a run that replaces an older run file shows nothing of the older one") {
  const Folder folder;
  make_unfinished(folder);
  fs::remove(folder / "run.checkpoint.h5");
  fs::remove(folder / "run.checkpoint.previous.h5");
  write_text(folder / "run.lock", "");
  fs::last_write_time(folder / "run.lock", fs::last_write_time(folder / "run.h5") + std::chrono::seconds(1));
  CHECK(contains(watch((folder / "run.h5") + " --once").output, "mpfem has started this run"));
}

TEST_CASE("without any file of a run, and with a damaged checkpoint, watch says so in one line") {
  const Folder folder;
  const Outcome nothing = watch((folder / "run.h5") + " --once");
  CHECK(nothing.exit_code == 2);
  CHECK(nothing.one_error_line("postproc"));
  CHECK(contains(nothing.messages, "found neither this file nor a checkpoint"));
  write_text(folder / "run.checkpoint.h5", "no checkpoint");
  const Outcome damaged = watch((folder / "run.h5") + " --once");
  CHECK(damaged.exit_code == 2);
  CHECK(damaged.one_error_line("postproc"));
  CHECK(contains(damaged.messages, "run.checkpoint.h5"));
}
