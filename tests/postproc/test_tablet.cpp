// Metrics of tablets on closed forms and on runs that were written down.

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "coverage.hpp"
#include "postproc/files/csv_file.hpp"
#include "postproc/metrics/diametral.hpp"
#include "postproc/metrics/disc_crack.hpp"
#include "postproc/metrics/heckel.hpp"
#include "postproc/metrics/janssen.hpp"
#include "postproc/metrics/tablet.hpp"
#include "postproc/metrics/tablet_shape.hpp"
#include "run_postproc.hpp"
#include "stage_run.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> evenly(int count, double low, double high) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  return values;
}

/// Density by Heckel's law: of the pores, or as it is under pressure of a solid with a bulk modulus.
std::vector<double> heckel_densities(const std::vector<double>& pressure, double yield_pressure, double intercept,
                                     double bulk_modulus = 0) {
  std::vector<double> density;
  for (const double p : pressure) {
    const double pores = 1 - std::exp(-(p / yield_pressure + intercept));
    density.push_back(bulk_modulus > 0 ? pores * (1 + p / bulk_modulus) : pores);
  }
  return density;
}

} // namespace

TEST_CASE("Heckel's window is the straight part of the curve, and its slope the yield pressure put in") {
  std::vector<double> pressure = evenly(200, 0, 120);
  std::vector<double> density = heckel_densities(pressure, 80, 0.6);
  // Below 30 MPa grains rearrange: the curve bends away from the line.
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (pressure[i] < 30) density[i] -= 0.15 * std::pow(1 - pressure[i] / 30, 2);
  const auto fit = heckel_window(pressure, density, {});
  REQUIRE(fit);
  CHECK(within(fit->yield_pressure, 80, 0.02));
  CHECK(std::abs(fit->yield_pressure - 80) <= fit->yield_pressure_uncertainty);
  CHECK(std::abs(fit->intercept - 0.6) < 0.02);
  CHECK(fit->r_squared >= 0.999);
  CHECK(pressure[fit->first] > 15);
  CHECK(fit->last == pressure.size() - 1);
  // On the line itself nothing is left to be uncertain of.
  const auto exact = heckel_line(pressure, heckel_densities(pressure, 80, 0.6), {60, 199});
  REQUIRE(exact);
  CHECK(within(exact->yield_pressure, 80, 1e-10));
  CHECK(exact->yield_pressure_uncertainty < 1e-8);
}

TEST_CASE("rows that unload, or are too dense, belong to no window of Heckel") {
  std::vector<double> pressure = evenly(101, 10, 200);
  std::vector<double> density = heckel_densities(pressure, 40, 0.6); // 0.98 at 132 MPa
  for (int i = 0; i < 50; ++i) {                                     // back on another path
    pressure.push_back(200 - 3.0 * i);
    density.push_back(0.99);
  }
  const auto fit = heckel_window(pressure, density, {});
  REQUIRE(fit);
  CHECK(density[fit->last] <= 0.98);
  CHECK(density[fit->last + 1] > 0.98);
  CHECK(fit->first == 0);
  CHECK_FALSE(heckel_window(pressure, std::vector<double>(pressure.size(), 0.99), {}));
  CHECK_FALSE(heckel_window({}, {}, {}));
}

TEST_CASE("elastic compression of the solid makes yield pressures too small, and is taken away again") {
  // K = 8000 MPa turns 80 into 72 over 40 to 100 MPa, 4167 MPa into 65: densities under load are larger.
  const std::vector<double> pressure = evenly(61, 40, 100);
  for (const auto& [bulk_modulus, seen] : {std::pair{8000.0, 72.0}, {4167.0, 65.0}}) {
    const std::vector<double> density = heckel_densities(pressure, 80, 0.95, bulk_modulus);
    const auto apparent = heckel_line(pressure, density, {0, 60});
    REQUIRE(apparent);
    CHECK(within(apparent->yield_pressure, seen, 0.02));
    std::vector<double> corrected;
    for (std::size_t i = 0; i < pressure.size(); ++i)
      corrected.push_back(density_without_elastic_compression(density[i], pressure[i], bulk_modulus));
    CHECK(within(heckel_line(pressure, corrected, {0, 60})->yield_pressure, 80, 1e-9));
  }
}

TEST_CASE("postproc heckel reads the stage that presses, with and without elastic compression") {
  const Folder folder;
  std::vector<Row> rows;
  const std::vector<double> pressure = evenly(80, 1, 100);
  const std::vector<double> density = heckel_densities(pressure, 80, 0.6, 8000);
  for (std::size_t i = 0; i < pressure.size(); ++i)
    rows.push_back({.axial_stress = pressure[i], .relative_density = density[i]});
  write_run(folder / "run.h5", run_of(rows, "[[stages]]\ntype = \"die_compression\"\nname = \"press\"\n"));
  REQUIRE(
      postproc(fmt::format("heckel {} --bulk-modulus 8000 -o {}", folder / "run.h5", folder / "h.json")).exit_code ==
      0);
  const auto json = nlohmann::json::parse(read_text(folder / "h.json"));
  CHECK(json["unit"] == "MPa");
  CHECK(json["value"].get<double>() < 78);
  CHECK(within(json["mean_yield_pressure_without_elastic_compression_MPa"].get<double>(), 80, 1e-3));
  CHECK(json["mean_yield_pressure_of_present_volumes_MPa"].is_null()); // the run has none
  CHECK(json["window"]["stage_type"] == "die_compression");
  const Outcome refused = postproc(fmt::format("heckel {} --stage 3", folder / "run.h5"));
  CHECK(refused.exit_code == 2);
  CHECK(refused.one_error_line("postproc"));
  const Outcome crooked = postproc(fmt::format("heckel {} --r-squared 1", folder / "run.h5"));
  CHECK(crooked.exit_code == 2);
  CHECK_THAT(crooked.messages, Catch::Contains("--r-squared"));
}

TEST_CASE("Janssen's slices give back the wall friction that was put in") {
  for (const double friction : {0.02, 0.2, 0.6})
    for (const double height : {0.3, 1.0, 4.0}) {
      const double diameter = 2, ratio = 0.45, upper = 120;
      const DieSlice slice{upper, upper * std::exp(-4 * friction * ratio * height / diameter), diameter, height};
      const auto axial = [&](double z) { return slice.lower_stress * std::exp(4 * friction * ratio * z / diameter); };
      // The mean over the height, summed in many slices.
      double sum = 0;
      constexpr int slices = 2000;
      for (int i = 0; i < slices; ++i) sum += axial(height * (i + 0.5) / slices) / slices;
      CHECK(within(mean_axial_stress_in_die(slice), sum, 1e-6));
      CHECK(within(wall_friction(slice, ratio * sum), friction, 1e-6));
    }
  CHECK(mean_axial_stress_in_die({50, 50, 1, 1}) == 50);
  CHECK(wall_friction({50, 50, 1, 1}, 20) == 0);
}

namespace {

/// Grains of four nodes each in a cylinder of diameter 2 and height 1 mm: on three levels, twelve around. Nodes of the
/// outer ones lie on the wall, of the upper and lower ones on the punches.
struct Cylinder {
  std::vector<double> node;
  std::vector<std::int32_t> node_grain;
  int grains() const { return static_cast<int>(node.size() / 12); }
};

Cylinder cylinder_of_grains() {
  Cylinder c;
  for (const double level : {0.2, 0.5, 0.8})
    for (int k = 0; k < 12; ++k) {
      const double x = std::cos(2 * pi * k / 12), y = std::sin(2 * pi * k / 12);
      for (const auto& [r, z] : {std::pair{1.0, level}, {0.6, level}, {0.8, level - 0.2}, {0.8, level + 0.2}}) {
        c.node.insert(c.node.end(), {1 + r * x, 1 + r * y, z});
        c.node_grain.push_back(static_cast<std::int32_t>((c.node.size() - 1) / 12));
      }
    }
  return c;
}

/// Stretched about its middle, then turned about an oblique axis and moved.
std::vector<double> sprung_back(const std::vector<double>& node, double radial, double axial) {
  const Eigen::Vector3d middle(1, 1, 0.5);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();
  std::vector<double> later;
  for (std::size_t i = 0; i < node.size(); i += 3) {
    Eigen::Vector3d x = Eigen::Vector3d(node[i], node[i + 1], node[i + 2]) - middle;
    x = x.cwiseProduct(Eigen::Vector3d(1 + radial, 1 + radial, 1 + axial));
    const Eigen::Vector3d y = middle + turn * x + Eigen::Vector3d(0.1, -0.4, 3);
    later.insert(later.end(), {y[0], y[1], y[2]});
  }
  return later;
}

std::vector<float> in_single_precision(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

} // namespace

TEST_CASE("thickness and diameter out of the die are those of the stretch, however the tablet lies") {
  const Cylinder cylinder = cylinder_of_grains();
  const std::vector<float> pressed = in_single_precision(cylinder.node),
                           later = in_single_precision(sprung_back(cylinder.node, 0.012, 0.05));
  std::string why;
  const auto shape = tablet_shape({pressed, later, cylinder.node_grain, {0, 0, 0}, {2, 2, 1}}, {0.01, 0.2}, why);
  REQUIRE(shape);
  CHECK(shape->thickness.value == Approx(1.05).margin(1e-6));
  CHECK(shape->diameter.value == Approx(2 * 1.012).margin(1e-6));
  CHECK(shape->thickness.half_width < 1e-6);
  CHECK(shape->upper_grains == 12);
  CHECK(shape->band_grains == 36);
  CHECK(shape->grains_lost == 0);
}

TEST_CASE("a grain that has left the tablet does not count in its thickness") {
  const Cylinder cylinder = cylinder_of_grains();
  std::vector<float> later = in_single_precision(sprung_back(cylinder.node, 0.012, 0.05));
  for (std::size_t i = 0; i < 12; ++i) later[12 * 30 + i] += 7; // an upper one
  const std::vector<float> pressed = in_single_precision(cylinder.node);
  std::string why;
  const auto shape = tablet_shape({pressed, later, cylinder.node_grain, {0, 0, 0}, {2, 2, 1}}, {0.01, 0.2}, why);
  REQUIRE(shape);
  CHECK(shape->grains_lost == 1);
  CHECK(shape->upper_grains == 11);
  CHECK(shape->thickness.value == Approx(1.05).margin(1e-3)); // the others turn a little towards where it was
  CHECK(shape->diameter.value == Approx(2 * 1.012).margin(1e-3));
}

TEST_CASE("without nodes at a punch there is no thickness, and a note says why") {
  const Cylinder cylinder = cylinder_of_grains();
  const std::vector<float> pressed = in_single_precision(cylinder.node);
  std::string why;
  CHECK_FALSE(tablet_shape({pressed, pressed, cylinder.node_grain, {0, 0, 0}, {2, 2, 1.5}}, {0.01, 0.2}, why));
  CHECK_THAT(why, Catch::Contains("within 0.01 mm of the upper punch found nodes of 0 grains"));
}

namespace {

/// What goes into the run of a tablet, and must come out.
struct TabletCase {
  double friction = 0.2, ratio = 0.5, upper_stress = 100; ///< mu, K, MPa at the peak
  double diameter = 2, smallest_height = 1;               ///< mm
  double leaves_at = 1.02;                                ///< mm, height at which the upper punch leaves
  double residual = 8, ejection = 12;                     ///< MPa radial, N
  double radial = 0.012, axial = 0.05;                    ///< stretch out of the die
  double density = 0.9;                                   ///< at the peak
  bool ejects = true;
};

/// Rows of one stage: height and forces in a row.
struct TabletRows {
  RunContents run;
  void row(int stage, double height, double upper, double lower, double normal, double density) {
    auto& n = run.numbers;
    const auto i = static_cast<double>(n["/history/time"].size());
    n["/history/time"].push_back(1e-6 * i);
    n["/history/step"].push_back(i);
    n["/history/stage"].push_back(stage);
    n["/history/relative_density"].push_back(density);
    for (const double length : {2.0, 2.0, height}) n["/history/box_lengths"].push_back(length);
    for (int side = 0; side < 6; ++side)
      n["/history/wall_stress"].push_back(side == 5 ? upper / pi : side == 4 ? lower / pi : normal / (2 * pi * height));
    const auto tool = [&](const std::string& name, double force, double normal_force) {
      for (const double f : {0.0, 0.0, force}) n["/history/tools/" + name + "/force"].push_back(f);
      for (int k = 0; k < 3; ++k) n["/history/tools/" + name + "/displacement"].push_back(0);
      n["/history/tools/" + name + "/normal_force"].push_back(normal_force);
      n["/history/tools/" + name + "/friction_dissipation"].push_back(0);
    };
    tool("upper", upper, std::abs(upper));
    tool("lower", -lower, std::abs(lower));
    tool("die", lower - upper, normal);
    run.extents["rows"] = n["/history/time"].size();
  }
};

RunContents tablet_run(const TabletCase& t) {
  const Cylinder cylinder = cylinder_of_grains();
  TabletRows rows;
  RunContents& run = rows.run;
  const std::size_t nodes = cylinder.node.size() / 3, grains = nodes / 4;
  run.extents = {{"rows", 0}, {"nodes", nodes}, {"tets", grains}, {"grains", grains}, {"profile", 1}, {"*pairs", 0}};
  const double area = 0.25 * pi * t.diameter * t.diameter;
  const double transmission = std::exp(-4 * t.friction * t.ratio * t.smallest_height / t.diameter);
  for (int i = 0; i <= 40; ++i) { // pressing: heights fall, forces rise
    const double part = i / 40.0, height = 1.5 - 0.5 * part, upper = t.upper_stress * area * part * part;
    const double normal = (upper - transmission * upper) / t.friction;
    rows.row(0, height, upper, transmission * upper, normal, t.density / height);
  }
  const double left = t.residual * pi * t.diameter * t.leaves_at; // N, normal force that stays at the die
  for (int i = 1; i <= 40; ++i) {                                 // unloading: gone after half of the stage
    const double part = std::min(1.0, i / 20.0), upper = t.upper_stress * area * (1 - part);
    const double height = i <= 20 ? 1 + (t.leaves_at - 1) * part : t.leaves_at + 0.05 * (i - 20);
    rows.row(1, height, upper, transmission * upper, left * part + 400 * (1 - part), t.density / height);
  }
  const auto unloaded = run.numbers["/history/time"].back();
  for (int i = 1; i <= 40 && t.ejects; ++i) rows.row(2, 2.5, 0, t.ejection * std::sin(pi * i / 40.0), left, 0.5);
  run.tools = {"die", "lower", "upper"};
  run.snapshots = {"0000", "0001", "0002"};
  auto& n = run.numbers;
  n["/snapshots/0000/time"] = {0};
  n["/snapshots/0001/time"] = {40e-6};
  n["/snapshots/0002/time"] = {t.ejects ? n["/history/time"].back() : unloaded};
  n["/snapshots/*/node"] = cylinder.node;
  n["/snapshots/0002/node"] = sprung_back(cylinder.node, t.radial, t.axial);
  n["/snapshots/*/box_low"] = {0, 0, 0};
  n["/snapshots/*/box_high"] = {2, 2, 1};
  for (std::size_t i = 0; i < nodes; ++i) n["/mesh/tet"].push_back(static_cast<double>(i));
  for (std::size_t g = 0; g <= grains; ++g) {
    n["/mesh/grain_tet_offset"].push_back(static_cast<double>(g));
    n["/mesh/grain_node_offset"].push_back(static_cast<double>(4 * g));
  }
  run.texts["/provenance/status"] = {"complete"};
  run.texts["/provenance/scenario"] = {"[[stages]]\ntype = \"a\"\nname = \"press\"\n[[stages]]\ntype = \"b\"\nname = "
                                       "\"unload\"\n[[stages]]\ntype = \"c\"\nname = \"eject\"\n"};
  return run;
}

TabletMeasurement tablet_of(const Folder& folder, const TabletCase& t, const TabletRule& rule = {}) {
  write_run(folder / "tablet.h5", tablet_run(t));
  return measure_tablet({folder / "tablet.h5", schema::FileKind::run}, rule);
}

double number(const TabletMeasurement& tablet, const std::string& name) {
  for (const TabletNumber& n : tablet.numbers)
    if (n.name == name) return n.value.value_or(std::nan(""));
  return std::nan("");
}

TabletRule near_faces() {
  TabletRule rule;
  rule.face_distance = 0.01;
  return rule;
}

} // namespace

TEST_CASE("the numbers of a tablet are those that its run was made from") {
  const Folder folder;
  const TabletCase t;
  const TabletMeasurement tablet = tablet_of(folder, t, near_faces());
  const double transmission = std::exp(-4 * t.friction * t.ratio * 1 / 2);
  CHECK(number(tablet, "upper_punch_force") == Approx(100 * pi).epsilon(1e-3));
  CHECK(number(tablet, "upper_punch_stress") == Approx(100).epsilon(1e-3));
  CHECK(number(tablet, "axial_transmission") == Approx(transmission).epsilon(1e-6));
  CHECK(number(tablet, "wall_friction_coefficient") == Approx(t.friction).epsilon(1e-3));
  CHECK(number(tablet, "die_friction_over_normal_force") == Approx(t.friction).epsilon(1e-3));
  CHECK(number(tablet, "radial_over_axial_stress") == Approx(t.ratio).epsilon(1e-3));
  CHECK(number(tablet, "relative_density_in_die") == Approx(0.9).epsilon(1e-6));
  CHECK(within(number(tablet, "smallest_height"), 1, rounding));
  // Linear between two rows: the punch keeps 1 % of its force until 0.99 of the way.
  CHECK(number(tablet, "height_when_punch_leaves") == Approx(1 + 0.02 * 0.99).epsilon(1e-3));
  CHECK(number(tablet, "axial_recovery_in_die") == Approx(0.0198).epsilon(1e-2));
  CHECK(number(tablet, "residual_radial_stress") == Approx(8).epsilon(2e-3));
  CHECK(number(tablet, "ejection_force") == Approx(12).epsilon(1e-2));
  CHECK(number(tablet, "ejection_stress") == Approx(12 / (2 * pi * 1.0198)).epsilon(1e-2));
  CHECK(number(tablet, "thickness") == Approx(1.05).epsilon(1e-6));
  CHECK(number(tablet, "diameter") == Approx(2.024).epsilon(1e-6));
  CHECK(number(tablet, "axial_recovery") == Approx(0.05).epsilon(1e-4));
  CHECK(number(tablet, "radial_recovery") == Approx(0.012).epsilon(1e-4));
  const double out_of_die = 0.9 / (1.05 * 1.012 * 1.012);
  CHECK(number(tablet, "relative_density_out_of_die") == Approx(out_of_die).epsilon(1e-5));
  // The grains fill the die of the first row at this density.
  const double filled = 0.9 * (1 - number(tablet, "volume_loss"));
  CHECK(number(tablet, "volume_loss_out_of_die") == Approx(1 - filled / out_of_die).epsilon(1e-5));
  CHECK(tablet.measurement.value == number(tablet, "relative_density_in_die"));
  CHECK(tablet.measurement.details["ejected_by"] == "lower punch");
  CHECK(tablet.measurement.notes.empty());
}

TEST_CASE("forces, friction and wall stress of a tablet hold their true values in vibration of the forces") {
  const Folder folder;
  const TabletCase t;
  const double transmission = std::exp(-4 * t.friction * t.ratio * 1 / 2), radial = (1 - transmission) * 100 / 0.4;
  Coverage force, friction, passed_on, wall, ejection;
  for (unsigned trial = 0; trial < 40; ++trial) {
    RunContents run = tablet_run(t);
    Noise noise(trial);
    for (const auto& [column, level] : {std::pair{"upper/force", 0.5}, {"lower/force", 0.5}, {"die/normal_force", 1.0}})
      for (double& value : run.numbers[std::string("/history/tools/") + column])
        if (value != 0) value += level * noise();
    write_run(folder / "noisy.h5", run);
    const TabletMeasurement tablet = measure_tablet({folder / "noisy.h5", schema::FileKind::run}, near_faces());
    const auto add = [&](Coverage& coverage, const std::string& name, double truth) {
      for (const TabletNumber& n : tablet.numbers)
        if (n.name == name) coverage.add(*n.value - truth, *n.uncertainty);
    };
    add(force, "upper_punch_force", 100 * pi);
    add(friction, "wall_friction_coefficient", t.friction);
    add(passed_on, "axial_transmission", transmission);
    add(wall, "radial_stress_at_peak", radial);
    add(ejection, "ejection_force", 12);
  }
  for (const Coverage* coverage : {&force, &friction, &passed_on, &wall, &ejection}) {
    INFO(coverage->share() << " " << coverage->width());
    CHECK(coverage->share() >= 0.9);
    CHECK(coverage->width() < 5);
  }
}

TEST_CASE("numbers that do not follow from a tablet's run are null, and a note says why") {
  const Folder folder;
  TabletCase t;
  t.ejects = false;
  const TabletMeasurement tablet = tablet_of(folder, t, near_faces());
  CHECK(number(tablet, "upper_punch_force") > 0);
  CHECK(std::isnan(number(tablet, "ejection_force")));
  CHECK(std::isnan(number(tablet, "thickness")));
  CHECK(tablet.measurement.details["thickness_mm"].is_null());
  REQUIRE(tablet.measurement.notes.size() == 1);
  CHECK_THAT(tablet.measurement.notes[0], Catch::Contains("no stage 'eject'"));
  CHECK_THAT(to_table(tablet.numbers), Catch::Contains("ejection force                    not known"));

  TabletCase smooth;
  smooth.friction = 1e-9;
  RunContents run = tablet_run(smooth);
  for (double& force : run.numbers["/history/tools/lower/force"]) force = 0;
  write_run(folder / "smooth.h5", run);
  const TabletMeasurement unborne = measure_tablet({folder / "smooth.h5", schema::FileKind::run}, near_faces());
  for (const char* name : {"axial_transmission", "wall_friction_coefficient", "die_friction_over_normal_force"})
    CHECK(std::isnan(number(unborne, name)));
}

TEST_CASE("no wall friction follows from the punches where both move along the die") {
  const Folder folder;
  for (const std::string mover : {"lower", "die"}) { // two punches that press alike; a floating die
    RunContents run = tablet_run({});
    auto& n = run.numbers;
    for (std::size_t row = 0; row < n["/history/time"].size(); ++row) {
      n["/history/tools/upper/displacement"][3 * row + 2] = -0.01 * static_cast<double>(row);
      n["/history/tools/" + mover + "/displacement"][3 * row + 2] =
          (mover == "die" ? -0.005 : 0.01) * static_cast<double>(row);
    }
    write_run(folder / "both.h5", run);
    const TabletMeasurement tablet = measure_tablet({folder / "both.h5", schema::FileKind::run}, near_faces());
    CHECK(std::isnan(number(tablet, "wall_friction_coefficient")));
    CHECK(number(tablet, "axial_transmission") > 0);
    REQUIRE(tablet.measurement.notes.size() == 1);
    CHECK_THAT(tablet.measurement.notes[0], Catch::Contains("the lower punch does 50 % of the way along the die"));
  }
}

TEST_CASE("a note says that grains which lie flatter or denser out of the die than is possible are no tablet") {
  const Folder folder;
  TabletCase flat;
  flat.axial = -0.05;
  CHECK_THAT(tablet_of(folder, flat, near_faces()).measurement.notes,
             Catch::VectorContains(std::string("out of the die the grains seem flatter than in it: they lie loose or "
                                               "have rearranged, and thickness, diameter, "
                                               "density and recovery are not those of a tablet")));
  TabletCase dense;
  dense.axial = -0.2;
  const TabletMeasurement tablet = tablet_of(folder, dense, near_faces());
  REQUIRE(number(tablet, "relative_density_out_of_die") > 1);
  REQUIRE(tablet.measurement.notes.size() == 1);
  CHECK_THAT(tablet.measurement.notes[0], Catch::Contains("denser than solid"));
  CHECK(tablet_of(folder, {}, near_faces()).measurement.notes.empty());
}

TEST_CASE("postproc tablet writes JSON and a table, and refuses what it does not find") {
  const Folder folder;
  write_run(folder / "tablet.h5", tablet_run({}));
  const Outcome done =
      postproc(fmt::format("tablet {} --face-distance 0.01 -o {}", folder / "tablet.h5", folder / "t.json"));
  INFO(done.messages);
  REQUIRE(done.exit_code == 0);
  CHECK_THAT(done.output, Catch::Contains("axial transmission") && Catch::Contains("upper punch force"));
  const auto json = nlohmann::json::parse(read_text(folder / "t.json"));
  CHECK(json["metric"] == "tablet");
  CHECK(json["uncertainty"] == 0); // the density in the die is exact
  CHECK(json["wall_friction_coefficient"].get<double>() == Approx(0.2).epsilon(1e-3));
  CHECK(json.contains("wall_friction_coefficient_uncertainty"));
  CHECK(json["ejection_stress_MPa"].get<double>() > 0);
  CHECK(json.contains("thickness_uncertainty_mm"));
  for (const auto& [options, expected] : std::vector<std::pair<std::string, std::string>>{
           {"--press squeeze", "--press: found no stage 'squeeze', allowed: press, unload, eject"},
           {"--lower upper", "--lower: found 'upper', which is the upper punch, allowed: another tool"},
           {"--hold dwell", "--hold: found no stage 'dwell'"},
           {"--upper ram", "--upper: found no tool 'ram' with force_2 in /history/tools, allowed: die, lower, upper"},
           {"--snapshot 7", "no snapshot 7"},
           {"--face-distance 0", "--face-distance"}}) {
    const Outcome outcome = postproc(fmt::format("tablet {} {}", folder / "tablet.h5", options));
    INFO(options << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
  }
  // A run without tools is none of a tablet.
  write_run(folder / "box.h5", run_of({{.axial_stress = 1}, {.axial_stress = 2}}));
  CHECK_THAT(postproc(fmt::format("tablet {}", folder / "box.h5")).messages, Catch::Contains("a run with rigid tools"));
}

TEST_CASE("columns of tools stand in the history by tool and name") {
  const Folder folder;
  write_run(folder / "tablet.h5", tablet_run({}));
  const HistoryTable history({folder / "tablet.h5", schema::FileKind::run});
  CHECK(history["tools/upper/force_2"].size() == history.rows());
  CHECK(history.select({"tools/die/force"}).size() == 3);
  const Outcome curve =
      postproc(fmt::format("curve {} --columns tools/upper/force_2,tools/lower/normal_force", folder / "tablet.h5"));
  CHECK(curve.exit_code == 0);
  CHECK(curve.output.starts_with("tools/upper/force_2 [N],tools/lower/normal_force [N]\n"));
}

TEST_CASE("the stress of a disc under two loads is that of the closed form, and flats reduce it") {
  CHECK(within(diametral_stress(pi, 2, 1), 1, rounding));
  CHECK(flat_correction(0) == 1);
  for (const auto& [degrees, factor] : {std::pair{10.0, 0.990}, {20.0, 0.960}, {30.0, 0.910}})
    CHECK(flat_correction(0.5 * degrees * pi / 180) == Approx(factor).margin(5e-4));
  CHECK(flat_correction(0.99e-4) == Approx(flat_correction(1.01e-4)).epsilon(1e-9)); // series and formula meet
}

TEST_CASE("the peak of a disc is the largest force before its first fall by a tenth") {
  // One plate pushes the disc against the other: the test begins when both carry a tenth of the largest mean.
  const std::vector<double> left{-3, 0, -0.5, -2, -8}, right{0, 2, 1, 2, 12};
  CHECK(disc_force(left, right) == std::vector<double>{0, 0, 0, 2, 10});
  const FirstPeak first = first_peak({0, 3, 6, 10, 9.5, 8.9, 12, 14}, 0.1);
  CHECK(first.row == 3);
  CHECK(first.falls);
  const FirstPeak seating = first_peak({0, 1, 0.2, 6, 20, 21, 15}, 0.1); // the fall of a twentieth is seating
  CHECK(seating.row == 5);
  const FirstPeak bounce = first_peak({0, 3, 6, 4, 9, 21, 15}, 0.1, 7); // a plate bounces off below 7
  CHECK(bounce.row == 5);
  CHECK(bounce.falls);
  const FirstPeak none = first_peak({0, 3, 6, 10, 9.5, 9.2}, 0.1);
  CHECK(none.row == 3);
  CHECK_FALSE(none.falls);
  // Falls that do not count are passed over; the peak stays the largest value of all before the one that counts.
  const auto peak_from = [](const std::vector<double>& values, std::size_t counted) {
    return first_peak(values, 0.2, 0, [=](std::size_t row) { return row >= counted; });
  };
  CHECK(peak_from({0, 10, 6, 7, 20, 12, 9}, 5).row == 4);
  const FirstPeak late = peak_from({0, 10, 20, 30, 40, 50, 39, 30, 20, 10}, 8);
  CHECK(late.row == 5);
  CHECK(late.falls);
  CHECK_FALSE(peak_from({0, 10, 6, 7, 20, 12, 9}, 7).falls);
}

TEST_CASE("a disc is as thick as its faces are apart, whatever sticks out of them or has come off") {
  // A disc of diameter 2 and thickness 0.6 mm along y, loaded along x; its nodes are 0.05 mm apart. They are in single
  // precision.
  std::vector<float> node;
  const auto add = [&](double x, double y, double z) {
    for (const double value : {x, y, z}) node.push_back(static_cast<float>(value));
  };
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j)
      for (const double y : {0.0, 0.3, 0.6})
        if (i * i + j * j <= 400) add(0.05 * i, y, 0.05 * j);
  CHECK(within(disc_thickness(node, 0, 1, 2), 0.6, 1e-6));
  // A grain that sticks out by 0.3 mm, and one that has come off and moves the mean of all nodes by some 0.01 mm.
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      add(0.3 + 0.05 * i, 0.9, 0.05 * j);
      add(3 + 0.05 * i, 1, 0.05 * j);
    }
  CHECK(within(disc_thickness(node, 0, 1, 2), 0.6, 1e-6));
  CHECK(disc_thickness({}, 0, 1, 2) == 0);
}

TEST_CASE("the angle of a flat is that of its pressed nodes, of the wider flat") {
  // A disc of diameter 2 pressed along x: nodes at y = -0.1 … 0.1 on one side, -0.05 … 0.05 on the other.
  const std::vector<float> node = {0, 0.9F, 0, 0, 1.1F, 0, 2, 0.95F, 0, 2, 1.05F, 0, 1, 0, 0, 1, 2, 0};
  std::vector<float> pressure = {1, 2, 3, 1, 5, 0};
  const auto angle = flat_half_angle({node, pressure, 0, 2, 2, 0.02});
  REQUIRE(angle);
  CHECK(*angle == Approx(std::asin(0.1)).epsilon(1e-5));
  pressure[2] = pressure[3] = 0;
  CHECK_FALSE(flat_half_angle({node, pressure, 0, 2, 2, 0.02}));
}

TEST_CASE("bonds that break in a disc are counted by their position before, and bonds broken earlier are not counted") {
  // A disc of diameter 2 about (1, 1), loaded along x: bonds in the centre, at a load, aside, and one broken before.
  const std::vector<float> node = {1, 1, 0, 0.1F, 1, 0, 1, 1.8F, 0, 1, 1, 1};
  const auto bond = [](std::int32_t at, double area, double damage) {
    BondRow row;
    row.node = at, row.area = area, row.damage = damage;
    return row;
  };
  const DiscGeometry disc{node, 0, 1, {1, 1, 0.5}, 2};
  const std::vector<BondRow> before = {bond(0, 2, 0), bond(1, 1, 0.5), bond(2, 1, 0), bond(3, 9, 1)};
  const auto crack = disc_crack(before, {bond(0, 2, 1), bond(1, 1, 1), bond(2, 1, 1), bond(3, 9, 1)}, disc);
  REQUIRE(crack);
  CHECK(crack->area == 4);
  CHECK(crack->near_diameter == 0.75);
  CHECK(crack->in_centre == 0.5);
  // Of the whole bonds within D/8 of the loaded diameter, 2 of 3 mm^2 lie in the centre.
  CHECK(within(crack->in_centre_if_even, 0.75 * 2 / 3, rounding));
  CHECK(crack->of_centre == 1);
  CHECK(disc_crack(before, {bond(0, 2, 0), bond(1, 1, 1)}, disc)->of_centre == 0);
  CHECK_FALSE(disc_crack(before, before, disc));
}

namespace {

/// The cube of small_run (2 mm) between two plates that approach along x in stage 1 from row 10 on; the force rises to
/// 50 N in row 40 and falls.
RunContents disc_run() {
  std::vector<Row> rows(71);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].stage = i < 10 ? 0 : 1;
  RunContents run = run_of(rows);
  run.tools = {"left", "right"};
  run.numbers["/snapshots/*/time"] = {2e-6};
  for (int i = 0; i <= 70; ++i) {
    const double way = i < 10 ? 0 : 1e-3 * (i - 10);
    const double force = i < 10 ? 0 : i <= 40 ? 50 * std::sin(0.5 * pi * (i - 10) / 30.0) : 50 - 1.0 * (i - 40);
    for (const auto& [name, sign] : {std::pair{"left", -1.0}, {"right", 1.0}}) {
      const std::string tool = fmt::format("/history/tools/{}/", name);
      for (const double f : {sign * force, 0.0, 0.0}) run.numbers[tool + "force"].push_back(f);
      for (const double u : {-sign * way, 0.0, 0.0}) run.numbers[tool + "displacement"].push_back(u);
    }
  }
  return run;
}

} // namespace

TEST_CASE("postproc diametral finds plates, axis, peak and disc, and corrects for flats") {
  const Folder folder;
  write_run(folder / "disc.h5", disc_run());
  REQUIRE(
      postproc(fmt::format("diametral {} --flat-angle 20 -o {}", folder / "disc.h5", folder / "d.json")).exit_code ==
      0);
  const auto json = nlohmann::json::parse(read_text(folder / "d.json"));
  CHECK(json["force_N"].get<double>() == Approx(50).epsilon(5e-3));
  CHECK(json["load_axis"] == "x");
  CHECK(within(json["diameter_mm"].get<double>(), 2, rounding));
  CHECK(within(json["thickness_mm"].get<double>(), 2, rounding));
  CHECK(json["value"].get<double>() == Approx(2 * 50 / (pi * 2 * 2)).epsilon(5e-3));
  CHECK(json["corrected_strength_MPa"].get<double>() == Approx(0.960 * json["value"].get<double>()).epsilon(1e-3));
  CHECK(json["criterion"] == "peak");
  const Outcome without =
      postproc(fmt::format("diametral {} --diameter 3 --thickness 0.5 -o {}", folder / "disc.h5", folder / "d.json"));
  REQUIRE(without.exit_code == 0);
  CHECK_THAT(without.messages, Catch::Contains("--flat-angle"));
  const auto given = nlohmann::json::parse(read_text(folder / "d.json"));
  CHECK(given["value"].get<double>() == Approx(2 * 50 / (pi * 3 * 0.5)).epsilon(5e-3));
  CHECK(given["corrected_strength_MPa"].is_null());
}

TEST_CASE("postproc diametral takes the peak before the fall with a crack through the centre, if there is one") {
  // A grain breaks off at 30 N (row 25), the disc splits at 50 N (row 45). The bond of a corner breaks first.
  RunContents run = disc_run();
  for (int i = 10; i <= 70; ++i) {
    const double force = i <= 25   ? 2 * (i - 10)
                         : i <= 30 ? 30 - 3 * (i - 25)
                         : i <= 45 ? 15 + 35.0 / 15 * (i - 30)
                                   : 50 - 1.5 * (i - 45);
    for (const auto& [name, sign] : {std::pair{"left", -1.0}, {"right", 1.0}})
      run.numbers[fmt::format("/history/tools/{}/force", name)][static_cast<std::size_t>(3 * i)] = sign * force;
  }
  run.snapshots = {"0000", "0001", "0002"};
  run.extents["*bonds"] = 3;
  run.extents["grains"] = 3; // the third without a node
  for (const char* offset : {"/mesh/grain_tet_offset", "/mesh/grain_node_offset"})
    run.numbers[offset].push_back(run.numbers[offset].back());
  run.numbers["/snapshots/0001/time"] = {35e-6};
  run.numbers["/snapshots/0002/time"] = {60e-6};
  run.numbers["/snapshots/*/bond_node"] = {13, 13, 0}; // two in the middle of the cube, and one at a corner
  run.numbers["/snapshots/*/bond_grain"] = {1, 2, 1};
  run.numbers["/snapshots/*/bond_area"] = {1, 3, 1};
  run.numbers["/snapshots/*/bond_damage"] = {0, 0, 0};
  run.numbers["/snapshots/0001/bond_damage"] = {0, 0, 1};
  run.numbers["/snapshots/0002/bond_damage"] = {1, 0, 1}; // a quarter of the area in the centre
  const Folder folder;
  const auto measured = [&](const std::string& options) {
    write_run(folder / "disc.h5", run);
    const Outcome outcome =
        postproc(fmt::format("diametral {} {} -o {}", folder / "disc.h5", options, folder / "d.json"));
    INFO(outcome.messages);
    REQUIRE(outcome.exit_code == 0);
    return nlohmann::json::parse(read_text(folder / "d.json"));
  };
  // Smoothing rounds the corners of the curve by less than a tenth.
  CHECK(within(measured("--flat-angle 0")["force_N"].get<double>(), 30, 0.1));
  const auto split = measured("--flat-angle 0 --crack-in-centre 0.24");
  CHECK(within(split["force_N"].get<double>(), 50, 0.1));
  CHECK(split["criterion"] == "peak");
  const auto none = measured("--flat-angle 0 --crack-in-centre 0.26");
  CHECK(none["criterion"] == "none");
  CHECK(none["value"].is_null());
  CHECK(none["force_N"].is_null());
  CHECK(none.contains("corrected_strength_MPa"));
  CHECK_THAT(none["notes"].dump(), Catch::Contains("no strength: the force"));
  CHECK(measured("")["flat_angle_degrees"].is_null()); // nothing is pressed
  auto& pressure = run.numbers["/snapshots/*/contact_pressure"];
  pressure.assign(27, 1); // the cube's whole faces are pressed
  const auto wide = measured("--crack-in-centre 0.24");
  CHECK(wide["criterion"] == "none");
  CHECK(wide["value"].is_null());
  CHECK_THAT(wide["notes"].dump(), Catch::Contains("no strength: the flats span 180 degrees"));
  run.extents["*bonds"] = 0;
  for (const char* name : {"node", "grain", "area", "damage"})
    for (const char* snapshot : {"*", "0001", "0002"}) {
      const auto found = run.numbers.find(fmt::format("/snapshots/{}/bond_{}", snapshot, name));
      if (found != run.numbers.end()) found->second = {};
    }
  write_run(folder / "loose.h5", run);
  const Outcome loose = postproc(fmt::format("diametral {} --crack-in-centre 0.2", folder / "loose.h5"));
  CHECK(loose.exit_code == 2);
  CHECK_THAT(loose.messages, Catch::Contains("--crack-in-centre 0.2: found no bonds"));
}

TEST_CASE("postproc diametral refuses wrong plates, axes and wide flats, and tells where bonds broke") {
  const Folder folder;
  RunContents run = disc_run();
  write_run(folder / "disc.h5", run);
  for (const auto& [options, expected] : std::vector<std::pair<std::string, std::string>>{
           {"--plates left,top", "--plates: found 'top', allowed: two of left, right"},
           {"--plates left", "--plates"},
           {"--disc-axis x", "--disc-axis"},
           {"--flat-angle 31", "--flat-angle"},
           {"--smallest-peak 60", "found a force of at most 50 N on the plates"},
           {"--stage 0", "the plates do not move"},
           {"--stage 5", "--stage"}}) {
    const Outcome outcome = postproc(fmt::format("diametral {} {}", folder / "disc.h5", options));
    INFO(options << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
  }
  RunContents oblique = run;
  for (const std::string tool : {"left", "right"}) {
    std::vector<double>& u = oblique.numbers["/history/tools/" + tool + "/displacement"];
    for (std::size_t i = 0; i + 2 < u.size(); i += 3) u[i + 1] = 0.1 * u[i];
  }
  write_run(folder / "oblique.h5", oblique);
  const Outcome obliquely = postproc(fmt::format("diametral {}", folder / "oblique.h5"));
  CHECK(obliquely.exit_code == 2);
  CHECK_THAT(obliquely.messages, Catch::Contains("the plates approach each other obliquely"));
  // A snapshot at the peak in which the bond in the middle is broken, and none is pressed.
  run.snapshots = {"0000", "0001"};
  run.numbers["/snapshots/0001/time"] = {40e-6};
  run.extents["*bonds"] = 2;
  run.numbers["/snapshots/*/bond_node"] = {13, 0}; // in the middle of the cube, and at a corner
  run.numbers["/snapshots/*/bond_grain"] = {1, 1};
  run.numbers["/snapshots/*/bond_area"] = {1, 1};
  run.numbers["/snapshots/*/bond_damage"] = {0, 0};
  run.numbers["/snapshots/0001/bond_damage"] = {1, 0.5};
  write_run(folder / "broken.h5", run);
  REQUIRE(postproc(fmt::format("diametral {} -o {}", folder / "broken.h5", folder / "b.json")).exit_code == 0);
  const auto broken = nlohmann::json::parse(read_text(folder / "b.json"));
  CHECK(broken["broken_bond_area_mm2"] == 1);
  CHECK(broken["broken_share_in_centre"] == 1);
  CHECK(broken["broken_share_in_centre_if_even"] == 1);
  CHECK(broken["broken_share_of_centre"] == 1);
  REQUIRE(postproc(fmt::format("diametral {} --data {}", folder / "broken.h5", folder / "crack.csv")).exit_code == 0);
  const auto columns = read_csv(folder / "crack.csv", {{"snapshot"}, {"force"}, {"broken_share_in_centre"}});
  CHECK(columns[0].values == std::vector<double>{1});
  CHECK(columns[1].values == std::vector<double>{50}); // the snapshot is at the peak
  CHECK(columns[2].values == std::vector<double>{1});
  // The snapshot at the peak shows flats as wide as the cube.
  run.numbers["/snapshots/*/contact_pressure"] = std::vector<double>(run.extents["nodes"], 1.0);
  write_run(folder / "wide.h5", run);
  const Outcome wide = postproc(fmt::format("diametral {}", folder / "wide.h5"));
  CHECK(wide.exit_code == 2);
  CHECK_THAT(wide.messages, Catch::Contains("2 alpha = 180 degrees") && Catch::Contains("allowed: up to 30"));
}
