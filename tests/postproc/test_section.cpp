// Plane sections against areas known beforehand, and the picture made of them.

#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "postproc/drawing/section_picture.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

Snapshot snapshot_of(const GrainMesh& mesh) {
  Snapshot s;
  for (const auto& x : mesh.node)
    for (const double c : x) s.node.push_back(static_cast<float>(c));
  for (const auto& tet : mesh.tet) s.tet.insert(s.tet.end(), tet.begin(), tet.end());
  s.tet_grain.assign(mesh.tet.size(), 0);
  s.tet_fields = {{"von_mises", "MPa", std::vector<float>(mesh.tet.size(), 1.0F)}};
  s.box_low = {-1.5, -1.5, -1.5};
  s.box_high = {1.5, 1.5, 1.5};
  return s;
}

double total_area(const std::vector<SectionPolygon>& polygons) {
  return std::accumulate(polygons.begin(), polygons.end(), 0.0,
                         [](double sum, const auto& p) { return sum + area(p); });
}

} // namespace

TEST_CASE("the section of a tetrahedron has the area of its similar triangle, or of its parallelogram") {
  Snapshot s = snapshot_of({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}});
  for (const double z : {0.1, 0.5, 0.9}) // (1 - z)^2 / 2
    for (int axis = 0; axis < 3; ++axis)
      CHECK(total_area(cut(s, {axis, z})) == Approx(0.5 * (1 - z) * (1 - z)).epsilon(1e-6));
  CHECK(cut(s, {2, 1.01}).empty());
  CHECK(cut(s, {2, -0.01}).empty());
  // Two nodes on either side: edges along x below, along y above; a rectangle, half the lengths half way.
  s = snapshot_of({{{-1, 0, 0}, {1, 0, 0}, {0, -1, 1}, {0, 1, 1}}, {{0, 1, 3, 2}}});
  const auto quad = cut(s, {2, 0.25});
  REQUIRE(quad.size() == 1);
  CHECK(quad[0].corners == 4);
  CHECK(area(quad[0]) == Approx(2 * 0.75 * 2 * 0.25).epsilon(1e-6));
}

TEST_CASE("the sections of a cube's tets fill its square once for any position of the plane") {
  const Snapshot s = snapshot_of(cube_mesh(4));
  for (int axis = 0; axis < 3; ++axis)
    for (const double position : {-0.99, -0.5, -0.1234, 0.0, 0.3, 0.5, 0.77}) // some of them through layers of nodes
      CHECK(total_area(cut(s, {axis, position})) == Approx(4).epsilon(1e-6));
}

TEST_CASE("the section of a rotated ball has the area of its circle within the mesh's error") {
  GrainMesh ball = ball_mesh(16, 1);
  rotate(ball, {0.6, 0, 0.8}, 1.1);
  const Snapshot s = snapshot_of(ball);
  for (const double z : {0.0, 0.4, 0.8}) // facets lie inside the sphere: relative sagitta some (pi/32)^2/2
    CHECK(total_area(cut(s, {2, z})) == Approx(M_PI * (1 - z * z)).epsilon(0.02));
}

TEST_CASE("a raster shows the section where it is, and nothing elsewhere") {
  const Snapshot s = snapshot_of(cube_mesh(2));
  const std::vector<Colour> red(s.tets(), Colour{200, 0, 0});
  const Raster raster = draw_section(cut(s, {2, 0.1}), red, s.tet_grain, {{-1.5, -1.5}, {1.5, 1.5}}, 300);
  REQUIRE(raster.width == 300);
  REQUIRE(raster.height == 300);
  const auto at = [&](int x, int y) { return raster.pixel[static_cast<std::size_t>(y * 300 + x)]; };
  CHECK(at(150, 150) == Colour{200, 0, 0});
  CHECK(at(60, 150) == Colour{200, 0, 0}); // 0.1 inside the left edge at pixel 50
  CHECK(at(20, 150) == Colour{255, 255, 255});
  CHECK(at(50, 150)[0] < 100); // the outline
  std::size_t filled = 0;
  for (const Colour& pixel : raster.pixel) filled += pixel != Colour{255, 255, 255};
  CHECK(static_cast<double>(filled) == Approx(200.0 * 200.0).epsilon(0.03));
}

TEST_CASE("a section's picture is written as PNG, its polygons as CSV") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const Outcome outcome = run_command(
      fmt::format("'{}' section {} --field von-mises -o {} --data {} --pixels 200 --title 'a \"quoted\" title'",
                  MPFEM_POSTPROC, folder / "run.h5", folder / "s.png", folder / "s.csv"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.messages.empty());
  CHECK(read_text(folder / "s.png").substr(1, 3) == "PNG");
  const std::string csv = read_text(folder / "s.csv");
  CHECK(csv.starts_with("tet [1],grain [1],von_mises [MPa],area [mm^2],u [mm],v [mm]\n"));
  double sum = 0;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int i = 0; i < 4; ++i) std::getline(cells, cell, ',');
    sum += std::stod(cell);
  }
  CHECK(sum == Approx(4).epsilon(1e-6));
}

TEST_CASE("where grains have left the box, the message says where the plane cuts them, and that view shows them") {
  const Folder folder;
  RunContents contents = small_run();
  for (std::size_t axis = 0; axis < 2; ++axis) { // the plane is normal to the third axis
    contents.numbers["/snapshots/*/box_low"][axis] -= 100;
    contents.numbers["/snapshots/*/box_high"][axis] -= 100;
  }
  write_run(folder / "run.h5", contents);
  const std::string section = fmt::format("section {} --pixels 100 -o {}", folder / "run.h5", folder / "s.png");
  const Outcome refused = run_command(fmt::format("'{}' {}", MPFEM_POSTPROC, section));
  INFO(refused.messages);
  CHECK(refused.exit_code == 2);
  CHECK(refused.one_error_line("postproc"));
  CHECK_THAT(refused.messages, Catch::Contains("snapshot 0000: no grain is cut in -101.5 … ") &&
                                   Catch::Contains("which lie in -1 … 1, -1 … 1 mm"));
  CHECK(run_command(fmt::format("'{}' {} --view=-1,1,-1,1", MPFEM_POSTPROC, section)).exit_code == 0);
}

TEST_CASE("the colour scale gets lighter from end to end") {
  double last = -1;
  for (int i = 0; i <= 50; ++i) {
    const Colour c = scale_colour(i / 50.0);
    const double luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
    CHECK(luminance > last);
    last = luminance;
  }
  CHECK(scale_colour(-5) == scale_colour(0));
  CHECK(scale_colour(7) == scale_colour(1));
  const Colour none = scale_colour(std::nan("")); // grey, which the scale does not have
  CHECK((none[0] == none[1] && none[1] == none[2]));
}

TEST_CASE("a picture is drawn even if some values are not finite") {
  const Folder folder;
  RunContents contents = small_run();
  write_run(folder / "run.h5", contents);
  contents.numbers["/snapshots/*/von_mises"][40] = std::nan("");
  write_run(folder / "nan.h5", contents);
  for (const char* name : {"run", "nan"})
    REQUIRE(run_command(
                fmt::format("'{}' section {}.h5 --pixels 100 -o {}.png", MPFEM_POSTPROC, folder / name, folder / name))
                .exit_code == 0);
}

TEST_CASE("a meshed packing is cut and exported without a run") {
  const Folder folder;
  const MeshedPacking packing = eight_grains(6);
  write_packing(folder / "packing.h5", packing, std::vector<double>(8, 0.1));
  const Snapshot s = read_packing_snapshot(folder / "packing.h5");
  REQUIRE(s.tet_field("grain").values.back() == 7);
  const double z = packing.node[2]; // through the first grain
  const auto polygons = cut(s, {2, z});
  REQUIRE_FALSE(polygons.empty());
  CHECK(run_command(fmt::format("'{}' section --packing {} --axis z --position {} -o {} --pixels 100", MPFEM_POSTPROC,
                                folder / "packing.h5", z, folder / "p.png"))
            .exit_code == 0);
  CHECK(read_text(folder / "p.png").substr(1, 3) == "PNG");
  CHECK(run_command(fmt::format("'{}' section --packing {} --field pressure -o {}", MPFEM_POSTPROC,
                                folder / "packing.h5", folder / "q.png"))
            .exit_code == 2);
  CHECK(run_command(fmt::format("'{}' vtk --packing {} -o {}", MPFEM_POSTPROC, folder / "packing.h5", folder / "p.vtu"))
            .exit_code == 0);
  CHECK_THAT(read_text(folder / "p.vtu"), Catch::Contains(fmt::format("NumberOfCells=\"{}\"", packing.tet.size() / 4)));
}

TEST_CASE("titles and file names are text, not commands") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const std::string title = fmt::format("`touch {0}` \\\" %s", folder / "made"), file = "it's `touch made`.png";
  const Outcome outcome =
      run_command(fmt::format("cd {} && '{}' section run.h5 --pixels 100 --title '{}' -o \"it's \\`touch made\\`.png\"",
                              folder / "", MPFEM_POSTPROC, title));
  INFO(outcome.messages);
  CHECK(outcome.exit_code == 0);
  CHECK(std::filesystem::exists(folder / file));
  CHECK_FALSE(std::filesystem::exists(folder / "made"));
}
