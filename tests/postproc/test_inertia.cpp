// Kinetic share and inertial number of stages, on runs written down row by row.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "postproc/metrics/inertia.hpp"
#include "postproc/metrics/quasi_static.hpp"
#include "postproc/metrics/summary.hpp"
#include "postproc/metrics/triaxial_test.hpp"
#include "stage_run.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double rounding_of_sums = 1e-12; // sums and products of a few numbers of one size

schema::FileReader file_of(const Folder& folder, const RunContents& contents) {
  write_run(folder / "run.h5", contents);
  return schema::FileReader(folder / "run.h5");
}

/// A box that strains by 0.01 and 0.03 a microsecond along z, half as fast across it, under 3 and 12 MPa.
std::vector<Row> straining() {
  return {{.axial_strain = 0, .lateral_strain = 0, .axial_stress = 3, .lateral_stress = 3, .relative_density = 0.6},
          {.axial_strain = 0.01, .lateral_strain = 0.005, .axial_stress = 3, .lateral_stress = 3},
          {.axial_strain = 0.04, .lateral_strain = 0.02, .axial_stress = 12, .lateral_stress = 12}};
}

const std::string material = "[material]\ndensity = 2e-9\nyoungs_modulus = 5000\n";

} // namespace

TEST_CASE("a test's kinetic energy is compared with its own internal energy, without the plastic work of the "
          "compaction before") {
  const Folder folder;
  RunContents contents = run_of({{.stage = 0, .axial_stress = 9, .lateral_stress = 8, .plastic = 90, .elastic = 2},
                                 {.stage = 1, .axial_stress = 9, .lateral_stress = 8, .plastic = 90, .elastic = 2},
                                 {.stage = 1, .axial_stress = 40, .lateral_stress = 8, .plastic = 92, .elastic = 6}});
  contents.numbers["/history/kinetic_energy"] = {7, 0.02, 0.16}; // of the stage before: not counted
  contents.numbers["/history/bond_energy"] = {0, 0, 1};
  contents.numbers["/history/contact_energy"] = {0, 0, 0.5};
  contents.numbers["/history/damage_dissipation"] = {10, 10, 10.5};
  const HistoryTable history(file_of(folder, contents));
  const StageRows stage = stages_of(history, {}).back();
  const double largest = 0.16 / (6 + 1 + 0.5 + 2 + 0.5); // over all that is stored and dissipated since the start: 107
  CHECK(triaxial_test(history, stage, 8, {}).details["kinetic_over_internal"].get<double>() ==
        Approx(largest).epsilon(rounding_of_sums));
  CHECK(quasi_static(history, stage, {}).details["kinetic_over_internal"].get<double>() ==
        Approx(largest).epsilon(rounding_of_sums));
  CHECK(quasi_static(history, stage, {}).details["inertial_number"].is_null());
}

TEST_CASE("the inertial number is strain rate times diameter times the root of density over mean stress") {
  const Folder folder;
  RunContents contents = run_of(straining(), material);
  const schema::FileReader file = file_of(folder, contents);
  const HistoryTable history(file);
  const auto grains = grain_inertia(file, history);
  REQUIRE(grains);
  CHECK(grains->density == 2e-9);
  CHECK(grains->diameter ==
        Approx(std::cbrt(6 * 0.6 / (2 * std::numbers::pi))).epsilon(rounding_of_sums)); // two grains
  const auto numbers = inertial_numbers(history, *grains);
  CHECK(numbers[0] == 0);                                                                          // nothing before it
  CHECK(numbers[1] == Approx(0.01 / 1e-6 * grains->diameter * std::sqrt(2e-9 / 3)).epsilon(1e-9)); // a log of an exp
  CHECK(numbers[2] == Approx(0.03 / 1e-6 * grains->diameter * std::sqrt(2e-9 / 12)).epsilon(1e-9));
  const StageRows stage = stages_of(history, {}).back();
  const Measurement m = triaxial_test(history, stage, 3, grains);
  CHECK(m.details["largest_inertial_number"].get<double>() == std::max(numbers[1], numbers[2]));
  CHECK(m.details["inertial_number"].get<double>() == 0.5 * (numbers[1] + numbers[2])); // the median of two
  CHECK(summarise(file).largest_inertial_number == std::max(numbers[1], numbers[2]));
}

TEST_CASE("a stage's first row and one without stress have no inertial number") {
  const Folder folder;
  auto rows = straining();
  rows[1].stage = rows[2].stage = 1;
  rows[2].axial_stress = rows[2].lateral_stress = 0;
  const HistoryTable history(file_of(folder, run_of(rows)));
  CHECK(inertial_numbers(history, {.density = 2e-9, .diameter = 0.1}) == std::vector<double>{0, 0, 0});
}

TEST_CASE("the inertial number uses the density of all grains with the run's mass scaling, or is not known") {
  const Folder folder;
  const auto density = [&](const std::string& scenario) {
    return scenario_facts(file_of(folder, run_of(straining(), scenario))).density;
  };
  CHECK(*density(material + "[numerics]\nmass_scaling = 100\n") == Approx(2e-7).epsilon(rounding_of_sums));
  CHECK(density(material + "[[grain_material]]\ngrains = [0]\ndensity = 2e-9\n") == 2e-9);
  CHECK_FALSE(density(material + "[[grain_material]]\ngrains = [0]\ndensity = 3e-9\n"));
  CHECK_FALSE(density(material + "[numerics]\nmass_scaling_step = 1e-8\n"));
  CHECK_FALSE(density("[bond]\n"));
  CHECK_FALSE(density("no scenario at all"));
}
