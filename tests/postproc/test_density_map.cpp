// The map of solid fraction over a die's radius and height, of the cube [-1, 1]^3 in a die of radius 1.5.

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "postproc/drawing/density_map.hpp"
#include "run_postproc.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

RunContents run_in_die() {
  RunContents run = small_run();
  run.numbers["/history/section_share"] = std::vector<double>(3, std::numbers::pi / 4);
  return run;
}

DensityMap map_of(const RunContents& contents, const DensityMapRule& rule) {
  const Folder folder;
  write_run(folder / "run.h5", contents);
  return density_map(read_snapshot({folder / "run.h5", schema::FileKind::run}, 0), rule);
}

constexpr double disc = std::numbers::pi * 1.5 * 1.5; // mm^2

} // namespace

TEST_CASE("the solid of every cell of a density map adds up to that of the grains") {
  const DensityMap map = map_of(run_in_die(), {.rings = 5, .layers = 4});
  CHECK(within(map.radius, 1.5, 1e-12));
  CHECK(within(map.height, 3, 1e-12));
  double solid = 0;
  for (const DensityCell& cell : map.cells)
    solid +=
        cell.density * std::numbers::pi * (cell.outer * cell.outer - cell.inner * cell.inner) * (cell.high - cell.low);
  CHECK(within(solid, 8, 1e-9));
  CHECK(within(map.density, 8 / (3 * disc), 1e-9));
}

TEST_CASE("layers and rings of a density map contain the volume that lies in them") {
  const DensityMap layers = map_of(run_in_die(), {.rings = 1, .layers = 3});
  // Edges of tets are 1 mm, parts of them some 0.25 mm: a layer's end cuts through parts.
  CHECK(within(layers.cells[0].density, 2 / disc, 0.05));
  CHECK(within(layers.cells[1].density, 4 / disc, 0.05));
  CHECK(within(layers.cells[2].density, 2 / disc, 0.05));
  const DensityMap rings = map_of(run_in_die(), {.rings = 3, .layers = 1});
  CHECK(within(rings.cells[0].density, 2.0 / 3, 0.08)); // two of the three mm in height
  CHECK(within(rings.cells[1].density, 2.0 / 3, 0.08));
  CHECK(within(rings.cells[2].density, 2.0 / 3 * (4 - std::numbers::pi) / (1.25 * std::numbers::pi), 0.15));
}

TEST_CASE("the density map of a filling that leans to one side has a larger uncertainty") {
  const DensityMap even = map_of(run_in_die(), {.rings = 1, .layers = 1});
  RunContents leaning = run_in_die();
  for (std::size_t i = 0; i < leaning.numbers["/snapshots/*/node"].size(); i += 3)
    leaning.numbers["/snapshots/*/node"][i] += 0.4;
  const DensityMap uneven = map_of(leaning, {.rings = 1, .layers = 1});
  CHECK(within(uneven.cells[0].density, even.cells[0].density, 1e-6)); // nothing is lost beyond the wall
  CHECK(uneven.cells[0].uncertainty > 3 * even.cells[0].uncertainty);
}

TEST_CASE("a density map is written as CSV and drawn, for runs in a die only") {
  const Folder folder;
  write_run(folder / "die.h5", run_in_die());
  write_run(folder / "box.h5", small_run());
  const Outcome csv = postproc(fmt::format("density-map {} --rings 2 --layers 3", folder / "die.h5"));
  CHECK(csv.exit_code == 0);
  CHECK(std::count(csv.output.begin(), csv.output.end(), '\n') == 7); // head and six cells
  CHECK(postproc(fmt::format("density-map {} -o {}", folder / "die.h5", folder / "map.png")).exit_code == 0);
  CHECK(read_text(folder / "map.png").starts_with("\x89PNG"));
  const Outcome refused = postproc(fmt::format("density-map {}", folder / "box.h5"));
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.messages, Catch::Contains("has no [container]"));
  RunContents square = run_in_die();
  square.numbers["/history/section_share"] = std::vector<double>(3, 1.0);
  write_run(folder / "square.h5", square);
  const Outcome other = postproc(fmt::format("density-map {}", folder / "square.h5"));
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.messages, Catch::Contains("allowed: a round one"));
  CHECK(postproc(fmt::format("density-map {} --rings 0", folder / "die.h5")).exit_code == 2);
}
