// Numbers that are none, put into a run on purpose: every type of stage stops within a step and says where.

#include <limits>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/table_reader.hpp"
#include "solver/run/simulation.hpp"
#include "solver/scenario/read_scenario.hpp"
#include "tests/support/material_text.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr int poisoned_grain = 5;

/// A short compaction, then the stage with these keys; one entry for each type of stage.
const std::vector<std::string> stages_of_all_types = {
    "type = \"isotropic_compaction\"\nrelative_density = 0.75\nwall_speed = 20000\n",
    "type = \"isotropic_compaction\"\nmean_stress = 500\nwall_speed = 20000\n",
    "type = \"isotropic_unloading\"\nmean_stress = 0\nwall_speed = 1000\n",
    "type = \"stress_cycles\"\nlowest_mean_stress = 1\nhighest_mean_stress = 500\ncycles = 1\nwall_speed = 20000\n",
    "type = \"unconfined_compression\"\naxial_strain = 0.3\nwall_speed = 20000\n",
    "type = \"die_compression\"\naxial_strain = 0.3\nwall_speed = 20000\n",
    "type = \"triaxial_compression\"\naxial_strain = 0.3\nwall_speed = 20000\n",
    "type = \"probe\"\ndirection = [1, 1]\nmean_stress = 900\nwall_speed = 20000\n",
    "type = \"hold\"\nmean_stress = 30\nduration = 1e-5\n",
    "type = \"hold\"\nduration = 1e-5\n",
    "type = \"grip\"\ngrip_depth = 0.03\ndisplacement = 0.015\nspeed = 20000\n"};

Scenario scenario_with(const std::string& stage) {
  return read_scenario(TomlDocument::from_text(material_text + R"([[stages]]
name = "pressed"
type = "isotropic_compaction"
relative_density = 0.7
wall_speed = 40000
damping_rate = 1e6
damping_fade_stress = 5
[[stages]]
name = "poisoned"
)" + stage,
                                               "scenario.toml"));
}

/// A simulation that is twenty steps into its second stage.
void go_into_second_stage(Simulation& simulation) {
  simulation.evaluate_forces();
  while (!simulation.stage_complete()) {
    simulation.advance();
    simulation.evaluate_forces();
  }
  simulation.begin_next_stage();
  for (int i = 0; i < 20; ++i) {
    simulation.advance();
    simulation.evaluate_forces();
    REQUIRE_FALSE(simulation.stage_complete());
  }
}

/// What a simulation says that fails within two steps; empty where it does not.
std::string failure_within_two_steps(Simulation& simulation) {
  try {
    for (int i = 0; i < 2; ++i) {
      simulation.advance();
      simulation.evaluate_forces();
    }
  } catch (const SimulationError& error) {
    return error.what();
  }
  return {};
}

struct Poison {
  const char* what;
  void (*apply)(Model& model);
};

std::size_t first_row(const Model& model) {
  return 4 * static_cast<std::size_t>(model.node_offset[poisoned_grain]);
}
/// Inner nodes come after those of the surface.
std::size_t inner_row(const Model& model) {
  return first_row(model) + 4 * static_cast<std::size_t>(model.surface_node_count[poisoned_grain]);
}

const std::vector<Poison> poisons = {
    {"velocity of a surface node",
     [](Model& m) { m.velocity[first_row(m) + 1] = std::numeric_limits<double>::quiet_NaN(); }},
    {"velocity of an inner node", [](Model& m) { m.velocity[inner_row(m)] = std::numeric_limits<double>::infinity(); }},
    {"force on an inner node", [](Model& m) { m.force[inner_row(m) + 2] = std::numeric_limits<double>::quiet_NaN(); }},
    {"an inner node thrown through its grain", [](Model& m) { m.position[inner_row(m) + 2] += 0.15; }}};

} // namespace

TEST_CASE(
    "a value that is not finite stops every type of stage within two steps and is located by grain, tet and place") {
  ThreadTeam team(1);
  for (const std::string& keys : stages_of_all_types)
    for (const ElementType element : {ElementType::tet4, ElementType::tet4_anp})
      for (const Poison& poison : poisons) {
        Scenario scenario = scenario_with(keys);
        scenario.numerics.element = element;
        Simulation simulation(build_model(eight_grains(3), scenario, "test"), scenario, team);
        go_into_second_stage(simulation);
        poison.apply(simulation.model_to_disturb());
        const std::string message = failure_within_two_steps(simulation);
        INFO(keys << poison.what << ": " << message);
        CHECK_THAT(message, Catch::Contains("step ") && Catch::Contains(fmt::format("grain {}", poisoned_grain)) &&
                                Catch::Contains("tet ") && Catch::Contains("likely causes"));
      }
}
