// Damage of bonds: in sections, in maps of one contact, in tables; against a plane square contact whose values are
// known.

#include <algorithm>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "bonded_run.hpp"
#include "postproc/drawing/contact_picture.hpp"
#include "postproc/drawing/damage_section.hpp"
#include "postproc/drawing/raster.hpp"
#include "postproc/drawing/vtk.hpp"
#include "postproc/metrics/energy.hpp"
#include "postproc/metrics/summary.hpp"
#include "postproc/run_data/contact.hpp"
#include "postproc/run_data/surface_facets.hpp"
#include "run_postproc.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// The cells of a CSV text without its heading.
std::vector<std::vector<double>> rows_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    std::istringstream cells(line);
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

double length(const BoundarySegment& s) {
  return std::hypot(s.to[0] - s.from[0], s.to[1] - s.from[1]);
}

double cross(const SectionPolygon& p, std::size_t corner) { // of the edges before and after
  const auto &a = p.corner[corner], &b = p.corner[(corner + 1) % 4], &c = p.corner[(corner + 2) % 4];
  return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
}

// Positions are stored in single precision: 1e-6 of the lengths of some mm here.
constexpr double single = 1e-6;

} // namespace

TEST_CASE("the bonded file of these tests follows the schema, with and without its bonds") {
  const Folder folder;
  write_run(folder / "bonded.h5", bonded_run());
  write_run(folder / "plain.h5", small_run());
  CHECK(schema::validate(folder / "bonded.h5").empty());
  CHECK(schema::validate(folder / "plain.h5").empty());
}

TEST_CASE("the outer facets of a cube are its six faces, seen from outside") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const Snapshot s = read_snapshot(schema::FileReader(folder / "run.h5"), -1);
  const auto facets = surface_facets(s, tets_of_grain(s, 1)); // the cube about (2, 0, 0)
  CHECK(facets.size() == 6 * 2 * cube_cells * cube_cells);
  double volume = 0; // of the divergence theorem: positive where the facets look outward
  for (const SurfaceFacet& facet : facets) {
    CHECK(facet.grain == 1);
    double x[3][3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        x[i][k] = static_cast<double>(s.node[3 * static_cast<std::size_t>(facet.node[i]) + k]);
    volume += (x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) - x[0][1] * (x[1][0] * x[2][2] - x[1][2] * x[2][0]) +
               x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0])) /
              6;
  }
  CHECK(volume == Approx(8).epsilon(single));
}

TEST_CASE("the plane of a contact goes through the area centroid, across the force") {
  const std::vector<AreaPoint> points = {{{0, 0, 0}, 1}, {{3, 0, 0}, 2}, {{0, 3, 0}, 3}};
  using From = ContactPlane::NormalFrom;
  const ContactPlane plane = contact_plane(points, {0, 0, -7}, {0, 0, 1});
  CHECK(plane.from == From::force);
  CHECK(within(plane.origin[0], 1, rounding));
  CHECK(within(plane.origin[1], 1.5, rounding));
  CHECK(plane.normal ==
        std::array<double, 3>{0, 0, 1}); // from the first grain to the second, whatever the force's sense
  CHECK(plane.u == std::array<double, 3>{1, 0, 0});
  CHECK(plane.v == std::array<double, 3>{0, 1, 0});
  const auto position = in_plane(plane, {2, 2, 5});
  CHECK(within(position[0], 1, rounding));
  CHECK(within(position[1], 0.5, rounding));
  CHECK(within(position[2], 5, rounding));

  // A force 20 degrees off is taken as it is; one of 80 degrees is a shear force, and the points say where the plane
  // is.
  const auto tilted = [&](double degrees) {
    const double angle = degrees * M_PI / 180;
    return contact_plane(points, {5 * std::sin(angle), 0, 5 * std::cos(angle)}, {0, 0, -1});
  };
  CHECK(tilted(20).from == From::force);
  CHECK(within(tilted(20).normal[2], -std::cos(20 * M_PI / 180), rounding));
  CHECK(tilted(80).from == From::points);
  CHECK(within(tilted(80).normal[2], -1, rounding));
  CHECK(contact_plane(points, {0, 0, 0}, {0.5, 0, 1}).from == From::points);
  // Points on a line span no plane; without a force the grains' centres give the direction.
  const ContactPlane line = contact_plane({{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}}, {0, 0, 0}, {0, 2, 0});
  CHECK(line.from == From::centres);
  CHECK(line.normal == std::array<double, 3>{0, 1, 0});
}

TEST_CASE("the map of a plane square contact has its centroid, coordinates, areas and mean damage") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const std::string run = folder / "run.h5";
  const ContactMap map = contact_map(schema::FileReader(run), -1, {1, 0}); // in either order
  CHECK(map.grains == std::pair{0, 1});
  CHECK(map.plane.normal == std::array<double, 3>{1, 0, 0});
  CHECK(map.plane.u == std::array<double, 3>{0, 1, 0}); // y, as in sections
  CHECK(map.plane.v == std::array<double, 3>{0, 0, 1});
  CHECK(map.plane.origin[0] == Approx(1).epsilon(single));
  CHECK(map.plane.origin[1] == Approx(0).margin(single));
  CHECK(map.plane.origin[2] == Approx(0).margin(single));
  REQUIRE(map.bonds.size() == 2 * (cube_cells + 1) * (cube_cells + 1)); // none of grain 2
  double area[2] = {}, damage = 0;
  for (const ContactBond& bond : map.bonds) {
    REQUIRE((bond.grain == 0 || bond.grain == 1));
    area[bond.grain] += bond.area;
    damage += bond.area * bond.damage;
    CHECK(bond.u == Approx(bond.x[1]).margin(single));
    CHECK(bond.v == Approx(bond.x[2]).margin(single));
    CHECK(bond.damage == Approx(damage_at(bond.u)).margin(single));
    CHECK(bond.opening == Approx(0.001 * (bond.u + 1)).margin(single));
    CHECK(within(bond.sliding, 0.002, single));
  }
  CHECK(within(area[0], 4, rounding));
  CHECK(within(area[1], 4, rounding));
  CHECK(damage / (area[0] + area[1]) == Approx(map.damage).epsilon(single)); // as the file says of the pair

  const Outcome outcome =
      postproc(fmt::format("contact {} --pair 0,1 -o {} --data {}", run, folder / "c.json", folder / "c.csv"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(folder / "c.json"));
  CHECK(json["grains"] == nlohmann::json({0, 1}));
  CHECK(json["force_on_first_N"] == nlohmann::json({-10.0, 0.0, 0.0}));
  CHECK(json["normal_force_N"] == 10);
  CHECK(json["normal_from"] == "pair force");
  CHECK(json["area_mm2"] == 4);
  CHECK(json["bonded_area_mm2"] == 3.5);
  CHECK(json["mean_damage"] == 0.5);
  CHECK(json["bond_energy_mJ"] == 0.25);
  CHECK(json["damage_dissipation_mJ"] == 0.75);
  CHECK(json["bonds"] == 50);
  CHECK(json["unbroken_bonds"] == 40); // those at y = 1 are broken: five on either side
  const std::string csv = read_text(folder / "c.csv");
  CHECK(csv.starts_with("node [1],grain [1],x [mm],y [mm],z [mm],u [mm],v [mm],damage [1],area [mm^2],opening "
                        "[mm],sliding [mm]\n"));
  const auto rows = rows_of(csv);
  REQUIRE(rows.size() == map.bonds.size());
  for (std::size_t b = 0; b < rows.size(); ++b) {
    REQUIRE(rows[b].size() == 11);
    CHECK(rows[b][0] == map.bonds[b].node);
    CHECK(rows[b][2] == 1); // x
    CHECK(rows[b][7] == map.bonds[b].damage);
  }
}

TEST_CASE("the patches of a contact fill the bonded square once, each its node's share") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const schema::FileReader file(folder / "run.h5");
  const ContactMap map = contact_map(file, -1, {0, 1});
  const Snapshot s = read_snapshot(file, -1);
  double on_face = 0, damage = 0;
  for (const SectionPolygon& patch : contact_patches(s, map)) {
    const auto bond = map.bonds.at(static_cast<std::size_t>(patch.tet));
    CHECK(bond.grain == 0);
    for (std::size_t i = 0; i < 4; ++i)
      CHECK(cross(patch, i) * cross(patch, (i + 1) % 4) >= -single); // convex, which the raster needs
    on_face += area(patch); // facets on the cube's other faces stand on edge: no area in this plane
    damage += area(patch) * bond.damage;
  }
  CHECK(on_face == Approx(4).epsilon(10 * single));
  // The patches' shares of corner nodes depend on the mesh's diagonals; damage is linear in y and the mesh the same
  // turned by half a turn, so the mean is a half all the same.
  CHECK(damage / on_face == Approx(0.5).epsilon(10 * single));
}

TEST_CASE("a section's damage follows the bonded sides and their linear rise") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const Snapshot s = read_snapshot(schema::FileReader(folder / "run.h5"), -1);
  // z = 0.3: squares of 2 mm of grains 0 and 1; the bonded sides at x = 1. (Grain 2 begins at z = 1.)
  const auto segments = cut_boundaries(s, {2, 0.3});
  double perimeter = 0, on_side = 0, beyond = 0, integral = 0;
  for (const BoundarySegment& segment : segments) {
    REQUIRE((segment.grain == 0 || segment.grain == 1));
    perimeter += length(segment);
    REQUIRE((segment.damage_from >= 0) == (segment.damage_to >= 0));
    const bool side = std::abs(segment.from[0] - 1) < single && std::abs(segment.to[0] - 1) < single;
    if (side) {
      on_side += length(segment);
      integral += 0.5 * (segment.damage_from + segment.damage_to) * length(segment);
      CHECK(segment.damage_from == Approx(damage_at(segment.from[1])).margin(single));
      CHECK(segment.damage_to == Approx(damage_at(segment.to[1])).margin(single));
    } else if (segment.damage_from >= 0) {
      beyond += length(segment);
    }
  }
  CHECK(perimeter == Approx(16).epsilon(single));
  CHECK(on_side == Approx(4).epsilon(single)); // 2 mm on either grain
  CHECK(integral == Approx(0.5 * 4).epsilon(single));
  // Round the corner the bonded nodes' damage holds as far as half way to the next nodes, on two faces of either grain;
  // the cut facets' diagonals bring it nearer or farther, but not beyond the first cell.
  CHECK(beyond > 0);
  CHECK(beyond < 4 * 2.0 / cube_cells);

  const std::string run = folder / "run.h5";
  const Outcome outcome = postproc(fmt::format("section {} --position 0.3 --field damage -o {} --data {} --pixels 300",
                                               run, folder / "s.png", folder / "s.csv"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  CHECK(read_text(folder / "s.png").substr(1, 3) == "PNG");
  const std::string csv = read_text(folder / "s.csv");
  CHECK(csv.starts_with("grain [1],u_1 [mm],v_1 [mm],u_2 [mm],v_2 [mm],length [mm],damage_1 [1],damage_2 [1]\n"));
  const auto rows = rows_of(csv);
  REQUIRE(rows.size() == segments.size());
  double sum = 0;
  for (const auto& row : rows) sum += row.at(5);
  CHECK(within(sum, perimeter, rounding));
}

TEST_CASE("a band is painted inside its own grain, in the colour of its place") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const Snapshot s = read_snapshot(schema::FileReader(folder / "run.h5"), -1);
  const View view{{0, -1}, {2, 1}}; // 100 pixels a mm: the contact is column 100
  Lines lines;
  lines.band_pixels = 6;
  lines.bands = {{{1, -1}, {1, 1}, 0, 1, 0}}; // of grain 0 only
  constexpr Colour grey{232, 232, 232};
  const Raster raster =
      draw_section(cut(s, {2, 0.3}), std::vector<Colour>(s.tets(), grey), s.tet_grain, view, 200, lines);
  const auto at = [&](std::size_t x, std::size_t y) { return raster.pixel.at(y * 200 + x); };
  for (const std::size_t row : {std::size_t{40}, std::size_t{150}}) { // y = 0.595, -0.505
    const Colour expected = scale_colour(damage_at(1 - (static_cast<double>(row) + 0.5) / 100));
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(at(97, row)[c] - expected[c]) <= 2); // the scale over a pixel
    CHECK(at(90, row) == grey);
    CHECK(at(104, row) == grey);
  }
}

TEST_CASE("pictures of damage are drawn") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const Outcome outcome = postproc(fmt::format("contact {} --pair 0,1 --view {} --mesh --pixels 200 --title 'a b'",
                                               folder / "run.h5", folder / "c.png"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  CHECK(read_text(folder / "c.png").substr(1, 3) == "PNG");
  CHECK(nlohmann::json::parse(outcome.output)["bonds"] == 50); // JSON on standard output where -o is not given
}

TEST_CASE("a touching pair that never had a bond has a map without points") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const Outcome outcome = postproc(fmt::format("contact {} --pair 0,2", folder / "run.h5"));
  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(outcome.output);
  CHECK(json["bonds"] == 0);
  CHECK(json["mean_damage"].is_null());
  CHECK(json["centroid_mm"].is_null());
  CHECK(json["normal"] == nlohmann::json({0.0, 0.0, 1.0}));
  CHECK(json["normal_force_N"] == 1);
}

TEST_CASE("the .vtu file has the damage of nodes where the run has it") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  write_run(folder / "plain.h5", small_run());
  const schema::FileReader file(folder / "run.h5");
  const Snapshot s = read_snapshot(file, -1);
  const Field& damage = s.node_field("damage");
  REQUIRE(damage.values.size() == s.nodes());
  CHECK(damage.values.front() == -1); // the corner (-1, -1, -1)
  const std::string vtu = vtu_text(s);
  const std::size_t points = vtu.find("<PointData>"), cells = vtu.find("<CellData>"), at = vtu.find("Name=\"damage\"");
  CHECK((points < at && at < cells));
  const std::string bytes(reinterpret_cast<const char*>(damage.values.data()), damage.values.size() * sizeof(float));
  const std::size_t offset = std::stoul(vtu.substr(vtu.find("offset=\"", at) + 8));
  const std::size_t data = vtu.find("\n_") + 2 + offset + sizeof(std::uint64_t);
  CHECK(vtu.substr(data, bytes.size()) == bytes);
  const Snapshot plain = read_snapshot(schema::FileReader(folder / "plain.h5"), -1);
  CHECK(vtu_text(plain).find("damage") == std::string::npos);
}

TEST_CASE("the contact table, energy balance and summary report bonds of a run that has them, and only of such a run") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  write_run(folder / "plain.h5", small_run());
  const schema::FileReader file(folder / "run.h5"), plain(folder / "plain.h5");
  const ContactTable table = contact_table(file, -1);
  REQUIRE(table.columns.size() == 12);
  const std::vector<std::pair<std::string, std::vector<double>>> expected = {
      {"bonded_area", {3.5, 0}}, {"damage", {0.5, -1}}, {"bond_energy", {0.25, 0}}, {"damage_dissipation", {0.75, 0}}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(table.columns[8 + i].name == expected[i].first);
    CHECK(table.columns[8 + i].values == expected[i].second);
  }
  CHECK(to_json(table)["columns"]["bonded_area [mm^2]"] == nlohmann::json({3.5, 0.0}));
  CHECK(contact_table(plain, -1).columns.size() == 8);

  for (const Column& column : energy_ledger(HistoryTable(file))) {
    if (column.name == "bond_energy") CHECK(column.values == std::vector<double>{0, 0.5, 0.25});
    if (column.name == "damage_dissipation") CHECK(column.values == std::vector<double>{0, 0.25, 0.75});
  }
  const Summary summary = summarise(file);
  REQUIRE(summary.bonds.has_value());
  CHECK(summary.bonds->unbroken == 40);
  CHECK(summary.bonds->area == 7);
  CHECK(summary.bonds->mean_damage == 0.5);
  CHECK(to_json(summary)["unbroken_bonds"] == 40);
  CHECK(to_json(summary)["bonded_area_mm2"] == 7);
  CHECK_THAT(to_text(summary), Catch::Contains("40  7 mm^2") && Catch::Contains("contact area over surface"));
  CHECK_FALSE(summarise(plain).bonds.has_value());
  CHECK_FALSE(to_json(summarise(plain)).contains("unbroken_bonds"));
  CHECK_THAT(to_text(summarise(plain)), !Catch::Contains("bonds, area"));
}

TEST_CASE("missing bonds, contacts and snapshots are refused with one line and exit code 2") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  write_run(folder / "plain.h5", small_run());
  const std::string run = folder / "run.h5", plain = folder / "plain.h5", picture = folder / "x.png";
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {"contact " + plain + " --pair 0,1 --view " + picture, "snapshot 0000 has no bonds"},
           {"contact " + run + " --pair 1,2 --view " + picture, "not in contact in snapshot 0000; grain 1 touches 0"},
           {"contact " + run + " --pair 0,3 --view " + picture, "allowed: two different ones of 0 … 2"},
           {"contact " + run + " --pair 0,-1 --view " + picture, "allowed: two different ones of 0 … 2"},
           {"contact " + run + " --pair 1,1 --view " + picture, "allowed: two different ones of 0 … 2"},
           {"contact " + run + " --pair 0,2 --view " + picture, "never had a bond"},
           {"contact " + run + " --pair 0,1 --snapshot 5 --view " + picture, "allowed: 0 … 0"},
           {"contact " + run + " --view " + picture, "allowed: --pair FIRST,SECOND"},
           {"contact " + run + " --data " + (folder / "x.csv"), "allowed: --pair FIRST,SECOND"},
           {"contact " + run + " --pair 0,1 -o " + (folder / "x.csv"), "allowed: .json"},
           {"contact " + run + " --pair 0,1 --view " + run, "would overwrite the input"},
           {"section " + plain + " --field damage -o " + picture, "the run has no bonds"},
           {"section " + plain + " --field damage --data " + (folder / "x.csv"), "the run has no bonds"},
           {"section " + run + " --field damag -o " + picture, "grain, damage"}}) {
    const Outcome outcome = postproc(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    CHECK_FALSE(std::filesystem::exists(picture));
    CHECK_FALSE(std::filesystem::exists(folder / "x.csv"));
    CHECK(outcome.output.empty());
  }
  CHECK(postproc("contact " + run + " --pair 0").exit_code == 2);
  CHECK(postproc("contact " + run + " --pair 0,x").exit_code == 2);
  CHECK(schema::validate(run).empty()); // still the run
  const Outcome help = postproc("contact --help");
  CHECK_THAT(help.output, Catch::Contains("--pair 3,17"));
}
