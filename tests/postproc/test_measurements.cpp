// Metrics on histories with known results, with noise and ringing, and what they refuse.

#include <algorithm>
#include <numbers>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/hash.hpp"
#include "postproc/metrics/contact_history.hpp"
#include "postproc/metrics/elastic_recovery.hpp"
#include "postproc/metrics/energy_release.hpp"
#include "postproc/metrics/hysteresis.hpp"
#include "postproc/metrics/modulus.hpp"
#include "postproc/metrics/strength.hpp"
#include "postproc/metrics/yield_point.hpp"
#include "postproc/run_data/mean_radius.hpp"
#include "run_postproc.hpp"
#include "solver/model/model.hpp"
#include "stage_run.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Isotropic row: the same stress and strain along all axes.
Row isotropic(int stage, double density, double stress) {
  Row row;
  row.stage = stage;
  row.relative_density = density;
  row.axial_strain = row.lateral_strain = std::log(density / 0.55) / 3;
  row.axial_stress = row.lateral_stress = stress;
  return row;
}

/// Compaction to 0.9 at 80 MPa in stage 0, unloading in stage 1 to `residual` MPa along D = 0.88 + 0.02 (p /
/// 80)^exponent.
std::vector<Row> loaded_and_unloaded(double residual, double exponent) {
  std::vector<Row> rows;
  for (int i = 0; i <= 20; ++i) rows.push_back(isotropic(0, 0.6 + 0.015 * i, 0.2 * i * i));
  for (int i = 1; i <= 40; ++i) {
    const double p = residual + (80 - residual) * std::pow(1 - i / 40.0, 2);
    rows.push_back(isotropic(1, 0.88 + 0.02 * std::pow(p / 80, exponent), p));
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i].plastic = 0.1 * static_cast<double>(std::min<std::size_t>(i, 20));
  return rows;
}

/// An unconfined reloading: axial stress over axial strain of equal steps, with noise of this standard deviation (MPa).
template <class Stress, class Damage>
std::vector<Row> reloading(int rows, double end_strain, const Stress& stress, const Damage& damage, double noise_level,
                           unsigned seed) {
  Noise noise(seed);
  std::vector<Row> list;
  for (int i = 0; i <= rows; ++i) {
    Row row;
    row.axial_strain = end_strain * i / rows;
    row.axial_stress = stress(row.axial_strain) + noise_level * noise();
    row.damage = damage(row.axial_strain);
    row.plastic = 1;
    list.push_back(row);
  }
  return list;
}

double no_damage(double) {
  return 0;
}

} // namespace

TEST_CASE("elastic recovery is that of Eq. 9, from the densest row to the end of the unloading") {
  const Folder folder;
  write_run(folder / "run.h5", run_of(loaded_and_unloaded(0, 1)));
  const Measurement m = measure_elastic_recovery(schema::FileReader(folder / "run.h5"), {});
  CHECK(within(m.value, 0.02 / 0.9, rounding));
  CHECK(within(m.details["recovery_over_loaded_volume"].get<double>(), 0.02 / 0.88, rounding));
  CHECK(m.details["residual_mean_stress_MPa"] == 0);
  CHECK(m.window.stage == 1);
  CHECK(m.window.first_row == 20);
  CHECK(m.window.last_row == 60);
  CHECK(m.uncertainty < 1e-10); // straight to the end, and nothing left to extrapolate
}

TEST_CASE("the uncertainty of the recovery includes the effect of the remaining stress") {
  const Folder folder;
  for (const double exponent : {1.0, 2.0 / 3.0}) // linear, and contacts that open as Hertz's do
    for (const double residual : {0.1, 1.0, 5.0}) {
      write_run(folder / "run.h5", run_of(loaded_and_unloaded(residual, exponent)));
      const Measurement m = measure_elastic_recovery(schema::FileReader(folder / "run.h5"), {});
      const double true_recovery = 0.02 / 0.9, error = std::abs(m.value - true_recovery);
      INFO(exponent << " " << residual << ": " << error << " " << m.uncertainty);
      CHECK(error <= m.uncertainty * (1 + accumulated_rounding) + 1e-15); // exact for both curves
      CHECK(m.uncertainty <= 4 * error + 1e-4);                           // and no more than a few times that
      const double error_at_zero = std::abs(m.details["recovery_at_zero_stress"].get<double>() - true_recovery);
      const double uncertainty_at_zero = m.details["recovery_at_zero_stress_uncertainty"].get<double>();
      CHECK(error_at_zero <= 0.75 * error + 1e-12);
      CHECK(error_at_zero <= uncertainty_at_zero * (1 + accumulated_rounding) + 1e-15);
      CHECK(uncertainty_at_zero < m.uncertainty); // what the rest adds is taken into account, but for how it goes on
      CHECK(within(m.details["recovery_over_loaded_volume_uncertainty"].get<double>(),
                   m.uncertainty / std::pow(1 - m.value, 2), rounding));
      CHECK(m.notes.empty() == (residual < 1.6)); // 2 % of 80 MPa
    }
}

TEST_CASE("the uncertainty of the recovery includes the ringing of the stress") {
  const Folder folder;
  Noise noise(11);
  int held = 0, held_at_zero = 0, held_of_stress = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Row> rows = loaded_and_unloaded(0.5, 2.0 / 3.0);
    for (std::size_t i = 21; i < rows.size(); ++i) { // ringing of a tenth of the residual stress
      const double ring = 0.05 * noise();
      rows[i].axial_stress += ring, rows[i].lateral_stress += ring;
    }
    write_run(folder / "run.h5", run_of(rows));
    const Measurement m = measure_elastic_recovery(schema::FileReader(folder / "run.h5"), {});
    const auto number = [&](const char* name) { return m.details[name].get<double>(); };
    held += std::abs(m.value - 0.02 / 0.9) <= m.uncertainty;
    held_at_zero +=
        std::abs(number("recovery_at_zero_stress") - 0.02 / 0.9) <= number("recovery_at_zero_stress_uncertainty");
    held_of_stress +=
        std::abs(number("residual_mean_stress_MPa") - 0.5) <= number("residual_mean_stress_uncertainty_MPa");
    CHECK(m.uncertainty < 0.1 * m.value);
    CHECK(number("residual_mean_stress_uncertainty_MPa") < 6 * 0.05);
  }
  CHECK(held >= 88); // 95 +- 3 * 2.2
  CHECK(held_at_zero >= 88);
  CHECK(held_of_stress >= 88);
}

TEST_CASE("the unloading is found by its type, or where density and stress fall") {
  const Folder folder;
  std::vector<Row> rows = loaded_and_unloaded(0.5, 1);
  for (int i = 1; i <= 20; ++i) { // the lateral walls leave: the box grows too
    Row row = isotropic(2, 0.88 - 0.01 * i, 0.5 - 0.02 * i);
    rows.push_back(row);
  }
  const std::string scenario =
      "[material]\nyoungs_modulus = 5000.0\n[[stages]]\ntype = 'isotropic_compaction'\n"
      "[[stages]]\ntype = 'isotropic_unloading'\n[[stages]]\ntype = 'unconfined_compression'\n";
  for (const std::string& text : {std::string("text"), scenario}) {
    write_run(folder / "run.h5", run_of(rows, text));
    const schema::FileReader file(folder / "run.h5");
    const Measurement m = measure_elastic_recovery(file, {});
    CHECK(m.window.stage == 1);
    CHECK(m.window.last_row == 60);
    CHECK(scenario_facts(file).stage_types.size() == (text == scenario ? 3 : 0));
    CHECK(scenario_facts(file).youngs_modulus.has_value() == (text == scenario));
  }
  CHECK(measure_elastic_recovery(schema::FileReader(folder / "run.h5"), 2).window.stage == 2);
  CHECK(measure_elastic_recovery(schema::FileReader(folder / "run.h5"), -2).window.stage == 1);
}

TEST_CASE("a hold between loading and unloading is not the unloading, though its density and stress fall a little") {
  const Folder folder;
  std::vector<Row> rows;
  for (const Row& row : loaded_and_unloaded(0.5, 1)) {
    rows.push_back(row);
    if (rows.size() == 21) // walls stand still: the density falls by rounding, the stress by what it rings
      for (int i = 1; i <= 20; ++i) rows.push_back(isotropic(1, 0.9 * (1 - 1e-14 * i), 80 - 0.1 * i));
    if (rows.size() > 41) rows.back().stage = 2;
  }
  SECTION("of walls that stand still") {}
  SECTION("of walls that hold a force") {
    for (std::size_t i = 21; i <= 40; ++i) rows[i] = isotropic(1, 0.9 - 1e-6 * static_cast<double>(i), 79.5);
  }
  for (Row& row : rows) row.elastic = row.axial_stress / 100;
  write_run(folder / "run.h5", run_of(rows));
  const schema::FileReader file(folder / "run.h5");
  const Measurement recovery = measure_elastic_recovery(file, {}), energy = measure_energy(file, {}, {});
  CHECK(recovery.window.stage == 2);
  CHECK(recovery.value > 0.02);
  CHECK(energy.window.stage == 2);
  CHECK(energy.value > 0.7);
}

TEST_CASE("the modulus of a straight reloading with noise is its slope, within the interval given") {
  const Folder folder;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto rows = reloading(
        200, 0.01, [](double e) { return 0.5 + 1500 * e; }, no_damage, 0.15, seed);
    const Measurement m = modulus(curve_of(folder, rows), {});
    INFO(seed << ": " << m.value << " " << m.uncertainty);
    // Noise is 1 % of the highest stress. Twenty trials: one may miss its 95 % interval, none by half of it more.
    CHECK(std::abs(m.value - 1500) <= 1.5 * m.uncertainty);
    CHECK(m.uncertainty < 0.12 * 1500);
    CHECK(within(m.value, 1500, 0.05));
    CHECK(m.details["unconfined"] == true);
    CHECK(m.notes.empty());
  }
}

TEST_CASE("the modulus is the initial slope of a curve that bends, within its uncertainty") {
  const Folder folder;
  const auto hyperbola = [](double e) { return 2000 * e / (1 + e / 0.02); };
  const auto rows = reloading(400, 0.05, hyperbola, no_damage, 0, 1);
  const Measurement m = modulus(curve_of(folder, rows), {});
  CHECK(std::abs(m.value - 2000) <= m.uncertainty);
  CHECK(within(m.value, 2000, 0.06)); // the rule's 5 % and what is left of higher order
  CHECK(m.window.strain[1] < 0.002);
  CHECK_THAT(m.method, Catch::Contains("change of slope"));
}

TEST_CASE("the window of the modulus ends before damage takes its share, and begins at the lowest stress") {
  const Folder folder;
  // The stress first falls while the lateral walls leave; damage begins at a strain of 0.004.
  const auto stress = [](double e) { return e < 0.001 ? 2 - 2000 * e : 1000 * (e - 0.001); };
  const auto damage = [](double e) { return e < 0.004 ? 0.0 : 0.5 * (e - 0.004); };
  const auto rows = reloading(500, 0.02, stress, damage, 0, 1);
  const Measurement m = modulus(curve_of(folder, rows), {});
  CHECK(within(m.value, 1000, 1e-9));
  CHECK(std::abs(m.window.strain[0] - 0.001) <= 0.0003); // smoothing rounds the corner over ten rows at most
  // Damage of 1 % of the work 1000 (e - 0.001)^2 / 2 (in 1 mm^3, to 1 %): 0.5 (e - 0.004) = 5 (e - 0.001)^2.
  const double b = -0.002 - 0.1, root = (-b - std::sqrt(b * b - 4 * (1e-6 + 0.1 * 0.004))) / 2;
  CHECK(within(m.window.strain[1], root, 0.03));
  CHECK_THAT(m.method, Catch::Contains("damage above 1 %"));
  CHECK(m.details["damage_over_axial_work"].get<double>() <= 0.01);
  ModulusRule by_hand;
  by_hand.strain_range = {0.002, 0.003};
  const Measurement narrow = modulus(curve_of(folder, rows), by_hand);
  CHECK(within(narrow.value, 1000, 1e-9));
  CHECK(narrow.window.first_row == 50);
  CHECK(narrow.window.last_row == 75);
}

TEST_CASE("a toe is left out of the modulus, and a note says so") {
  const Folder folder;
  // The slope grows from 300 to 1500 MPa up to a strain of 0.004, is even up to 0.02, and then falls.
  const auto stress = [](double e) {
    if (e < 0.004) return 300 * e + 0.5 * 300000 * e * e;
    return e < 0.02 ? 3.6 + 1500 * (e - 0.004) : 27.6 + 200 * (e - 0.02);
  };
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Measurement m = modulus(curve_of(folder, reloading(200, 0.03, stress, no_damage, 0.1, seed)), {});
    INFO(seed << ": " << m.value << " from " << m.window.strain[0]);
    CHECK(std::abs(m.value - 1500) <= m.uncertainty + 0.02 * 1500); // a rest of the toe within the rule's 5 %
    REQUIRE(m.notes.size() == 1);
    CHECK_THAT(m.notes.front(), Catch::Contains("toe"));
    CHECK(m.window.strain[0] > 0.002);
  }
}

TEST_CASE("outliers do not spoil a modulus") {
  const Folder folder;
  auto rows = reloading(
      200, 0.01, [](double e) { return 1200 * e; }, no_damage, 0.02, 5);
  for (std::size_t i = 12; i < rows.size(); i += 17) rows[i].axial_stress += 1.5; // a wall hit by a loose grain
  const Measurement m = modulus(curve_of(folder, rows), {});
  CHECK(within(m.value, 1200, 0.03));
}

TEST_CASE("the stress of an unconfined sample is that over the face at the stage's beginning") {
  const Folder folder;
  auto rows = reloading(
      100, 0.01, [](double e) { return 1000 * e; }, no_damage, 0, 1);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    rows[i].lateral_strain = -0.1; // the walls stand off, and the history divides the force by their larger face
    rows[i].axial_stress *= std::exp(-0.2);
  }
  CHECK(within(modulus(curve_of(folder, rows), {}).value, 1000, 1e-9));
  for (Row& row : rows) row.lateral_stress = 3; // with a lateral load it is the row's own face
  const Measurement confined = modulus(curve_of(folder, rows), {});
  CHECK(within(confined.value, 1000 * std::exp(-0.2), 1e-9));
  CHECK_THAT(confined.notes.front(), Catch::Contains("lateral walls carry load"));
}

TEST_CASE("unconfined strength is the peak, through ringing, within its uncertainty") {
  const Folder folder;
  // 20 MPa at 2 % strain, then a fall; ringing of 0.4 MPa with a period of 8 rows, of 9 in the window.
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto stress = [&](double e) {
      const double u = e / 0.02;
      return 20 * u * std::exp(1 - u) + 0.4 * std::sin(2 * std::numbers::pi * e / 0.05 * 200 / 8 + seed);
    };
    const auto rows = reloading(200, 0.05, stress, no_damage, 0.1, seed);
    const Measurement m = strength(curve_of(folder, rows), {});
    INFO(seed << ": " << m.value << " " << m.uncertainty);
    CHECK(std::abs(m.value - 20) <= m.uncertainty);
    CHECK(m.uncertainty < 1.5);
    CHECK(m.details["criterion"] == "peak");
    CHECK(m.details["test"] == "unconfined");
    CHECK(m.details["damage_onset_stress_MPa"].is_null());
  }
}

TEST_CASE("the onset of damage is where its growth begins") {
  const Folder folder;
  const auto stress = [](double e) { return e < 0.02 ? 1000 * e : 20 - 500 * (e - 0.02); };
  const auto damage = [](double e) { return e < 0.015 ? 0.001 * e : 0.001 * 0.015 + 2 * (e - 0.015); };
  const auto rows = reloading(400, 0.03, stress, damage, 0, 1);
  StrengthRule rule;
  rule.criterion = StrengthCriterion::damage_onset;
  const Measurement m = strength(curve_of(folder, rows), rule);
  // The corner is rounded over the 17 rows of the parabolas; the tangent beyond them is exact.
  CHECK(within(m.value, 15, 0.01));
  CHECK(within(m.details["damage_onset_strain"].get<double>(), 0.015, 0.01));
  CHECK(within(m.details["peak_MPa"].get<double>(), 20, 0.01)); // a sharp corner, cut by the parabola
}

TEST_CASE("the onset of damage is found where walls start slowly and damage is noisy") {
  const Folder folder;
  const auto stress = [](double e) { return e < 0.02 ? 1000 * e : 20 - 500 * (e - 0.02); };
  const auto damage = [](double e) { return e < 0.015 ? 0.02 * e : 0.02 * 0.015 + 2 * (e - 0.015); };
  for (unsigned seed = 1; seed <= 5; ++seed) {
    auto rows = reloading(400, 0.03, stress, damage, 0, seed);
    Noise noise(seed);
    // The first tenth of the strain as at constant acceleration from rest, and 0.5 % of what is dissipated as noise.
    for (std::size_t i = 0; i < 40; ++i) {
      rows[i].axial_strain = rows[40].axial_strain * std::pow(static_cast<double>(i) / 40, 2);
      rows[i].axial_stress = stress(rows[i].axial_strain);
      rows[i].damage = damage(rows[i].axial_strain);
    }
    for (Row& row : rows) row.damage += 5e-5 * noise();
    StrengthRule rule;
    rule.criterion = StrengthCriterion::damage_onset;
    INFO(seed);
    CHECK(within(strength(curve_of(folder, rows), rule).value, 15,
                 0.05)); // the steepest of many noisy slopes is a little too steep
  }
}

TEST_CASE("a stress that never falls is no peak, and the strength says so") {
  const Folder folder;
  const auto rows = reloading(
      100, 0.05, [](double e) { return 300 * e; }, no_damage, 0, 1);
  const Measurement m = strength(curve_of(folder, rows), {});
  CHECK(m.details["criterion"] == "largest");
  CHECK(within(m.value, 15, 1e-9));
  CHECK_THAT(m.notes.front(), Catch::Contains("no peak"));
}

TEST_CASE("a pulled sample has no compressive strength and no modulus") {
  const Folder folder;
  auto rows = reloading(
      100, 0.05, [](double e) { return -300 * e; }, no_damage, 0.01, 1);
  for (Row& row : rows) row.axial_strain *= -1;
  rows[60].axial_stress = 50; // a knock
  CHECK_THROWS_WITH(strength(curve_of(folder, rows), {}), Catch::Contains("axial compression"));
  CHECK_THROWS_WITH(modulus(curve_of(folder, rows), {}), Catch::Contains("not an axial loading"));
}

TEST_CASE("triaxial strength is the peak of q, else q at 15 % axial strain") {
  const Folder folder;
  const auto confined = [](std::vector<Row> rows) {
    for (Row& row : rows) {
      row.lateral_stress = 8;
      row.axial_stress += 8;
    }
    return rows;
  };
  const auto hardening = [](double e) { return 60 * (1 - std::exp(-e / 0.1)); };
  const auto softening = [](double e) { return 40 * (e / 0.04) * std::exp(1 - e / 0.04); };
  const Measurement hard = strength(curve_of(folder, confined(reloading(300, 0.2, hardening, no_damage, 0.1, 2))), {});
  CHECK(hard.details["criterion"] == "at-strain");
  CHECK(std::abs(hard.value - hardening(0.15)) <= hard.uncertainty);
  CHECK(hard.uncertainty < 0.5);
  const Measurement soft = strength(curve_of(folder, confined(reloading(300, 0.2, softening, no_damage, 0.1, 3))), {});
  CHECK(soft.details["criterion"] == "peak");
  CHECK(soft.details["test"] == "triaxial");
  CHECK(std::abs(soft.value - 40) <= soft.uncertainty);
  CHECK(within(soft.details["axial_strain_at_strength"].get<double>(), 0.04, 0.1));
  StrengthRule earlier;
  earlier.at_strain = 0.1;
  CHECK(within(strength(curve_of(folder, confined(reloading(300, 0.2, hardening, no_damage, 0, 2))), earlier).value,
               hardening(0.1), 1e-6));
  CHECK_THROWS_WITH(strength(curve_of(folder, confined(reloading(300, 0.12, hardening, no_damage, 0, 2))), {}),
                    Catch::Contains("the axial strain ends at 0.12"));
  // A test that is driven to 15 % stops short of it by rounding.
  const auto to_the_end = confined(reloading(300, 0.15 * (1 - 1e-10), hardening, no_damage, 0, 2));
  CHECK(within(strength(curve_of(folder, to_the_end), {}).value, hardening(0.15), 1e-3));
}

TEST_CASE("a probe yields where the dissipation has grown by 0.3 %, between two rows") {
  const Folder folder;
  std::vector<Row> rows = {isotropic(0, 0.9, 60)};
  rows[0].plastic = 9;
  rows[0].damage = 1;
  for (int i = 1; i <= 50; ++i) {
    Row row = isotropic(1, 0.9, 60);
    const double e = 0.0002 * i;
    row.axial_strain += e;
    row.axial_stress = 60 + 6000 * e;
    row.plastic = 9 + (e > 0.004 ? 20 * (e - 0.004) : 0.0);
    row.damage = 1 + (e > 0.004 ? 5 * (e - 0.004) : 0.0);
    rows.push_back(row);
  }
  const Measurement m = yield_point(curve_of(folder, rows, 1), 1.003);
  const double strain = 0.004 + 0.03 / 25; // growth by 25 mJ a unit of strain to 0.03 mJ
  CHECK(within(m.details["axial_strain_at_yield"].get<double>(), strain, 1e-9));
  CHECK(within(m.value, 6000 * strain, 1e-9));
  CHECK(within(m.details["mean_stress_MPa"].get<double>(), 60 + 2000 * strain, 1e-9));
  CHECK(within(m.uncertainty, 0.5 * 6000 * 0.0002, 1e-9));
  CHECK(within(m.details["axial_strain_at_yield_uncertainty"].get<double>(), 0.5 * 0.0002, 1e-9));
  CHECK(within(m.details["volumetric_strain_at_yield_uncertainty"].get<double>(), 0.5 * 0.0002, 1e-9));
  CHECK(within(m.details["damage_share_of_dissipation_since_start"].get<double>(), 0.2, 1e-6));
  CHECK(m.window.stage == 1);
  // The same found with rows four times as far apart, within the uncertainty that these have.
  std::vector<Row> sparse = {rows[0]};
  for (std::size_t i = 4; i < rows.size(); i += 4) sparse.push_back(rows[i]);
  const Measurement coarse = yield_point(curve_of(folder, sparse, 1), 1.003);
  CHECK(std::abs(coarse.value - m.value) <= coarse.uncertainty + 1e-9);
  // Ringing moves single rows: the interval that says so holds in 95 % of the trials.
  int held = 0;
  for (unsigned trial = 0; trial < 100; ++trial) {
    Noise noise(trial);
    std::vector<Row> ringing = rows;
    for (Row& row : ringing) row.axial_stress += 1.5 * noise();
    const Measurement noisy = yield_point(curve_of(folder, ringing, 1), 1.003);
    held += std::abs(noisy.value - 6000 * strain) <= noisy.uncertainty;
    CHECK(noisy.uncertainty < 5);
  }
  CHECK(held >= 88); // 95 +- 3 * 2.2
  CHECK_THROWS_WITH(yield_point(curve_of(folder, rows, 1), 1.1), Catch::Contains("does not yield"));
  for (Row& row : rows) row.plastic = row.damage = 0;
  CHECK_THROWS_WITH(yield_point(curve_of(folder, rows, 1), 1.003), Catch::Contains("nothing was dissipated before"));
}

TEST_CASE("load cycles have the area, drift and dissipation that were put into them") {
  const Folder folder;
  // p between 0.5 and 85 MPa, in every cycle 0.3 MPa higher (walls that overshoot); strain = p / 4000 -+ w sin(pi u) on
  // loading and unloading, drifting by -1e-4 a cycle: the area is 2 w times the integral of sin(pi u) over p, 2/pi of
  // the rise (the drift adds its share of the path's mean height).
  constexpr double w = 2e-4, low = 0.5, drift = -1e-4;
  const auto high = [](int cycle) { return 85 + 0.3 * cycle; };
  constexpr int half_rows = 60, cycles = 5;
  Noise noise(11);
  std::vector<Row> rows;
  for (int k = 0; k < cycles; ++k)
    for (int i = 0; i < 2 * half_rows; ++i) {
      const bool loading = i < half_rows;
      const double u = loading ? static_cast<double>(i) / half_rows : 2 - static_cast<double>(i) / half_rows;
      Row row = isotropic(0, 0.8, low + (high(k) - low) * u + 0.05 * noise());
      const double strain = (low + (high(k) - low) * u) / 4000 + (loading ? -w : w) * std::sin(std::numbers::pi * u) +
                            drift * (k + i / (2.0 * half_rows));
      row.axial_strain = row.lateral_strain = strain / 3;
      row.relative_density = 0.8 * std::exp(strain);
      row.plastic = 2.0 * (k + i / (2.0 * half_rows));
      row.damage = 0.002 * (k + i / (2.0 * half_rows));
      rows.push_back(row);
    }
  Row end = isotropic(0, 0.8 * std::exp(low / 4000 + drift * cycles), low);
  end.axial_strain = end.lateral_strain = (low / 4000 + drift * cycles) / 3;
  end.plastic = 2.0 * cycles;
  end.damage = 0.002 * cycles;
  rows.push_back(end);
  write_run(folder / "run.h5", run_of(rows));
  const auto result = measure_hysteresis(schema::FileReader(folder / "run.h5"), {});
  const Measurement& m = result.measurement;
  CHECK(m.details["cycles"] == cycles);
  CHECK(m.notes.empty());
  const double rise = high(cycles - 1) - low, area = 2 * w * 2 / std::numbers::pi * rise + drift * 0.5 * rise;
  // Noise of 0.05 MPa on 120 steps of strain of 4e-4, and turning points that it moves by a row.
  CHECK(within(m.value, area, 0.05));
  CHECK(m.uncertainty < 0.1 * area);
  // A drift of strain is one of ln D. Rows are 1.4 MPa apart, noise 0.05 MPa: 1e-5 in strain, over four steps.
  CHECK(std::abs(m.details["drift_of_relative_density_at_high_stress_per_cycle"].get<double>() - 0.8 * drift) < 1e-5);
  CHECK(std::abs(m.details["drift_of_relative_density_at_low_stress_per_cycle"].get<double>() - 0.8 * drift) < 1e-5);
  const auto column = [&](const std::string& name) {
    return std::find_if(result.cycles.begin(), result.cycles.end(), [&](const Column& c) { return c.name == name; })
        ->values;
  };
  for (const double plastic : column("plastic_dissipation")) CHECK(within(plastic, 2, 0.03)); // a row or two of 120
  for (const double damage : column("damage_dissipation")) CHECK(within(damage, 0.002, 0.03));
}

TEST_CASE("an unclosed cycle does not count, and a first loading from zero stress does") {
  CHECK(find_cycles(std::vector<double>{0, 10, 20, 30, 20, 12}).empty());
  CHECK(find_cycles(std::vector<double>{30, 20, 1, 15, 30}).empty());
  CHECK(find_cycles(std::vector<double>{5, 5, 5}).empty());
  const auto one = find_cycles(std::vector<double>{0, 10, 30, 31, 20, 1});
  REQUIRE(one.size() == 1);
  CHECK(one[0].begin == 0);
  CHECK(one[0].top == 3);
  CHECK(one[0].end == 5);
  CHECK(find_cycles(std::vector<double>{85, 40, 1, 40, 84, 40, 1, 40, 85, 40, 0.5, 40}).size() == 2);
}

TEST_CASE("a first loading from between the cycles' stresses is distinguished from whole cycles and does not count") {
  const std::vector<double> p = {40, 60, 85, 40, 1, 40, 85, 40, 1, 40, 85, 40, 1};
  const auto rows_of_cycles = find_cycles(p);
  REQUIRE(rows_of_cycles.size() == 3);
  CHECK_FALSE(rows_of_cycles[0].whole);
  CHECK(rows_of_cycles[1].whole);
  CHECK(rows_of_cycles[1].begin == 4);
  CHECK(find_cycles(std::vector<double>{1, 60, 85, 40, 1, 60, 85, 1})[0].whole);

  // Density grows by 0.05 in the first loading, and by 0.001 in each cycle after it.
  std::vector<Row> rows;
  for (std::size_t i = 0; i < p.size(); ++i) {
    Row row = isotropic(0, 0.75 + (i < 2 ? 0.0 : 0.05) + 0.001 * static_cast<double>((i + 2) / 4) + p[i] / 1e5, p[i]);
    row.plastic = i < 4 ? 0.1 * static_cast<double>(i) : 0.4;
    rows.push_back(row);
  }
  const Folder folder;
  write_run(folder / "run.h5", run_of(rows));
  const HysteresisMeasurement result = measure_hysteresis(schema::FileReader(folder / "run.h5"), {});
  const Measurement& m = result.measurement;
  CHECK(m.details["cycles"] == 2);
  CHECK(m.window.first_row == 4);
  CHECK(within(m.details["drift_of_relative_density_at_high_stress_per_cycle"].get<double>(), 0.001, 1e-6));
  REQUIRE(m.notes.size() == 1);
  CHECK_THAT(m.notes.front(), Catch::Contains("begins at 40 MPa"));
  CHECK(result.cycles[0].values == std::vector<double>{0, 1, 2}); // its numbers stay those of the cycles
  // One whole cycle has no drift, not one of zero.
  rows.resize(9);
  write_run(folder / "two.h5", run_of(rows));
  const Measurement one = measure_hysteresis(schema::FileReader(folder / "two.h5"), {}).measurement;
  CHECK(one.details["cycles"] == 1);
  CHECK(one.details["drift_of_relative_density_at_low_stress_per_cycle"].is_null());
  CHECK(one.details["drift_uncertainty"].is_null());
  CHECK_THAT(one.brief, Catch::Contains("no drift from one cycle"));
  // Alone it is no cycle at all.
  rows.resize(6);
  write_run(folder / "one.h5", run_of(rows));
  CHECK_THROWS_WITH(measure_hysteresis(schema::FileReader(folder / "one.h5"), {}), Catch::Contains("no whole cycle"));
}

TEST_CASE("a rectangle between two strains encloses its area, with a drift or without") {
  const std::vector<double> p = {1, 11, 11, 1, 1}, strain = {0, 0, 0.02, 0.02, 0};
  CHECK(within(loop_area(p, strain, {0, 2, 4}), 10 * 0.02, rounding));
  const std::vector<double> open = {0, 0, 0.02, 0.02, 0.005};
  CHECK(within(loop_area(p, open, {0, 2, 4}), 10 * 0.02, rounding));
}

TEST_CASE("an unloading releases elastic energy, also over E R^3") {
  const Folder folder;
  std::vector<Row> rows = loaded_and_unloaded(0, 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double p = rows[i].axial_stress;
    rows[i].elastic = 0.1 + p * p / 8000;
    rows[i].damage = i > 20 ? 0.001 * static_cast<double>(i - 20) : 0;
  }
  write_run(folder / "run.h5", run_of(rows, "[material]\nyoungs_modulus = 5000\n"));
  const schema::FileReader file(folder / "run.h5");
  const Measurement m = measure_energy(file, {}, {5000.0, 0.07});
  CHECK(within(m.value, 0.8, rounding));
  CHECK(within(m.details["elastic_energy_locked_in_mJ"].get<double>(), 0.1, rounding));
  CHECK(within(m.details["damage_dissipation_in_unloading_mJ"].get<double>(), 0.04, rounding));
  CHECK(m.details["plastic_dissipation_in_unloading_mJ"] == 0);
  CHECK(within(m.details["elastic_energy_released_over_scale"].get<double>(), 0.8 / (5000 * 0.07 * 0.07 * 0.07),
               rounding));
  CHECK(measure_energy(file, {}, {}).details["energy_scale_mJ"].is_null());
  // Vibration moves energy to and fro without loss: what is released is off by it in two rows, and nothing else.
  Noise noise(5);
  double squares = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Row> ringing = rows;
    for (Row& row : ringing) row.elastic += 0.01 * noise();
    write_run(folder / "ringing.h5", run_of(ringing));
    squares += std::pow(measure_energy(schema::FileReader(folder / "ringing.h5"), {}, {}).value - 0.8, 2) / 100;
  }
  CHECK(within(std::sqrt(squares), std::sqrt(2.0) * 0.01, 0.25)); // 100 trials know it to 7 %
  // Without an unloading: the end, and a note.
  rows.resize(21);
  write_run(folder / "loading.h5", run_of(rows));
  const Measurement loading = measure_energy(schema::FileReader(folder / "loading.h5"), {}, {});
  CHECK(loading.value == 0);
  CHECK(within(loading.details["elastic_energy_locked_in_mJ"].get<double>(), 0.9, rounding));
  CHECK_THAT(loading.notes.front(), Catch::Contains("no unloading"));
  // A requested stage that does not exist.
  const Measurement grown = measure_energy(file, 0, {});
  CHECK(grown.value < 0);
  REQUIRE(grown.notes.size() == 1);
  CHECK_THAT(grown.notes.front(), Catch::Contains("grows"));
  CHECK(m.notes.empty());
}

TEST_CASE("the mean radius is that of the grains' volumes at the reference density") {
  const Folder folder;
  RunContents contents = small_run(); // two grains of 4 mm^3 each in a box of 27 mm^3
  contents.numbers["/snapshots/*/relative_density"] = {0.4};
  write_run(folder / "run.h5", contents);
  const auto radius = mean_radius_of_run(schema::FileReader(folder / "run.h5"));
  REQUIRE(radius);
  // The halves of the tets need not be halves of the volume, but their sum is 0.4 * 27; the mean radius hardly knows.
  CHECK(within(*radius, std::cbrt(3 * 0.4 * 27 / 2 / (4 * std::numbers::pi)), 0.02));
}

TEST_CASE("a mean radius is taken from the run's own packing only, as the solver recognises it") {
  const Folder folder;
  const MeshedPacking grains = eight_grains(4);
  write_packing(folder / "own.h5", grains, std::vector<double>(8, 0.125));
  write_packing(folder / "other.h5", eight_grains(5), std::vector<double>(8, 0.125));
  RunContents contents = small_run();
  const std::uint64_t of_nodes_and_tets =
      hash_values(std::span<const std::int32_t>(grains.tet), hash_values(std::span<const double>(grains.node)));
  contents.texts["/provenance/packing_hash"] = {hash_text(hash_of_mesh(of_nodes_and_tets, grains))};
  write_run(folder / "run.h5", contents);
  const schema::FileReader run(folder / "run.h5");
  CHECK(mean_radius_of_packing(folder / "own.h5", run) == 0.125);
  CHECK_THROWS_WITH(mean_radius_of_packing(folder / "other.h5", run),
                    Catch::Contains("other.h5: is not the packing of ") && Catch::Contains("run.h5, allowed: "));
}

TEST_CASE("the contact-area ratio is followed through the run") {
  const Folder folder;
  std::vector<Row> rows = loaded_and_unloaded(0, 1);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].contact_area = 0.1 * static_cast<double>(i);
    rows[i].coordination = 6;
  }
  write_run(folder / "run.h5", run_of(rows));
  const schema::FileReader file(folder / "run.h5");
  const Measurement m = measure_contact(file, {});
  CHECK(within(m.value, 0.6, rounding));
  CHECK(within(m.details["contact_area_ratio_at_start"].get<double>(), 0.2, rounding));
  CHECK(m.details["coordination_number_at_end"] == 6);
  CHECK(m.uncertainty < 1e-12); // an even change is no scatter
  CHECK(m.window.first_row == 54);
  CHECK(within(measure_contact(file, 0).value, 0.2, rounding));
  const auto columns = contact_history(HistoryTable(file));
  CHECK(within(columns[5].values[30], 0.3, rounding));
  // Noise comes out as the uncertainty: Student's t of four degrees of freedom, 2.776, times a standard deviation of as
  // many, which is 0.940 of the noise's in the mean; 200 of them know that to 3 %.
  Noise noise(7);
  double mean = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Row> noisy = rows;
    for (Row& row : noisy) row.contact_area += 0.05 * noise(); // of 10 mm^2
    write_run(folder / "noisy.h5", run_of(noisy));
    const Measurement found = measure_contact(schema::FileReader(folder / "noisy.h5"), {});
    CHECK(std::abs(found.value - 0.6) < 5 * 0.005);
    mean += found.uncertainty / 200;
  }
  CHECK(within(mean, 2.776 * 0.940 * 0.005, 0.1));
}

TEST_CASE("metric commands write JSON with value, unit, uncertainty, window and method, and one line") {
  const Folder folder;
  std::vector<Row> rows = loaded_and_unloaded(0.5, 1);
  const auto add = [&](int stage, auto stress) {
    for (int i = 1; i <= 60; ++i) {
      Row row = rows.back();
      row.stage = stage;
      row.axial_strain += 0.0005;
      row.lateral_stress = 0;
      row.axial_stress = stress(0.0005 * i);
      row.plastic += 0.01;
      rows.push_back(row);
    }
  };
  add(2, [](double e) { return 1000 * e * std::exp(-e / 0.015); });
  write_run(folder / "run.h5", run_of(rows, "[material]\nyoungs_modulus = 5000\n"));
  const std::string run = folder / "run.h5", out = folder / "out.json";
  for (const auto& [command, unit] : std::vector<std::pair<std::string, std::string>>{{"elastic-recovery", "1"},
                                                                                      {"modulus", "MPa"},
                                                                                      {"strength", "MPa"},
                                                                                      {"yield", "MPa"},
                                                                                      {"hysteresis", "MPa"},
                                                                                      {"energy", "mJ"},
                                                                                      {"contact --history", "1"}}) {
    const Outcome outcome = postproc(fmt::format("{} {} -o {}", command, run, out));
    INFO(command << ": " << outcome.messages);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.output.find('\n') == outcome.output.size() - 1);
    CHECK_THAT(outcome.output, Catch::StartsWith(command.substr(0, command.find(' ')) + ": "));
    const auto json = nlohmann::json::parse(read_text(out));
    CHECK(json["unit"] == unit);
    CHECK(json["value"].is_number());
    CHECK(json["uncertainty"].is_number());
    CHECK(json["method"].is_string());
    CHECK(json["window"]["last_row"].is_number());
    CHECK(postproc(fmt::format("{} {} -o {} --quiet", command, run, out)).output.empty());
    CHECK_THAT(postproc(command.substr(0, command.find(' ')) + " --help").output, Catch::Contains("Example: postproc"));
  }
  CHECK(nlohmann::json::parse(read_text(out))["metric"] == "contact");
  const Outcome ledger = postproc("energy " + run);
  CHECK(ledger.exit_code == 0);
  CHECK_THAT(ledger.output, Catch::StartsWith("time [s],"));
  REQUIRE(postproc(fmt::format("hysteresis {} --cycles {}", run, folder / "cycles.csv")).exit_code == 0);
  CHECK_THAT(read_text(folder / "cycles.csv"), Catch::StartsWith("cycle [1],first_row [1],"));
}

TEST_CASE("a metric of a run that did not end says so") {
  const Folder folder;
  RunContents contents = run_of(loaded_and_unloaded(0.5, 1));
  const std::string run = folder / "run.h5", json = folder / "out.json";
  for (const std::string status : {"complete", "interrupted", "failed: a tet is inverted"}) {
    contents.texts["/provenance/status"] = {status};
    write_run(run, contents);
    for (const std::string command : {"elastic-recovery", "energy", "contact --history"}) {
      const Outcome outcome = postproc(fmt::format("{} {} -o {}", command, run, json));
      INFO(command << ": " << outcome.messages);
      REQUIRE(outcome.exit_code == 0);
      const std::string expected = fmt::format("the run is not complete ({})", status);
      CHECK((outcome.messages.find(expected) != std::string::npos) == (status != "complete"));
      CHECK((read_text(json).find(expected) != std::string::npos) == (status != "complete"));
    }
  }
}

TEST_CASE("no command writes under the ending of another format") {
  const Folder folder;
  write_run(folder / "run.h5", run_of(loaded_and_unloaded(0, 1)));
  write_text(folder / "points.csv", "x,y\n1,2\n2,4\n3,7\n");
  const std::string run = " " + (folder / "run.h5") + " ", csv = folder / "out.csv", png = folder / "out.png",
                    json = folder / "out.json";
  const std::string fit = "fit " + (folder / "points.csv") + " --x x --y y --model linear ";
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {"curve" + run + "-o " + png, "--output " + png + ": found the ending '.png', allowed: .csv"},
           {"summary" + run + "-o " + png, "allowed: .csv or .json"},
           {"energy" + run + "-o " + png, "allowed: .csv or .json"},
           {"contact" + run + "-o " + png, "allowed: .csv or .json"},
           {"elastic-recovery" + run + "-o " + csv, "found the ending '.csv', allowed: .json"},
           {"view" + run + "-o " + png, "allowed: .html"},
           {"hysteresis" + run + "--cycles " + json, "--cycles " + json + ": found the ending '.json', allowed: .csv"},
           {"stress-at-densities" + run + "--densities 0.7 --data " + png, "--data " + png + ": found the ending"},
           {fit + "-o " + csv, "allowed: .json"},
           {fit + "--curve " + json, "allowed: .csv"}}) {
    const Outcome outcome = postproc(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    for (const std::string& file : {csv, png, json}) CHECK_FALSE(std::filesystem::exists(file));
  }
  CHECK(postproc("curve" + run + "-o " + (folder / "curve.txt")).exit_code == 0);
}

TEST_CASE("an axial strain for the strength of an unconfined test is refused") {
  const Folder folder;
  std::vector<Row> rows;
  for (int i = 0; i <= 40; ++i)
    rows.push_back({.axial_strain = 0.001 * i, .axial_stress = 20.0 - 0.05 * (i - 20) * (i - 20)});
  write_run(folder / "run.h5", run_of(rows));
  REQUIRE(postproc("strength " + (folder / "run.h5")).exit_code == 0);
  const Outcome outcome = postproc("strength " + (folder / "run.h5") + " --at-strain 0.02");
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages,
             Catch::Contains("--at-strain: found for stage 0, an unconfined test, allowed: for a tri"));
}

TEST_CASE("metric commands refuse what they cannot use with one line and exit code 2") {
  const Folder folder;
  std::vector<Row> loading(loaded_and_unloaded(0, 1));
  loading.resize(21);
  write_run(folder / "run.h5", run_of(loading));
  const std::string run = folder / "run.h5";
  std::vector<Row> short_rows(loading.begin(), loading.begin() + 4);
  write_run(folder / "short.h5", run_of(short_rows));
  const std::string four = folder / "short.h5";
  for (const auto& [arguments, expected] : std::vector<std::pair<std::string, std::string>>{
           {"elastic-recovery " + run, "no unloading"},
           {"elastic-recovery " + run + " --stage 0", "densest row is the last"},
           {"elastic-recovery " + run + " --stage 3", "found 3, allowed: 0"},
           {"modulus " + run + " --stage -2", "found -2"},
           {"modulus " + four, "has 4 rows"},
           {"modulus " + run + " --strain-range 0.3,0.2", "low < high"},
           {"modulus " + run + " --strain-range 5,6", "fewer than 3 rows"},
           {"strength " + four, "has 4 rows"},
           {"strength " + run + " --test triaxial", "never rises"},
           {"strength " + run + " --test unconfined --criterion damage-onset", "no onset"},
           {"yield " + run, "nothing was dissipated before"},
           {"hysteresis " + run, "no whole cycle"},
           {"triaxial " + run + " --lateral-stress 8", "found no stage of type triaxial_compression, allowed: a run"},
           {"unload-reload-modulus " + run, "found no stage of type unconfined_compression, allowed: a run"},
           {"energy " + run + " --stage 7 -o " + (folder / "x.json"), "found 7"},
           {"energy " + run + " --packing " + run + " -o " + (folder / "x.json"), "run"},
           {"energy " + run + " --packing " + run + " --mean-radius 0.1 -o " + (folder / "x.json"),
            "--mean-radius: found together with --packing, allowed: one of them"},
           {"contact --history " + run + " --stage 7", "found 7"},
           {"contact " + run + " --stage 0", "--history"},
           {"contact --history " + run + " --pair 0,1", "allowed: one of them"},
           {"contact --history " + run + " --snapshot 99", "--snapshot: found together with --history"},
           {"contact --history " + run + " --view " + (folder / "x.png"), "--view: found together with --history"},
           {"contact " + run + " --title x", "--title: found without --view, allowed: with --pair and --view"},
           {"contact " + run + " --pair 0,1 --pixels 99", "--pixels: found without --view"},
           {"energy " + run + " --stage 99",
            "--stage: found with CSV, which has the energies of all rows, allowed: with"},
           {"energy " + run + " --packing " + run + " -o " + (folder / "x.csv"), "--packing: found with CSV"},
           {"modulus " + run + " --strain-range 0,0.1 --need-window",
            "--need-window: found together with --strain-range"},
           {"strength " + run + " --criterion damage-onset --drop 0.1", "--drop: found together with --criterion"},
           {"diametral " + run + " --flat-angle 10 --face-distance 0.1", "--face-distance: found together with"},
           {"watch " + run + " --once --interval 3", "--interval: found together with --once"},
           {"section " + run + " --data " + (folder / "x.csv") + " --title x", "--title: found without a picture"},
           {"section " + run + " --data " + (folder / "x.csv") + " --position 99", "the plane at 99 mm cuts no grain"},
           {"section " + run + " --field grain --range 0,1 -o " + (folder / "x.png"), "--range: found with the field"},
           {"density-map " + run + " --pixels 99", "--pixels: found without a picture, allowed: with -o FILE.png"},
           {"elastic-recovery " + (folder / "absent.h5"), "no such file"},
           {"strength " + run + " -o " + run, "would overwrite the input"}}) {
    const Outcome outcome = postproc(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("postproc"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    for (const char* file : {"x.json", "x.csv", "x.png"}) CHECK_FALSE(std::filesystem::exists(folder / file));
  }
  for (const std::string arguments : {"yield --ratio 0.9 ", "strength --test bending ", "modulus --slope-change 2 "})
    CHECK(postproc(arguments + run).exit_code == 2);
}
