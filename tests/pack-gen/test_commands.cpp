// The command as a user gives it.

#include <cmath>

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "pack-gen/sphere_file.hpp"
#include "pack-gen/sphere_order.hpp"
#include "results-schema/file.hpp"
#include "run_pack_gen.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

const std::string description = R"(count = 11
relative_density = 0.3
box = [0.4, 0.4, 0.4]
smallest_gap = 0.002
size_scale_tolerance = 0.2
[size_distribution]
kind = "table"
measure = "diameter"
weight = "number"
values = [0.1, 0.2]
cumulative = [0, 1]
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("spheres, mesh, quality and export follow each other, and the files hold to the schema") {
  const Folder folder;
  write_text(folder / "pack.toml", description);
  REQUIRE(pack_gen(fmt::format("spheres {} -o {} --seed 5", folder / "pack.toml", folder / "s.h5")).exit_code == 0);
  const Outcome mesh = pack_gen(fmt::format("mesh {} --size 0.04 -o {} --threads 2", folder / "s.h5", folder / "p.h5"));
  INFO(mesh.messages);
  REQUIRE(mesh.exit_code == 0);
  CHECK_THAT(mesh.output,
             Catch::Contains("critical step") && Catch::Contains("facet gap") && Catch::Contains("volume error"));
  CHECK(schema::validate(folder / "s.h5").empty());
  CHECK(schema::validate(folder / "p.h5").empty());
  const SphereFile file = read_spheres(folder / "p.h5");
  CHECK(file.packing.radius.size() == 11);
  CHECK(file.origin.seed == 5);
  CHECK(relative_density(file.packing) == Approx(0.3).epsilon(1e-12));
  CHECK(pack_gen("quality " + (folder / "p.h5")).exit_code == 0);

  REQUIRE(pack_gen(fmt::format("export {} -o {}", folder / "p.h5", folder / "s.csv")).exit_code == 0);
  REQUIRE(pack_gen(fmt::format("import {} --box 0.4,0.4,0.4 -o {}", folder / "s.csv", folder / "again.h5")).exit_code ==
          0);
  const SphereFile again = read_spheres(folder / "again.h5");
  CHECK(again.packing.center == file.packing.center); // bit for bit
  CHECK(again.packing.radius == file.packing.radius);
}

namespace {

/// The description with a cylinder instead of its box, as high as wide.
std::string cylinder_description() {
  return replaced(description, "box = [0.4, 0.4, 0.4]", "container = \"cylinder\"\ndiameter = 0.44\nheight = 0.42");
}

} // namespace

TEST_CASE("more than a thousand spheres are numbered along a curve, fewer as they were packed") {
  const Folder folder;
  for (const std::size_t count : {1000U, 1001U}) {
    const double edge = 0.4 * std::cbrt(static_cast<double>(count) / 11);
    std::string many = replaced(description, "count = 11", fmt::format("count = {}", count));
    many = replaced(many, "[0.4, 0.4, 0.4]", fmt::format("[{0}, {0}, {0}]", edge));
    write_text(folder / "pack.toml", many);
    const std::string spheres = folder / fmt::format("{}.h5", count);
    REQUIRE(pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", spheres)).exit_code == 0);
    const SpherePacking packing = read_spheres(spheres).packing;
    REQUIRE(packing.radius.size() == count);
    CHECK((along_a_curve(packing).center == packing.center) == (count > any_order_up_to));
  }
}

TEST_CASE("a cylinder goes through spheres, mesh, quality, export and import with its shape and volume") {
  const Folder folder;
  write_text(folder / "pack.toml", cylinder_description());
  REQUIRE(pack_gen(fmt::format("spheres {} -o {} --quiet", folder / "pack.toml", folder / "s.h5")).exit_code == 0);
  const Outcome mesh = pack_gen(fmt::format("mesh {} --size 0.04 -o {} --threads 2", folder / "s.h5", folder / "p.h5"));
  INFO(mesh.messages);
  REQUIRE(mesh.exit_code == 0);
  for (const char* name : {"s.h5", "p.h5"}) {
    CHECK(schema::validate(folder / name).empty());
    const SpherePacking packing = read_spheres(folder / name).packing;
    CHECK(packing.shape == ContainerShape::cylinder);
    CHECK(packing.box == mpfem::Point{0.44, 0.44, 0.42});
    CHECK(relative_density(packing) == Approx(0.3).epsilon(1e-12));
    CHECK(smallest_gap(packing).gap >= 0.002 * (1 - 1e-12));
    const schema::FileReader file(folder / name);
    CHECK(file.read_scalar(schema::packing::packing_relative_density) == Approx(0.3).epsilon(1e-12));
  }
  // No node of the mesh is beyond the round wall, and the file says by how much.
  const schema::FileReader file(folder / "p.h5");
  const auto node = file.read(schema::packing::mesh_node);
  double farthest = 0;
  for (std::size_t i = 0; i < node.size(); i += 3)
    farthest = std::max(farthest, std::hypot(node[i] - 0.22, node[i + 1] - 0.22));
  CHECK(farthest < 0.22);
  CHECK(file.read_scalar(schema::packing::mesh_smallest_facet_gap) <= 0.22 - farthest);
  REQUIRE(pack_gen(fmt::format("quality {} -o {} --quiet", folder / "p.h5", folder / "q.json")).exit_code == 0);
  CHECK_THAT(read_text(folder / "q.json"),
             Catch::Contains("\"relative_density\": 0.3") || Catch::Contains("\"relative_density\": 0.2999999"));

  REQUIRE(pack_gen(fmt::format("export {} -o {}", folder / "p.h5", folder / "s.csv")).exit_code == 0);
  REQUIRE(pack_gen(fmt::format("import {} --container cylinder --diameter 0.44 --height 0.42 -o {}", folder / "s.csv",
                               folder / "again.h5"))
              .exit_code == 0);
  const SpherePacking again = read_spheres(folder / "again.h5").packing, first = read_spheres(folder / "s.h5").packing;
  CHECK(again.shape == ContainerShape::cylinder);
  CHECK(again.center == first.center); // bit for bit
}

TEST_CASE("settle keeps the shape, and --fit-height lowers the container to the bed") {
  const Folder folder;
  write_text(folder / "pack.toml", cylinder_description());
  REQUIRE(pack_gen(fmt::format("spheres {} -o {} --quiet", folder / "pack.toml", folder / "s.h5")).exit_code == 0);
  const Outcome settled = pack_gen(fmt::format("settle {} --fit-height -o {}", folder / "s.h5", folder / "b.h5"));
  INFO(settled.messages);
  REQUIRE(settled.exit_code == 0);
  CHECK_THAT(settled.messages, Catch::Contains("spheres at rest"));
  CHECK(schema::validate(folder / "b.h5").empty());
  const SpherePacking bed = read_spheres(folder / "b.h5").packing;
  CHECK(bed.shape == ContainerShape::cylinder);
  CHECK(bed.box[0] == 0.44);
  CHECK(bed.box[2] < 0.42);
  CHECK(smallest_gap(bed).gap >= smallest_gap(read_spheres(folder / "s.h5").packing).gap * (1 - 1e-9));
  CHECK(pack_gen(fmt::format("mesh {} --size 0.04 -o {} --quiet", folder / "b.h5", folder / "m.h5")).exit_code == 0);
  const Outcome refused = pack_gen(fmt::format("settle {} --gap 0.2 -o {} --quiet", folder / "s.h5", folder / "c.h5"));
  CHECK(refused.exit_code == 2);
  CHECK(refused.one_error_line("pack-gen"));
  CHECK_FALSE(std::filesystem::exists(folder / "c.h5"));
}

TEST_CASE("a cylinder on the command line takes the place of the description's box") {
  const Folder folder;
  write_text(folder / "box.toml", description);
  write_text(folder / "cylinder.toml", cylinder_description());
  REQUIRE(pack_gen(fmt::format("spheres {} --container cylinder --diameter 0.44 --height 0.42 -o {} --quiet",
                               folder / "box.toml", folder / "a.h5"))
              .exit_code == 0);
  REQUIRE(pack_gen(fmt::format("spheres {} -o {} --quiet", folder / "cylinder.toml", folder / "b.h5")).exit_code == 0);
  CHECK(read_spheres(folder / "a.h5").packing.center == read_spheres(folder / "b.h5").packing.center);
}

TEST_CASE("spheres about an axis elsewhere are imported with the centre of the bottom as given") {
  const Folder folder;
  write_text(folder / "s.csv", "x,y,z,radius\n0, 0, 0.5, 0.3\n0.7, 0, 0.5, 0.25\n");
  REQUIRE(pack_gen(fmt::format("import {} --container cylinder --diameter 2 --height 1 --bottom-center 0,0,0 -o {} "
                               "--quiet",
                               folder / "s.csv", folder / "s.h5"))
              .exit_code == 0);
  const SpherePacking packing = read_spheres(folder / "s.h5").packing;
  CHECK(packing.center[0] == mpfem::Point{1, 1, 0.5});
  CHECK(within(packing.center[1][0], 1.7, rounding));
  // Further out the second sphere is beyond the round wall: it is named, with its number.
  write_text(folder / "s.csv", "x,y,z,radius\n0, 0, 0.5, 0.3\n0.6, 0.6, 0.5, 0.25\n");
  const Outcome outcome =
      pack_gen(fmt::format("import {} --container cylinder --diameter 2 --height 1 --bottom-center 0,0,0 -o {}",
                           folder / "s.csv", folder / "t.h5"));
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.one_error_line("pack-gen"));
  CHECK_THAT(outcome.messages, Catch::Contains("sphere 1 at (0.6, 0.6, 0.5) and the round wall overlap by 0.0985"));
  CHECK_FALSE(std::filesystem::exists(folder / "t.h5"));
}

TEST_CASE("containers that are mixed or incomplete are refused with one line and exit code 2") {
  const Folder folder;
  write_text(folder / "s.csv", "x,y,z,radius\n0.5, 0.5, 0.5, 0.3\n");
  for (const auto& [options, expected] : std::vector<std::pair<std::string, std::string>>{
           {"--container cylinder", "--diameter D --height H"},
           {"--container cylinder --diameter 1", "--diameter D --height H"},
           {"--container cylinder --diameter 1 --height 1 --box 1,1,1", "--box"},
           {"--diameter 1", "--container cylinder"},
           {"--bottom-center 0,0,0", "--container cylinder"},
           {"--container cone --diameter 1 --height 1", "cone"},
           {"--container cylinder --diameter 0 --height 1", "--diameter"}}) {
    const Outcome outcome = pack_gen(fmt::format("import {} {} -o {}", folder / "s.csv", options, folder / "s.h5"));
    INFO(options << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
  }
  const std::string cylinder = cylinder_description();
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {replaced(cylinder, "height = 0.42\n", ""), "height"},
           {replaced(cylinder, "height = 0.42\n", "height = 0.42\nbox = [1, 1, 1]\n"),
            "cannot be used with a cylinder"},
           {replaced(description, "smallest_gap", "diameter = 1\nsmallest_gap"), "cannot be used with a box"},
           {replaced(cylinder, "\"cylinder\"", "\"cone\""), "cone"},
           {replaced(cylinder, "relative_density = 0.3", "relative_density = 0.7"), "diameter and height"},
           {replaced(cylinder, "smallest_gap = 0.002", "smallest_gap = 0.08"), "jam"}}) {
    write_text(folder / "pack.toml", text);
    const Outcome outcome = pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5"));
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    CHECK_FALSE(std::filesystem::exists(folder / "s.h5"));
  }
}

TEST_CASE("the examples are packed as they say") {
  const Folder folder;
  for (const auto& [name, count, density] :
       {std::tuple{"mcc_ph102", 329, 0.552}, {"mcc_ph102_smoke", 25, 0.45}, {"mcc_ph102_die", 329, 0.552}}) {
    REQUIRE(
        pack_gen(fmt::format("spheres {}/{}.toml -o {} --quiet", MPFEM_EXAMPLES, name, folder / "s.h5")).exit_code ==
        0);
    const SphereFile file = read_spheres(folder / "s.h5");
    CHECK(file.packing.radius.size() == static_cast<std::size_t>(count));
    CHECK(relative_density(file.packing) == Approx(density).margin(1e-9));
    CHECK(smallest_gap(file.packing).gap >= 0.003 * (1 - 1e-12));
    CHECK(file.origin.target_diameter.size() == 101);
  }
}

TEST_CASE("an import without a box takes the tightest one") {
  const Folder folder;
  write_text(folder / "s.csv", "# from elsewhere\nx,y,z,radius\n1, 1, 1, 0.5\n2.5, 1, 1, 0.25\n");
  REQUIRE(pack_gen(fmt::format("import {} -o {} --quiet", folder / "s.csv", folder / "s.h5")).exit_code == 0);
  const SpherePacking packing = read_spheres(folder / "s.h5").packing;
  CHECK(within(packing.box[0], 2.25, rounding));
  CHECK(within(packing.box[1], 1, rounding));
  CHECK(within(packing.center[0][0], 0.5, rounding));
}

TEST_CASE("an import with an element size gives the packing that meshing the imported spheres gives") {
  const Folder folder;
  write_text(folder / "s.csv", "x,y,z,radius\n0.2,0.2,0.2,0.1\n0.5,0.2,0.2,0.15\n");
  REQUIRE(pack_gen(fmt::format("import {} --box 1,1,1 --size 0.08 -o {} --quiet", folder / "s.csv", folder / "a.h5"))
              .exit_code == 0);
  REQUIRE(pack_gen(fmt::format("import {} --box 1,1,1 -o {} --quiet", folder / "s.csv", folder / "s.h5")).exit_code ==
          0);
  REQUIRE(pack_gen(fmt::format("mesh {} --size 0.08 -o {} --quiet", folder / "s.h5", folder / "b.h5")).exit_code == 0);
  const MeshFromFile at_once = read_mesh(folder / "a.h5"), in_two = read_mesh(folder / "b.h5");
  REQUIRE(at_once.mesh.tet.size() > 100);
  CHECK(at_once.mesh.tet == in_two.mesh.tet);
  CHECK(at_once.mesh.node == in_two.mesh.node);
}

TEST_CASE("pack-gen refuses what it cannot use with one line and exit code 2, and writes nothing") {
  const Folder folder;
  struct Case {
    std::string from, to, expected;
  };
  for (const Case& c :
       std::vector<Case>{{"count = 11", "count = ", "pack.toml:1"},
                         {"count = 11", "count = 0", "count"},
                         {"count = 11", "count = 11\ncuont = 3", "cuont"},
                         {"relative_density = 0.3", "relative_density = 0.9", "0.9"},
                         {"relative_density = 0.3", "relative_density = 0.7", "size_scale_tolerance"},
                         {"size_scale_tolerance = 0.2", "size_scale_tolerance = 5", "found 5, allowed: 0 … 1"},
                         {"kind = \"table\"\nmeasure = \"diameter\"\nweight = \"number\"\nvalues = [0.1, 0.2]\n"
                          "cumulative = [0, 1]",
                          "kind = \"list\"\nmeasure = \"diameter\"\nvalues = [0.1, 0.2]",
                          "pack.toml:1:9: key 'count': a list of 2 sizes cannot give 11 spheres"},
                         {"smallest_gap = 0.002", "smallest_gap = 0.08", "jam"},
                         {"[0.4, 0.4, 0.4]", "[0.4, 0.4]", "box"},
                         {"\"table\"", "\"weibull\"", "log_normal"},
                         {"cumulative = [0, 1]", "cumulative = [0, 0.5]", "cumulative"},
                         {"cumulative = [0, 1]", "file = \"none.csv\"", "values"},
                         {"values = [0.1, 0.2]\ncumulative = [0, 1]", "file = \"none.csv\"", "none.csv"}}) {
    write_text(folder / "pack.toml", replaced(description, c.from, c.to));
    const Outcome outcome = pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5"));
    INFO(c.to << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains(c.expected));
    CHECK_FALSE(std::filesystem::exists(folder / "s.h5"));
  }
  for (const auto& [csv, expected] : std::vector<std::pair<std::string, std::string>>{
           {"x,y,z,radius\n0,0,0,1\n0,0,1.5,1\n", "overlap"},
           {"x,y,z,radius\n0,0,0,-1\n", "radius"},
           {"x,y,z,radius\n0,0,zero,1\n", "s.csv:2"},
           {"x,y,z,radius\n0,0,0\n", "s.csv:2"},
           {"x,y,radius,z\n0,0,0,1\n", "s.csv:1"},
           {"x,y,z,radius [m]\n0,0,0,1\n", "found the unit 'm', allowed: mm"},
           {"", "no rows"}}) {
    write_text(folder / "s.csv", csv);
    const Outcome outcome = pack_gen(fmt::format("import {} -o {}", folder / "s.csv", folder / "s.h5"));
    INFO(csv << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    CHECK_FALSE(std::filesystem::exists(folder / "s.h5"));
  }
  write_text(folder / "s.csv", "0.5,0.5,0.5,0.2\n");
  REQUIRE(pack_gen(fmt::format("import {} --box 1,1,1 -o {}", folder / "s.csv", folder / "s.h5")).exit_code == 0);
  for (const auto& [arguments, place] : std::vector<std::pair<std::string, std::string>>{
           {"mesh " + (folder / "s.h5") + " --size 0.5 -o " + (folder / "p.h5"), ""},
           {"mesh " + (folder / "absent.h5") + " --size 0.1 -o " + (folder / "p.h5"), "input: "},
           {"quality " + (folder / "s.h5"), ""},
           {"mesh " + (folder / "s.csv") + " --size 0.1 -o " + (folder / "p.h5"), ""}}) {
    const Outcome outcome = pack_gen(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::StartsWith("pack-gen: error: " + place + (folder / "")));
    CHECK_FALSE(std::filesystem::exists(folder / "p.h5"));
  }
  // Sizes and outputs of the command line.
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "pack.toml"), "would overwrite the input"},
           {fmt::format("mesh {} --size 0.1 -o {}", folder / "s.h5", folder / "no/p.h5"), "does not exist"},
           {fmt::format("export {} -o {}", folder / "s.h5", folder / ""), "a folder"}}) {
    const Outcome outcome = pack_gen(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
  }
  CHECK(pack_gen("--help").exit_code == 0);
  CHECK(pack_gen("mesh --help").exit_code == 0);
  CHECK(pack_gen("").exit_code == 2);
}

TEST_CASE("no output of pack-gen replaces a file that it reads") {
  const Folder folder;
  write_text(folder / "sizes.csv", "0.1,0\n0.2,1\n");
  const std::string named = replaced(description, "values = [0.1, 0.2]\ncumulative = [0, 1]", "file = \"sizes.csv\"");
  write_text(folder / "pack.toml", named);
  REQUIRE(pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5")).exit_code == 0);
  REQUIRE(pack_gen(fmt::format("mesh {} --size 0.05 -o {}", folder / "s.h5", folder / "p.h5")).exit_code == 0);
  const std::string quality = fmt::format("quality {} --description {}", folder / "p.h5", folder / "pack.toml");
  REQUIRE(pack_gen(fmt::format("{} --sizes {} --target {}", quality, folder / "a.csv", folder / "b.csv")).exit_code ==
          0);
  for (const auto& [arguments, input] :
       {std::pair{fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "sizes.csv"), "sizes.csv"},
        {fmt::format("import {} --container surface --surface {} --scale 1 -o {}", folder / "sizes.csv",
                     folder / "pack.toml", folder / "pack.toml"),
         "pack.toml"},
        {fmt::format("{} -o {}", quality, folder / "pack.toml"), "pack.toml"},
        {fmt::format("{} --sizes {}", quality, folder / "p.h5"), "p.h5"},
        {fmt::format("{} --sizes {}", quality, folder / "pack.toml"), "pack.toml"},
        {fmt::format("{} --target {}", quality, folder / "p.h5"), "p.h5"},
        {fmt::format("{} --target {}", quality, folder / "sizes.csv"), "sizes.csv"}}) {
    const std::string before = read_text(folder / input);
    const Outcome outcome = pack_gen(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains("would overwrite the input " + (folder / input)) ||
                                     Catch::Contains((folder / input) + ": would replace "));
    CHECK(read_text(folder / input) == before);
  }
}

TEST_CASE("a packing replaces a packing, but no run") {
  const Folder folder;
  write_text(folder / "pack.toml", description);
  const auto make = [&] { return pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5")); };
  CHECK(make().exit_code == 0);
  CHECK(make().exit_code == 0);
  schema::FileWriter writer(folder / "s.h5", schema::FileKind::run, "test");
  writer.commit();
  const std::string before = read_text(folder / "s.h5");
  const Outcome outcome = make();
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Catch::Contains("would replace a run or a checkpoint"));
  CHECK(read_text(folder / "s.h5") == before);
}

TEST_CASE("two outputs of quality have two names") {
  const Folder folder;
  write_text(folder / "pack.toml", description);
  REQUIRE(pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5")).exit_code == 0);
  const std::string quality = fmt::format("quality {} --description {}", folder / "s.h5", folder / "pack.toml");
  for (const char* options : {"-o {0} --sizes {0}", "-o {0} --target {0}", "--sizes {0} --target {0}"}) {
    const Outcome outcome = pack_gen(quality + " " + fmt::format(fmt::runtime(options), folder / "one"));
    INFO(options << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains("would overwrite the output of --"));
    CHECK_FALSE(std::filesystem::exists(folder / "one"));
  }
}

TEST_CASE("overlapping spheres of a table are named where the table has them, in any container") {
  const Folder folder;
  write_text(folder / "s.csv", "5,5,5,1\n6,5,5,1\n");
  for (const std::string container : {"", "--container cylinder --diameter 4 --height 4 --bottom-center 5.5,5,3"}) {
    const Outcome outcome = pack_gen(fmt::format("import {} {} -o {}", container, folder / "s.csv", folder / "s.h5"));
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.messages, Catch::Contains("sphere 0 at (5, 5, 5) and sphere 1 at (6, 5, 5) overlap by 1 mm"));
  }
}

TEST_CASE("a word after a list or a setting is the input") {
  const Folder folder;
  write_text(folder / "s.csv", "0.5,0.5,0.5,0.2\n");
  write_text(folder / "pack.toml", description);
  CHECK(pack_gen(fmt::format("import --box 1,1,1 {} -o {}", folder / "s.csv", folder / "s.h5")).exit_code == 0);
  CHECK(pack_gen(fmt::format("spheres --set seed=3 --set smallest_gap=0.002 {} -o {}", folder / "pack.toml",
                             folder / "t.h5"))
            .exit_code == 0);
}

TEST_CASE("an output that cannot be written is refused before the mesh is made") {
  const Folder folder;
  write_packing_file(folder / "s.h5", {.box = {1, 1, 1}, .center = {{0.5, 0.5, 0.5}}, .radius = {0.4}}, {});
  std::filesystem::create_directory(folder / "p.h5.partial"); // nothing can be written under this name
  const Outcome outcome = pack_gen(fmt::format("mesh {} --size 0.1 -o {}", folder / "s.h5", folder / "p.h5"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 4);
  CHECK(outcome.one_error_line("pack-gen")); // and none of progress
}

TEST_CASE("a file with overlapping spheres is not meshed: the spheres and the overlap are named") {
  const Folder folder;
  write_packing_file(folder / "s.h5",
                     {.box = {1, 1, 1}, .center = {{0.3, 0.5, 0.5}, {0.7, 0.5, 0.5}}, .radius = {0.25, 0.2}}, {});
  const Outcome outcome = pack_gen(fmt::format("mesh {} --size 0.1 -o {}", folder / "s.h5", folder / "p.h5"));
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.one_error_line("pack-gen"));
  CHECK_THAT(outcome.messages,
             Catch::Contains("sphere 0") && Catch::Contains("sphere 1") && Catch::Contains("overlap by 0.05 mm"));
  CHECK_FALSE(std::filesystem::exists(folder / "p.h5"));
}

TEST_CASE("a mesh whose numbering is wrong is refused, not followed") {
  const Folder folder;
  const SpherePacking packing{.box = {1, 1, 1}, .center = {{0.3, 0.5, 0.5}, {0.7, 0.5, 0.5}}, .radius = {0.15, 0.15}};
  const PackingMesh good = mesh_packing(packing, {.nominal_size = 0.1});
  const auto quality_of = [&](const PackingMesh& mesh) {
    write_packing_file(folder / "p.h5", packing, {}, MeshForFile{&mesh, 0.1, 0.01, 0.5});
    return pack_gen("quality " + (folder / "p.h5"));
  };
  CHECK(quality_of(good).exit_code == 0);
  PackingMesh other_grain = good, outside = good, offsets = good;
  other_grain.tet[1] = good.grain_node_offset[1];
  outside.tet[5] = -3;
  offsets.grain_node_offset[1] = 1'000'000;
  for (const PackingMesh& mesh : {other_grain, outside, offsets}) {
    const Outcome outcome = quality_of(mesh);
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
  }
}

TEST_CASE("a mesh with an inverted tet is bad input, and the message names grain and tet") {
  const Folder folder;
  const SpherePacking packing{.box = {1, 1, 1}, .center = {{0.3, 0.5, 0.5}, {0.7, 0.5, 0.5}}, .radius = {0.15, 0.15}};
  PackingMesh mesh = mesh_packing(packing, {.nominal_size = 0.1});
  const auto tet = static_cast<std::size_t>(mesh.grain_tet_offset[1]) + 3;
  std::swap(mesh.tet[4 * tet], mesh.tet[4 * tet + 1]);
  write_packing_file(folder / "p.h5", packing, {}, MeshForFile{&mesh, 0.1, 0.01, 0.5});
  const Outcome outcome = pack_gen("quality " + (folder / "p.h5"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.one_error_line("pack-gen"));
  CHECK_THAT(outcome.messages, Catch::Contains("p.h5") && Catch::Contains("grain 1 has tetrahedron 3 without"));
}

TEST_CASE("a report that nobody reads to its end, or that does not fit, ends with exit code 4") {
  const Folder folder;
  const SpherePacking packing{.box = {1, 1, 1}, .center = {{0.3, 0.5, 0.5}}, .radius = {0.15}};
  const PackingMesh mesh = mesh_packing(packing, {.nominal_size = 0.1});
  write_packing_file(folder / "p.h5", packing, {}, MeshForFile{&mesh, 0.1, 0.01, 0.5});
  const Outcome closed = run_command(fmt::format("mkfifo {0}; (exec 3<{0}) & exec 4>{0}; wait; '{1}' quality {2} >&4",
                                                 folder / "pipe", MPFEM_PACK_GEN, folder / "p.h5"));
  CHECK(closed.exit_code == 4);
  CHECK(closed.one_error_line("pack-gen"));
  const Outcome full = run_command(fmt::format("'{}' quality {} >/dev/full", MPFEM_PACK_GEN, folder / "p.h5"));
  CHECK(full.exit_code == 4);
  CHECK(full.one_error_line("pack-gen"));
}

TEST_CASE("a table that cannot be stored ends with exit code 4 and leaves nothing half-written") {
  const Folder folder;
  SpherePacking packing{.box = {100, 1, 1}, .center = {}, .radius = {}};
  for (int i = 0; i < 100; ++i) {
    packing.center.push_back({i + 0.5, 0.5, 0.5});
    packing.radius.push_back(0.25);
  }
  write_packing_file(folder / "s.h5", packing, {});
  // Files of this command end after one block, as on a full disk.
  const Outcome outcome = run_command(fmt::format("trap '' XFSZ; ulimit -f 1; '{}' export '{}' -o '{}'", MPFEM_PACK_GEN,
                                                  folder / "s.h5", folder / "s.csv"));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 4);
  CHECK(outcome.one_error_line("pack-gen"));
  CHECK_FALSE(std::filesystem::exists(folder / "s.csv"));
  CHECK_FALSE(std::filesystem::exists(std::filesystem::symlink_status(folder / "s.csv.partial")));
}

TEST_CASE("a table goes to standard output or a FIFO, a packing to neither") {
  const Folder folder;
  write_packing_file(folder / "s.h5", {.box = {1, 1, 1}, .center = {{0.3, 0.5, 0.5}}, .radius = {0.25}}, {});
  const std::string table = "x [mm],y [mm],z [mm],radius [mm]\n0.3,0.5,0.5,0.25\n";
  const Outcome to_output = pack_gen(fmt::format("export {} -o /dev/stdout", folder / "s.h5"));
  CHECK(to_output.exit_code == 0);
  CHECK(to_output.output == table);
  CHECK(run_command(fmt::format("'{}' export '{}' -o /dev/stdout | cat", MPFEM_PACK_GEN, folder / "s.h5")).output ==
        table);
  REQUIRE(mkfifo((folder / "fifo").c_str(), 0600) == 0);
  const Outcome to_fifo = run_command(
      fmt::format("cat '{0}' & '{1}' export '{2}' -o '{0}'; wait", folder / "fifo", MPFEM_PACK_GEN, folder / "s.h5"));
  CHECK(to_fifo.exit_code == 0);
  CHECK(to_fifo.output == table);
  const Outcome packing = pack_gen(fmt::format("mesh {} --size 0.1 -o {}", folder / "s.h5", folder / "fifo"));
  CHECK(packing.exit_code == 2);
  CHECK(packing.one_error_line("pack-gen"));
  CHECK_THAT(packing.messages, Catch::Contains("found a FIFO, allowed: a file"));
  CHECK(std::filesystem::is_fifo(folder / "fifo"));
}

TEST_CASE("a packing with meaningless values is refused, and the message names them") {
  const Folder folder;
  write_packing_file(folder / "s.h5", {.box = {1, 1, 1}, .center = {{0.3, 0.5, 0.5}}, .radius = {-0.25}}, {});
  for (const std::string& arguments : {fmt::format("mesh {} --size 0.1 -o {}", folder / "s.h5", folder / "p.h5"),
                                       fmt::format("export {} -o {}", folder / "s.h5", folder / "s.csv")}) {
    const Outcome outcome = pack_gen(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages,
               Catch::Contains("s.h5: dataset /spheres/radius: found -0.25 at index 0, allowed: finite and > 0"));
  }
}

TEST_CASE("quality reports named numbers, a table of sizes, and their distance from the description") {
  const Folder folder;
  write_text(folder / "pack.toml", description);
  REQUIRE(pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5")).exit_code == 0);
  REQUIRE(pack_gen(fmt::format("mesh {} --size 0.05 -o {} --quiet", folder / "s.h5", folder / "p.h5")).exit_code == 0);
  const std::string quality = "quality " + (folder / "p.h5");
  REQUIRE(pack_gen(fmt::format("{} --quiet -o {} --description {} --sizes {} --target {}", quality, folder / "q.json",
                               folder / "pack.toml", folder / "sizes.csv", folder / "target.csv"))
              .exit_code == 0);
  const std::string json = read_text(folder / "q.json");
  CHECK_THAT(json, Catch::Contains("\"grains\": 11,"));
  const auto number = [&](const std::string& key) {
    return std::stod(json.substr(json.find("\"" + key + "\": ") + key.size() + 4));
  };
  CHECK(number("relative_density") == Approx(0.3).epsilon(1e-12));
  CHECK(number("smallest_gap_mm") >= 0.002 * (1 - 1e-9));
  CHECK(number("smallest_facet_gap_mm") > 0);
  CHECK(number("size_distance") > 0);
  CHECK(number("size_distance") < 0.2); // sizes were scaled to reach the density
  CHECK(number("tets_per_grain") == Approx(number("tets") / 11).epsilon(1e-12));
  CHECK(read_text(folder / "target.csv") == "diameter_mm,cumulative_number\n0.1,0\n0.2,1\n");
  const std::string sizes = read_text(folder / "sizes.csv");
  CHECK(std::count(sizes.begin(), sizes.end(), '\n') == 12);
  CHECK_THAT(sizes, Catch::EndsWith("0.954545455\n")); // 10.5/11
  // Sizes that are radii, from a file.
  write_text(folder / "radii.csv", "size [mm],cumulative [1]\n0.05,0\n0.1,1\n");
  write_text(folder / "pack.toml", replaced(replaced(description, "\"diameter\"", "\"radius\""),
                                            "values = [0.1, 0.2]\ncumulative = [0, 1]", "file = \"radii.csv\""));
  REQUIRE(pack_gen(fmt::format("{} --quiet --description {} --target {}", quality, folder / "pack.toml",
                               folder / "radii-target.csv"))
              .exit_code == 0);
  CHECK(read_text(folder / "radii-target.csv") == read_text(folder / "target.csv"));
  const Outcome refused = pack_gen(quality + " --target x.csv");
  CHECK(refused.exit_code == 2);
  CHECK_THAT(refused.messages, Catch::Contains("--description"));
}
