// Spheres in a closed surface of triangles, by the command as a user gives it.

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "pack-gen/sphere_file.hpp"
#include "results-schema/file.hpp"
#include "run_pack_gen.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/triangle_meshes.hpp"

using mpfem::read_spheres;
using mpfem::SpherePacking;
using namespace mpfem::test;

namespace {

/// An L of 0.5 x 0.5 mm less a quarter, 0.3 mm high, somewhere in space; in metres.
void write_l_shape(const std::string& path) {
  LooseTriangles body = prism(l_shape, 0, 1);
  for (auto& triangle : body)
    for (auto& x : triangle) x = {1e-3 * (3 + 0.25 * x.x), 1e-3 * (-2 + 0.25 * x.y), 1e-3 * (0.3 * x.z + 7)};
  write_text(path, text_stl(body));
}

const std::string l_description = R"(count = 30
relative_density = 0.4
container = "surface"
surface_file = "l.stl"
surface_scale = 1000
smallest_gap = 0.001
size_scale_tolerance = 1
[size_distribution]
kind = "table"
measure = "diameter"
weight = "number"
values = [0.08, 0.12]
cumulative = [0, 1]
)";

/// mm, of a point inside the L from its walls.
double inside_l(const mpfem::Point& p) {
  const double walls = std::min({p[0], p[1], p[2], 0.5 - p[0], 0.5 - p[1], 0.3 - p[2]});
  const double x = 0.25 - p[0], y = 0.25 - p[1]; // of the corner that points inwards
  return std::min(walls, x > 0 && y > 0 ? std::hypot(x, y) : std::max(x, y));
}

} // namespace

TEST_CASE("a surface from an STL file is filled, meshed, exported and imported with its volume") {
  const Folder folder;
  write_l_shape(folder / "l.stl");
  write_text(folder / "pack.toml", l_description);
  const Outcome filled = pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5"));
  INFO(filled.messages);
  REQUIRE(filled.exit_code == 0);
  const Outcome meshed =
      pack_gen(fmt::format("mesh {} --size 0.03 -o {} --threads 1 --quiet", folder / "s.h5", folder / "p.h5"));
  INFO(meshed.messages);
  REQUIRE(meshed.exit_code == 0);
  for (const char* name : {"s.h5", "p.h5"}) {
    CHECK(mpfem::schema::validate(folder / name).empty());
    const SpherePacking packing = read_spheres(folder / name).packing;
    REQUIRE(packing.shape == mpfem::ContainerShape::surface);
    for (std::size_t k = 0; k < 3; ++k) CHECK(packing.box[k] == Approx(k == 2 ? 0.3 : 0.5).epsilon(1e-9));
    CHECK(relative_density(packing) == Approx(0.4).epsilon(1e-9));
    double smallest = 1;
    for (std::size_t i = 0; i < packing.radius.size(); ++i)
      smallest = std::min(smallest, inside_l(packing.center[i]) - packing.radius[i]);
    CHECK(smallest >= 0.001 * (1 - 1e-6)); // the file's numbers are of 16 digits, but metres
    CHECK(smallest_gap(packing).gap >= 0.001 * (1 - 1e-6));
  }
  // No node of the mesh is beyond the surface.
  const mpfem::schema::FileReader file(folder / "p.h5");
  const auto node = file.read(mpfem::schema::packing::mesh_node);
  double nearest = 1;
  for (std::size_t i = 0; i < node.size(); i += 3)
    nearest = std::min(nearest, inside_l({node[i], node[i + 1], node[i + 2]}));
  CHECK(nearest > 0);
  CHECK(file.read_scalar(mpfem::schema::packing::mesh_smallest_facet_gap) <= nearest * (1 + 1e-9));

  // A table in the coordinates of the STL file.
  const SpherePacking first = read_spheres(folder / "s.h5").packing;
  std::string table = "x [mm],y [mm],z [mm],radius [mm]\n";
  for (std::size_t i = 0; i < first.radius.size(); ++i)
    table += fmt::format("{},{},{},{}\n", first.center[i][0] + 3, first.center[i][1] - 2, first.center[i][2] + 7,
                         first.radius[i]);
  write_text(folder / "s.csv", table);
  const auto import = [&](const std::string& options) {
    return pack_gen(fmt::format("import {} {} -o {}", folder / "s.csv", options, folder / "again.h5"));
  };
  const std::string surface = fmt::format("--container surface --surface {}", folder / "l.stl");
  const Outcome imported = import(surface + " --scale 1000");
  INFO(imported.messages);
  REQUIRE(imported.exit_code == 0);
  const SpherePacking again = read_spheres(folder / "again.h5").packing;
  for (std::size_t i = 0; i < first.radius.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(again.center[i][k] - first.center[i][k]) < 1e-12);

  const Outcome outside = import(surface + " --scale 900"); // the L is smaller and elsewhere
  CHECK(outside.exit_code == 2);
  CHECK_THAT(outside.messages, Catch::Contains("l.stl spans 0.45 x 0.45 x 0.27 mm with --scale = 900, the spheres 0."));
  CHECK(outside.one_error_line("pack-gen"));
  CHECK(import(surface).exit_code == 2); // without a scale
  CHECK(import("--surface l.stl --scale 1").exit_code == 2);
  CHECK(import(surface + " --scale 1000 --box 1,1,1").exit_code == 2);
  const Outcome fitted = pack_gen(fmt::format("settle {} --fit-height -o {}", folder / "s.h5", folder / "b.h5"));
  CHECK(fitted.exit_code == 2);
  CHECK_THAT(fitted.messages, Catch::Contains("height"));
}

TEST_CASE("spheres settle in a surface from an STL file, within its walls") {
  const Folder folder;
  write_l_shape(folder / "l.stl");
  write_text(folder / "pack.toml", l_description);
  REQUIRE(pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5")).exit_code == 0);
  const Outcome outcome = pack_gen(fmt::format("settle {} -o {}", folder / "s.h5", folder / "b.h5"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  const SpherePacking loose = read_spheres(folder / "s.h5").packing, bed = read_spheres(folder / "b.h5").packing;
  REQUIRE(bed.surface);
  CHECK(bed.radius == loose.radius);
  CHECK(smallest_gap(bed).gap >= 0.001 * (1 - 1e-6));
  double before = 0, after = 0;
  for (std::size_t i = 0; i < bed.radius.size(); ++i) {
    CHECK(inside_l(bed.center[i]) - bed.radius[i] >= 0.001 * (1 - 1e-6));
    before += loose.center[i][2];
    after += bed.center[i][2];
  }
  CHECK(after < before);
}

TEST_CASE("surfaces that are open, too small or without a scale are not filled") {
  const Folder folder;
  write_l_shape(folder / "l.stl");
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = l_description;
    text.replace(text.find(from), from.size(), to);
    write_text(folder / "pack.toml", text);
    const Outcome outcome = pack_gen(fmt::format("spheres {} --quiet -o {}", folder / "pack.toml", folder / "s.h5"));
    CHECK(outcome.exit_code == 2);
    CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), '\n') <= 1);
    return outcome.messages;
  };
  CHECK_THAT(refusal("surface_scale = 1000\n", ""), Catch::Contains("surface_scale"));
  CHECK_THAT(refusal("surface_file = \"l.stl\"\n", ""), Catch::Contains("surface_file"));
  CHECK_THAT(refusal("\"surface\"", "\"cylinder\""), Catch::Contains("surface_file"));
  CHECK_THAT(refusal("surface_scale = 1000", "surface_scale = 1000\nbox = [1, 1, 1]"), Catch::Contains("box"));
  CHECK_THAT(refusal("relative_density = 0.4", "relative_density = 0.7"), Catch::Contains("jam"));
  LooseTriangles open = prism(l_shape, 0, 1);
  open.pop_back();
  write_text(folder / "open.stl", text_stl(open));
  CHECK_THAT(refusal("l.stl", "open.stl"), Catch::Contains("open.stl"));
}

TEST_CASE("a surface in other units than its scale is refused with its size, that which is needed, and the scale") {
  const Folder folder;
  write_l_shape(folder / "l.stl");
  for (const auto& [scale, length] : {std::pair("1", "0.0005 x 0.0005 x 0.0003 mm"), {"1e6", "500 x 500 x 300 mm"}}) {
    std::string text = l_description;
    text.replace(text.find("1000"), 4, scale);
    text.replace(text.find("tolerance = 1"), 13, "tolerance = 0.5");
    write_text(folder / "pack.toml", text);
    const Outcome outcome = pack_gen(fmt::format("spheres {} -o {}", folder / "pack.toml", folder / "s.h5"));
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains(fmt::format("l.stl spans {} with surface_scale = ", length)));
    CHECK_THAT(outcome.messages, Catch::Contains("the spheres need 0.") && Catch::Contains("surface_scale is the mm"));
  }
}

TEST_CASE("spheres that are lost in a surface far larger than they are imported with a warning that names the scale") {
  const Folder folder;
  write_text(folder / "cube.stl", text_stl(moved(unit_cube(), {-0.5, -0.5, -0.5})));
  write_text(folder / "s.csv", "x,y,z,radius\n0,0,0,0.1\n0.25,0,0,0.1\n");
  for (const auto& [scale, is_implausible] : {std::pair("1", false), {"25.4", true}, {"1000", true}}) {
    const Outcome outcome = pack_gen(fmt::format("import {} --container surface --surface {} --scale {} -o {}",
                                                 folder / "s.csv", folder / "cube.stl", scale, folder / "s.h5"));
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 0);
    CHECK((outcome.messages.find("warning: ") != std::string::npos) == is_implausible);
    if (is_implausible)
      CHECK_THAT(outcome.messages,
                 Catch::Contains(fmt::format("with --scale = {}, the spheres 0.45 x 0.2 x 0.2 mm", scale)));
  }
}
