// Unload-reload moduli, offset yield and true stress, on curves with known results.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "postproc/metrics/modulus.hpp"
#include "postproc/metrics/offset_yield.hpp"
#include "postproc/metrics/strength.hpp"
#include "postproc/metrics/true_stress.hpp"
#include "postproc/metrics/unload_reload.hpp"
#include "stage_run.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double straight = 1e-9; // straight lines through logarithms of exponentials, interpolated

/// Rows of an axial loading along straight lines between (strain, stress), `steps` to each.
std::vector<Row> along(const std::vector<std::array<double, 2>>& corners, int steps) {
  std::vector<Row> rows = {{.axial_strain = corners[0][0], .axial_stress = corners[0][1]}};
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (int step = 1; step <= steps; ++step) {
      const double f = static_cast<double>(step) / steps;
      rows.push_back({.axial_strain = corners[i - 1][0] + f * (corners[i][0] - corners[i - 1][0]),
                      .axial_stress = corners[i - 1][1] + f * (corners[i][1] - corners[i - 1][1])});
    }
  return rows;
}

/// Yields from the start at 500 MPa; unloads at 2000 MPa from 5 to 4 MPa, and reloads along the same line.
const std::vector<std::array<double, 2>> one_loop = {{0, 0}, {0.01, 5}, {0.0095, 4}, {0.01, 5}, {0.02, 10}};

} // namespace

TEST_CASE("a loop's modulus is elastic where the loading yields from its start") {
  const Folder folder;
  const StageCurve curve = curve_of(folder, along(one_loop, 40));
  const Measurement m = unload_reload_modulus(curve, -1);
  CHECK(within(m.value, 2000, straight));
  CHECK(within(m.details["slope_of_unloading_MPa"].get<double>(), 2000, straight));
  CHECK(within(m.details["slope_of_reloading_MPa"].get<double>(), 2000, straight));
  CHECK(std::abs(m.details["loop_area_MPa"].get<double>()) < 1e-12); // of 5 MPa times 5e-4
  CHECK(m.window.first_row == 40);
  CHECK(m.window.last_row == 120);
  CHECK(within(modulus(curve, {.strain_range = {{0.001, 0.009}}}).value, 500, straight)); // the secant
}

TEST_CASE("the axial work in a round container is that of the walls' force, which acts on pi/4 of the block's face") {
  const Folder folder;
  for (const double lateral_stress : {0.0, 5.0}) { // unconfined, and not
    std::vector<Row> rows = along({{0, 10}, {0.01, 10}, {0.02, 10}}, 40);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].stage = i <= 40 ? 0 : 1;
      rows[i].lateral_stress = lateral_stress;
      rows[i].lateral_strain = i <= 40 ? -0.1 : -0.2;
    }
    RunContents run = run_of(rows);
    run.numbers["/history/section_share"].assign(rows.size(), std::numbers::pi / 4);
    const StageCurve curve = curve_of(folder, run, 1);
    REQUIRE(curve.first_row == 40);
    const double face = std::numbers::pi / 4 * std::exp(2 * 0.2), first_face = std::numbers::pi / 4 * std::exp(2 * 0.1);
    const double step = std::exp(-rows[50].axial_strain) - std::exp(-rows[60].axial_strain);
    CHECK(within(curve.axial_work[20] - curve.axial_work[10], 10 * face * step, straight));
    CHECK(curve.unconfined == (lateral_stress == 0));
    CHECK(within(curve.axial_stress[20], curve.unconfined ? 10 * face / first_face : 10, straight));
  }
}

TEST_CASE("a loop that is elastic has no area, wherever its rows lie") {
  for (const int steps : {4, 5, 7, 9, 13}) {
    const Folder folder;
    const StageCurve curve = curve_of(folder, along({{0, 0}, {0.01, 10}, {0.006, 6}, {0.02, 20}}, steps));
    CAPTURE(steps);
    CHECK(std::abs(unload_reload_modulus(curve, 0).details["loop_area_MPa"].get<double>()) < 1e-12);
  }
}

TEST_CASE("a loop's area ends at its closing strain: a parallelogram of known sides") {
  // Down and up at 1000 MPa, with a drop of 2 MPa at the top and a rise of 2 MPa at the bottom.
  const Folder folder;
  const std::vector<std::array<double, 2>> down = {{0, 0}, {0.01, 10}, {0.0099999, 8}, {0.006, 4}};
  auto corners = down;
  corners.insert(corners.end(), {{0.0060001, 6}, {0.02, 20}});
  for (const int steps : {5, 6, 11}) {
    const StageCurve curve = curve_of(folder, along(corners, steps));
    CHECK(within(unload_reload_modulus(curve, 0).details["loop_area_MPa"].get<double>(), 0.004 * 2, 1e-3));
  }
}

TEST_CASE("a loop with hysteresis has the mean slope of its branches, and the area between them") {
  const Folder folder;
  // Down along two lines, and up along the lower of them, on and on.
  const StageCurve curve =
      curve_of(folder, along({{0, 0}, {0.01, 5}, {0.0095, 3}, {0.009, 2}, {0.0095, 3}, {0.01, 4}, {0.02, 8}}, 30));
  const Measurement m = unload_reload_modulus(curve, 0);
  CHECK(within(m.details["slope_between_turning_points_MPa"].get<double>(), 3 / 0.001, straight));
  CHECK(
      within(m.details["slope_of_unloading_MPa"].get<double>(), 3000, 1e-6)); // half of 4000 and 2000 each, by symmetry
  CHECK(within(m.details["slope_of_reloading_MPa"].get<double>(), 2000, straight));
  CHECK(within(m.value, 2500, 1e-6));
  CHECK(m.uncertainty >= 500); // half of the branches' difference, and that the first is bent
  // A triangle between (0.0095, 3), (0.01, 5) and (0.01, 4), where the strain is back; this one gives energy.
  CHECK(within(m.details["loop_area_MPa"].get<double>(), -0.5 * 0.0005 * 1, 1e-6));
}

TEST_CASE("loops are counted, and a stage without one is refused") {
  const Folder folder;
  auto corners = one_loop;
  corners.insert(corners.end(), {{0.019, 8}, {0.02, 10}, {0.03, 14}});
  const StageCurve two = curve_of(folder, along(corners, 20));
  REQUIRE(unload_reload_loops(two).size() == 2);
  CHECK(within(unload_reload_modulus(two, 0).value, 2000, straight));
  CHECK(within(unload_reload_modulus(two, 1).value, 2000, straight));
  CHECK_THROWS_WITH(unload_reload_modulus(two, 2), Catch::Contains("--loop: found 2, allowed: 0 … 1"));
  const StageCurve unloaded = curve_of(folder, along({{0, 0}, {0.01, 5}, {0.0095, 4}}, 20)); // and not reloaded
  CHECK_THROWS_WITH(unload_reload_modulus(unloaded, -1), Catch::Contains("found no loop"));
}

TEST_CASE("the curve of a loop covers consecutive stages of one type") {
  const Folder folder;
  auto rows = along(one_loop, 40);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row].stage = row <= 40 ? 1 : row <= 80 ? 2 : 3;
  rows.insert(rows.begin(),
              Row{.stage = 0, .axial_stress = 90, .lateral_stress = 90}); // another type: not of the curve
  rows[1].stage = 0;
  std::string scenario = "[[stages]]\ntype = 'hold'\n";
  for (int i = 0; i < 3; ++i) scenario += "[[stages]]\ntype = 'unconfined_compression'\n";
  write_run(folder / "run.h5", run_of(rows, scenario));
  const Measurement m = measure_unload_reload_modulus(schema::FileReader(folder / "run.h5"), {}, -1);
  CHECK(within(m.value, 2000, straight));
  CHECK(m.window.first_row == 41);
}

TEST_CASE("offset yield of a bilinear curve is where the plastic strain is the offset") {
  const Folder folder;
  // 1000 MPa up to 10 MPa, then 100 MPa: the plastic strain is 0.9 (e - 0.01).
  const StageCurve curve = curve_of(folder, along({{0, 0}, {0.01, 10}, {0.05, 14}}, 200));
  for (const double offset : {0.002, 0.01}) {
    const Measurement m = offset_yield(curve, {.offset = offset});
    CHECK(within(m.value, 10 + 100 * offset / 0.9, straight));
    CHECK(within(m.details["axial_strain_at_yield"].get<double>(), 0.01 + offset / 0.9, straight));
    CHECK(within(m.details["elastic_slope_MPa"].get<double>(), 1000, straight));
  }
  CHECK_THROWS_WITH(offset_yield(curve, {.offset = 0.04}), Catch::Contains("does not reach a plastic strain of 0.04"));
}

TEST_CASE(
    "where a loading ends before it yields with the smallest possible slope, the uncertainty reaches to its end") {
  const Folder folder;
  // 1000 MPa up to 10 MPa, then 900 MPa: yields near 28 MPa, ends at 37. Rows scatter by half a MPa.
  auto rows = along({{0, 0}, {0.01, 10}, {0.04, 37}}, 200);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row].axial_stress += row % 2 == 0 ? 0.5 : -0.5;
  const Measurement m = offset_yield(curve_of(folder, rows), {});
  const double slope = m.details["elastic_slope_MPa"].get<double>();
  const double smallest = slope - m.details["elastic_slope_uncertainty_MPa"].get<double>();
  CAPTURE(m.value, slope, smallest);
  REQUIRE(0.04 - 36.5 / smallest < 0.002); // no yield with the smallest slope
  CHECK(m.uncertainty >= 37 - 0.5 - m.value);
}

TEST_CASE("a toe does not count as plastic strain, and a slope may be given") {
  const Folder folder;
  const StageCurve curve = curve_of(folder, along({{0, 0}, {0.003, 0.1}, {0.013, 10.1}, {0.053, 14.1}}, 200));
  const Measurement m = offset_yield(curve, {});
  CHECK(within(m.value, 10.1 + 100 * 0.002 / 0.9, 1e-3)); // the window may hold a rest of the toe's rows
  const StageCurve no_toe = curve_of(folder, along({{0, 0}, {0.01, 10}, {0.05, 14}}, 200));
  const Measurement steeper = offset_yield(no_toe, {.slope = 2000});
  // e - s/2000 = 0.002 while still on the first line: e = 0.004 beyond what the first rows leave of their own.
  CHECK(steeper.value < 5);
  CHECK(steeper.value > 3.5);
}

TEST_CASE("offset yield of a probe in any direction uses the strain that is work-conjugate to its path") {
  const Folder folder;
  constexpr double bulk = 3000, shear = 1000, p_0 = 60, yields_at = 12, compliance = 4e-4;
  for (const auto& direction :
       {std::array{1.0, 0.0}, std::array{0.0, 1.0}, std::array{0.6, 0.8}, std::array{-0.6, 0.8}}) {
    const double n_p = direction[0], n_q = direction[1];
    std::vector<Row> rows;
    for (int i = 0; i <= 600; ++i) {
      const double s = 0.04 * i; // MPa along the path
      const double plastic = compliance * std::max(0.0, s - yields_at);
      const double volumetric = n_p * (s / bulk + plastic), deviatoric = n_q * (s / (3 * shear) + plastic);
      const double p = p_0 + n_p * s, q = n_q * s;
      rows.push_back({.axial_strain = volumetric / 3 + deviatoric,
                      .lateral_strain = volumetric / 3 - 0.5 * deviatoric,
                      .axial_stress = p + 2 * q / 3,
                      .lateral_stress = p - q / 3});
    }
    const Measurement m = offset_yield(curve_of(folder, rows), {});
    const double s = yields_at + 0.002 / compliance;
    CAPTURE(n_p, n_q, m.method);
    CHECK(within(m.details["stress_along_path_at_yield_MPa"].get<double>(), s, 1e-7));
    CHECK(within(m.details["mean_stress_MPa"].get<double>(), p_0 + n_p * s, 1e-7));
    CHECK(within(m.details["elastic_slope_MPa"].get<double>(), 1 / (n_p * n_p / bulk + n_q * n_q / (3 * shear)), 1e-7));
  }
}

TEST_CASE("an unconfined strength is given over the initial and over the current cross-section") {
  const Folder folder;
  // Rises to 20 MPa at a strain of 0.02 and falls; each lateral axis widens by a third of the axial strain.
  auto rows = along({{0, 0}, {0.02, 20}, {0.04, 15}}, 100);
  RunContents contents = run_of(rows, "[[stages]]\ntype = 'unconfined_compression'\n");
  for (const Row& row : rows)
    for (const double spread : {0.2 * std::exp(row.axial_strain / 3), 0.3 * std::exp(row.axial_strain / 3), 0.2})
      contents.numbers["/history/mass_spread"].push_back(spread);
  write_run(folder / "run.h5", contents);
  const Measurement m = measure_strength(schema::FileReader(folder / "run.h5"), {}, {});
  CHECK(m.details["nominal_strength_MPa"] == m.value);
  const double growth = std::exp(2.0 / 3 * m.details["axial_strain_at_strength"].get<double>());
  CHECK(within(m.details["cross_section_growth_at_strength"].get<double>(), growth, 1e-7)); // an exponential, by lines
  CHECK(within(m.details["true_stress_at_strength_MPa"].get<double>(), m.value / growth, 1e-7));
  CHECK(m.details["largest_true_stress_MPa"].get<double>() >= m.details["true_stress_at_strength_MPa"].get<double>());
  CHECK(m.details["largest_true_stress_MPa"].get<double>() < m.value);

  write_run(folder / "old.h5", run_of(rows, "[[stages]]\ntype = 'unconfined_compression'\n"));
  const Measurement old = measure_strength(schema::FileReader(folder / "old.h5"), {}, {});
  CHECK(old.value == m.value);
  CHECK(old.details["nominal_strength_MPa"] == old.value);
  CHECK(old.details["true_stress_at_strength_MPa"].is_null());
}
