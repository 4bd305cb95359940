// What the plan of a run says of implausible values and of its time.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "solver/run/plan_text.hpp"
#include "solver/run/plausibility.hpp"
#include "tests/support/small_runs.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

std::vector<std::string> remarks(double density, double youngs_modulus) {
  Scenario scenario;
  scenario.material.density = density;
  scenario.material.youngs_modulus = youngs_modulus;
  return implausible_values(scenario);
}

} // namespace

TEST_CASE("densities and moduli of solids are plausible, from an aerogel to osmium and from a gel to diamond") {
  CHECK(remarks(1.55e-9, 5000).empty());
  CHECK(remarks(1.1e-10, 1e-2).empty());
  CHECK(remarks(2.26e-8, 1.2e5).empty());
  CHECK(remarks(3.5e-9, 9e5).empty());
}

TEST_CASE("a density or modulus in another unit is named with what it would be in that of scenarios") {
  CHECK(remarks(1.55, 5000) ==
        std::vector<std::string>{"material.density = 1.55 tonne/mm^3 is far from any solid; 1.55 g/cm^3 is 1.55e-09 "
                                 "tonne/mm^3"});
  CHECK(remarks(1550, 5000) ==
        std::vector<std::string>{"material.density = 1550 tonne/mm^3 is far from any solid; 1550 kg/m^3 is 1.55e-09 "
                                 "tonne/mm^3"});
  CHECK(remarks(1.55e-6, 5000) ==
        std::vector<std::string>{"material.density = 1.55e-06 tonne/mm^3 is far from any solid; 1.55e-06 kg/mm^3 is "
                                 "1.55e-09 tonne/mm^3"});
  CHECK(remarks(1.55e-9, 5e9) ==
        std::vector<std::string>{"material.youngs_modulus = 5e+09 MPa is far from any solid; 5e+09 Pa is 5000 MPa"});
  CHECK(remarks(1e-18, 5000) == std::vector<std::string>{"material.density = 1e-18 tonne/mm^3 is far from any solid"});
}

TEST_CASE("implausible values of other grains are named, and they are appended to a refusal") {
  Scenario scenario;
  scenario.material.density = 1.55e-9, scenario.material.youngs_modulus = 5000;
  CHECK(implausible_values_hint(scenario).empty());
  scenario.grain_materials.emplace_back().material = scenario.material;
  scenario.grain_materials[0].material.density = 7.8;
  CHECK(implausible_values_hint(scenario) == "; grain_material.0.density = 7.8 tonne/mm^3 is far from any solid; 7.8 "
                                             "g/cm^3 is 7.8e-09 tonne/mm^3");
}

TEST_CASE("a modulus in Pa is accepted, and the plan and the run say that no solid has it") {
  const Folder folder;
  prepare(folder, 3, replaced(scenario_text, "youngs_modulus = 5000", "youngs_modulus = 5e9"));
  const Outcome plan = mpfem_command("check " + (folder / "scenario.toml"));
  CHECK(plan.exit_code == 0);
  CHECK_THAT(plan.output, Catch::Contains("\nwarning        material.youngs_modulus = 5e+09 MPa is far from any solid; "
                                          "5e+09 Pa is 5000 MPa\n"));
  const Outcome run =
      mpfem_command(fmt::format("run {} -o {} --time-limit 0.001", folder / "scenario.toml", folder / "run.h5"));
  CHECK(run.exit_code == 5);
  CHECK_THAT(run.messages,
             Catch::Contains("mpfem: warning: material.youngs_modulus = 5e+09 MPa is far from any solid"));
}

TEST_CASE("a forecast of time above a minute is in minutes, hours or days") {
  CHECK(wall_time_text(0.0123) == "0.0123 s");
  CHECK(wall_time_text(59.9) == "59.9 s");
  CHECK(wall_time_text(90) == "1.5 min");
  CHECK(wall_time_text(3540) == "59 min");
  CHECK(wall_time_text(3599) == "1 h 0 min");
  CHECK(wall_time_text(9580) == "2 h 40 min");
  CHECK(wall_time_text(450000) == "5.21 days");
}
