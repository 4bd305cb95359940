// The container that tools form: dies of planes, of triangles and round ones, the heights of punches, and refusals.

#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/small_runs.hpp"
#include "tests/support/tolerances.hpp"
#include "tests/support/triangle_meshes.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

const std::string punches = R"([[tools]]
name = "lower"
type = "plane"
face = "-z"
[[tools]]
name = "upper"
type = "plane"
face = "+z"
)";

/// Four planes at the lateral faces of the box, 0.42 mm apart.
const std::string four_planes = R"([[tools]]
name = "west"
type = "plane"
face = "-x"
[[tools]]
name = "east"
type = "plane"
face = "+x"
[[tools]]
name = "south"
type = "plane"
face = "-y"
[[tools]]
name = "north"
type = "plane"
face = "+y"
[container]
wall = ["west", "east", "south", "north"]
lower = "lower"
upper = "upper"
)";

const std::string die_of_triangles = R"([[tools]]
name = "die"
type = "stl"
file = "die.stl"
scale = 1
grains = "inside"
[container]
wall = "die"
lower = "lower"
upper = "upper"
)";

/// Tools at rest.
const std::string holding = R"([[stages]]
name = "hold"
type = "tools"
duration = 1e-7
)";

std::string pressing_to(const std::string& end) {
  return fmt::format(R"([[stages]]
name = "press"
type = "tools"
{}
drive.upper.speed = 20000
drive.lower.speed = 20000
)",
                     end);
}

/// Eight grains pressed in a die. `triangles`: of die.stl.
struct Press {
  Folder folder;
  Outcome outcome;

  /// `later`: the stages that follow.
  Press(const std::string& die, const std::string& end, const LooseTriangles& triangles = {},
        const std::string& later = "") {
    prepare(folder, 4, material_text + punches + die + pressing_to(end) + later);
    write_text(folder / "die.stl", text_stl(triangles));
    outcome = mpfem_command(fmt::format("run {} -o {} --quiet", folder / "scenario.toml", folder / "run.h5"));
  }
  schema::FileReader file() const { return schema::FileReader(folder / "run.h5", schema::FileKind::run); }
};

const std::vector<std::array<double, 2>> square{{0, 0}, {0.42, 0}, {0.42, 0.42}, {0, 0.42}};

} // namespace

TEST_CASE("a square die of four planes and one of triangles give the same density and stresses") {
  const Press planes(four_planes, "relative_density = 0.65"),
      triangles(die_of_triangles, "relative_density = 0.65", prism(square, -0.2, 0.7));
  INFO(planes.outcome.messages << triangles.outcome.messages);
  REQUIRE(planes.outcome.exit_code == 0);
  REQUIRE(triangles.outcome.exit_code == 0);
  const auto a = planes.file().read(schema::run::history_wall_stress),
             b = triangles.file().read(schema::run::history_wall_stress);
  CHECK(within(planes.file().read(schema::run::history_relative_density).back(), 0.65, 1e-8));
  CHECK(within(triangles.file().read(schema::run::history_relative_density).back(), 0.65, 1e-8));
  CHECK(planes.file().read(schema::run::history_section_share).back() == 1);
  CHECK(within(triangles.file().read(schema::run::history_section_share).back(), 1, 1e-12));
  REQUIRE(a.size() == b.size());
  REQUIRE(a.back() > 1); // MPa
  // The punches have the same stress. Each plane has its own; a die of triangles has the mean of all four.
  const std::size_t last = a.size() - 6;
  for (std::size_t side = 4; side < 6; ++side) CHECK(within(b[last + side], a[last + side], 1e-6));
  const double mean = 0.25 * (a[last] + a[last + 1] + a[last + 2] + a[last + 3]);
  for (std::size_t side = 0; side < 4; ++side) CHECK(within(b[last + side], mean, 1e-6));
}

TEST_CASE("each plane of a die bears its force over the width and height of the die") {
  const Press press(four_planes, "relative_density = 0.6");
  REQUIRE(press.outcome.exit_code == 0);
  const schema::FileReader file = press.file();
  const auto stress = file.read(schema::run::history_wall_stress);
  const auto lengths = file.read(schema::run::history_box_lengths);
  const auto east = file.read(schema::run::history_tools_force, "east");
  const double height = lengths.back();
  REQUIRE(east[east.size() - 3] > 0);
  CHECK(within(stress[stress.size() - 5], east[east.size() - 3] / (0.42 * height), 1e-12));
}

TEST_CASE("the density in a die of six sides refers to its cross-section") {
  const Press press(die_of_triangles, "relative_density = 0.5",
                    moved(prism(regular_polygon(6, 0.3), -0.2, 0.7), {0.21, 0.21, 0}));
  INFO(press.outcome.messages);
  REQUIRE(press.outcome.exit_code == 0);
  const schema::FileReader file = press.file();
  const auto lengths = file.read(schema::run::history_box_lengths);
  const double height = lengths.back(), area = 1.5 * std::sqrt(3.0) * 0.3 * 0.3;
  const auto solid = [](const Press& any) {
    const auto l = any.file().read(schema::run::history_box_lengths);
    return any.file().read(schema::run::history_relative_density)[0] * l[0] * l[1] * l[2];
  };
  const Press box(four_planes, "relative_density = 0.5");
  CHECK(within(0.5 * area * height, solid(box), 1e-8));
  CHECK(within(file.read(schema::run::history_section_share)[0], 0.75, 1e-6)); // of 2 r times sqrt(3) r
}

TEST_CASE("a stage may end when the punches are a height apart") {
  const Press press(four_planes, "height = 0.3");
  INFO(press.outcome.messages);
  REQUIRE(press.outcome.exit_code == 0);
  CHECK(within(press.file().read(schema::run::history_box_lengths).back(), 0.3, 1e-8));
  CHECK(press.file().read(schema::run::provenance_stage_end).back() == "height 0.3 mm");
  const Press flat(four_planes, "height = 0.01");
  CHECK(flat.outcome.exit_code == 2);
  CHECK_THAT(flat.outcome.messages, Catch::Contains("key 'height'") &&
                                        Catch::Contains("0.01 mm, a relative density of ") &&
                                        Catch::Contains("allowed: up to 1.2"));
  const Press both(four_planes, "height = 0.3\nrelative_density = 0.6");
  CHECK(both.outcome.exit_code == 2);
  CHECK_THAT(both.outcome.messages, Catch::Contains("height") && Catch::Contains("one of the two"));
  const Press none("", "height = 0.3");
  CHECK(none.outcome.exit_code == 2);
  CHECK_THAT(none.outcome.messages, Catch::Contains("'stages.0.height'") && Catch::Contains("[container]"));
}

TEST_CASE("punches that would reach their stress only beyond full density fail with that reason") {
  // Soft contact gives way first; with stiff contact the grains' elements do.
  const Press soft(four_planes + "[contact]\nstiffness_factor = 0.5\n", "axial_stress = 1e9"),
      stiff(four_planes, "axial_stress = 1e9");
  INFO(soft.outcome.messages << stiff.outcome.messages);
  CHECK(soft.outcome.exit_code == 3);
  CHECK_THAT(soft.outcome.messages, Catch::Contains("end the stage at a lower density or stress"));
  CHECK(stiff.outcome.exit_code == 3);
  CHECK_THAT(stiff.outcome.messages, Catch::Contains("which is above the largest allowed, 1.2"));
}

TEST_CASE("the cell reaches from punch to punch again once a punch that was away is back") {
  const Press press(four_planes, "relative_density = 0.65", {}, R"([[stages]]
name = "release"
type = "tools"
away = ["upper"]
duration = 2e-6
[[stages]]
name = "rest"
type = "hold"
duration = 1e-7
)");
  INFO(press.outcome.messages);
  REQUIRE(press.outcome.exit_code == 0);
  const schema::FileReader file = press.file();
  const auto stage = file.read(schema::run::history_stage);
  const auto upper = file.read(schema::run::history_tools_displacement, "upper"),
             lower = file.read(schema::run::history_tools_displacement, "lower");
  const auto pressed = static_cast<std::size_t>(std::ranges::find(stage, 1) - stage.begin()) - 1;
  // The grains have sprung back by more than a tenth of a per cent: the punch returns above where it left.
  REQUIRE(upper.back() > upper[3 * pressed + 2] + 1e-3 * 0.42);
  CHECK(within(file.read(schema::run::history_box_lengths).back(), 0.42 + upper.back() - lower.back(), 1e-9));
}

TEST_CASE("a tablet leaves a square die through the end of a tube around its walls once these are away") {
  constexpr double mouth = 0.43; // mm, end of the tube
  const std::string ring = "[[tools]]\nname = \"ring\"\ntype = \"stl\"\nfile = \"die.stl\"\nscale = 1\n";
  const LooseTriangles die = tube(square, {{-0.3, -0.3}, {0.72, -0.3}, {0.72, 0.72}, {-0.3, 0.72}}, -0.1, mouth);
  const Press press(ring + four_planes, "relative_density = 0.65", die, R"([[stages]]
name = "eject"
type = "tools"
away = ["upper", "west", "east", "south", "north"]
drive.lower.speed = 20000
travel = 0.45
)");
  INFO(press.outcome.messages);
  REQUIRE(press.outcome.exit_code == 0);
  const schema::FileReader file = press.file();
  const auto stage = file.read(schema::run::history_stage);
  const auto force = file.read(schema::run::history_tools_normal_force, "ring");
  const auto first = static_cast<std::size_t>(std::ranges::find(stage, 1) - stage.begin());
  CHECK(force[first] > 0.1 * force[first - 1]); // N: the tube holds what the planes held
  CHECK(force.back() == 0);
  const auto node = file.read(schema::run::snapshots_node, "0001");
  double lowest = 1;
  for (std::size_t i = 2; i < node.size(); i += 3) lowest = std::min(lowest, static_cast<double>(node[i]));
  CHECK(lowest > mouth);
  const auto work = file.read(schema::run::history_external_work),
             residual = file.read(schema::run::history_energy_residual);
  CHECK(std::abs(residual.back()) < 0.02 * work.back());
}

TEST_CASE("walls of a container that are no die are refused with what was expected") {
  const auto refused = [](const std::string& die, const LooseTriangles& triangles = {}) {
    const Press press(die, "relative_density = 0.6", triangles);
    CHECK(press.outcome.exit_code == 2);
    CHECK(press.outcome.one_error_line("mpfem"));
    return press.outcome.messages;
  };
  CHECK_THAT(refused(replaced(four_planes, "\"north\"]", "]")), Catch::Contains("found 3 names"));
  CHECK_THAT(refused(replaced(four_planes, "[\"west\", \"east\"", "[\"east\", \"west\"")),
             Catch::Contains("found 'east', allowed: a plane whose normal is [1, 0, 0]"));
  CHECK_THAT(refused(replaced(four_planes, "[\"west\", \"east\", \"south\", \"north\"]", "\"west\"")),
             Catch::Contains("a list of four planes"));
  CHECK_THAT(refused(replaced(die_of_triangles, "\"inside\"", "\"outside\""), prism(square, -0.2, 0.7)),
             Catch::Contains("with the grains inside"));
  CHECK_THAT(refused(die_of_triangles, moved(ball(8, 16, 0.6), {0.21, 0.21, 0.21})),
             Catch::Contains("the cross-section of 'die' changes between the punches"));
}

TEST_CASE("a round die that leaves much of the space between the punches open is refused with both places") {
  const auto die = [](const std::string& extent) {
    return "[[tools]]\nname = \"die\"\ntype = \"cylinder\"\nextent = [" + extent +
           "]\n[container]\nwall = \"die\"\nlower = \"lower\"\nupper = \"upper\"\n";
  };
  for (const char* extent : {"5, 6", "0.1, 0.3", "-1, 0.2"}) {
    const Press press(die(extent), "relative_density = 0.6");
    CHECK(press.outcome.exit_code == 2);
    CHECK(press.outcome.one_error_line("mpfem"));
    CHECK_THAT(press.outcome.messages,
               Catch::Contains("'die' reaches from z = ") && Catch::Contains("the punches stand at z = 0 and 0.42 mm"));
  }
}

TEST_CASE("a die in other units than its scale is refused or warned of, with its size, the packing's and the scale") {
  const auto run = [](double scale, const char* grains = "inside", const std::string& container = "") {
    const Folder folder;
    const std::string die = fmt::format("[[tools]]\nname = \"die\"\ntype = \"stl\"\nfile = \"die.stl\"\n"
                                        "scale = {}\ngrains = \"{}\"\n",
                                        scale, grains);
    prepare(folder, 4, material_text + punches + die + container + holding);
    // Around the packing's box of 0.42 mm, or far from it.
    const double low = std::string(grains) == "inside" ? 0 : 3;
    write_text(folder / "die.stl", text_stl(moved(prism(square, -0.2, 0.7), {low, low, low})));
    return mpfem_command(fmt::format("run {} -o {}", folder / "scenario.toml", folder / "run.h5"));
  };
  const std::string container = "[container]\nwall = \"die\"\nlower = \"lower\"\nupper = \"upper\"\n";
  for (const std::string& parts : {std::string(), container}) {
    const Outcome small = run(0.001, "inside", parts);
    CHECK(small.exit_code == 2);
    CHECK_THAT(small.messages, Catch::Contains("die.stl spans 0.00042 x 0.00042 x 0.0009 mm with scale = 0.001, the "
                                               "packing's box 0.42 x 0.42 x 0.42 mm (STL files state no unit: scale "));
    const Outcome large = run(1000, "inside", parts);
    CHECK(large.exit_code == 0);
    CHECK_THAT(large.messages,
               Catch::Contains("warning: tool 'die' is far larger than the packing: ") &&
                   Catch::Contains("die.stl spans 420 x 420 x 900 mm with scale = 1000, the packing's"));
  }
  const Outcome body = run(0.01, "outside");
  CHECK(body.exit_code == 0);
  CHECK_THAT(body.messages, Catch::Contains("warning: tool 'die' is far smaller than the packing: "));
  for (const char* grains : {"inside", "outside"}) {
    const Outcome fitting = run(1, grains);
    INFO(fitting.messages);
    CHECK(fitting.exit_code == 0);
    CHECK_THAT(fitting.messages, !Catch::Contains("far "));
  }
}
