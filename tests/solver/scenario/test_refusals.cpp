// Scenarios and command lines that are refused, and help.

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "results-schema/file.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/small_runs.hpp"

using namespace mpfem;
using namespace mpfem::test;
using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("grains of another material are named by numbers that the packing has, each once") {
  const Folder folder;
  prepare(folder, 2);
  const auto check = [&](const std::string& grains) {
    write_text(folder / "scenario.toml", replaced(scenario_text, "[output]",
                                                  "[[grain_material]]\ngrains = " + grains +
                                                      "\ndensity = 1e-9\nyoungs_modulus = 500\npoissons_ratio = 0.2\n"
                                                      "[grain_material.hardening]\nlaw = 'elastic'\n[output]"));
    return mpfem_command("check " + (folder / "scenario.toml"));
  };
  CHECK(check("[0, 7]").exit_code == 0);
  for (const auto& [grains, expected] :
       std::vector<std::pair<std::string, std::string>>{{"[8]", "found grain 8, allowed: 0 … 7"},
                                                        {"[1, 1]", "found 1 twice"},
                                                        {"[]", "no grain"},
                                                        {"[0.5]", "whole"}}) {
    const Outcome outcome = check(grains);
    INFO(grains << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.messages, Catch::Contains(expected) && Catch::Contains("grain_material"));
  }
}

TEST_CASE("friction is refused where it means nothing, and walls may be true, false or a table") {
  const Folder folder;
  prepare(folder, 2, bonded_text);
  const auto check = [&](const std::string& set) {
    return mpfem_command(fmt::format("check {} {}", folder / "scenario.toml", set));
  };
  for (const char* set : {"--set contact.friction=0.3", "--set walls.friction=0.3", "--set walls.friction=0",
                          "--set walls=true", "--set contact.friction=0.3 --set bond.stiffness_factor=10",
                          "--set contact.friction=0 --set bond.normal_only=true"}) {
    const Outcome outcome = check(set);
    INFO(set << ": " << outcome.messages);
    CHECK(outcome.exit_code == 0);
  }
  for (const auto& [set, expected] : std::vector<std::pair<std::string, std::string>>{
           {"--set contact.friction=-0.1", "contact.friction"},
           {"--set contact.friction=2.5", "contact.friction"},
           {"--set walls.friction=3", "walls.friction"},
           {"--set contact.pair=[{materials=[0,1],friction=0.1}]", "contact.pair"},
           {"--set contact.pair=[{materials=[0],friction=0.1}]", "found 1 numbers, allowed: two"},
           {"--set contact.pair=[{materials=[0,0],friction=3}]", "friction"},
           {"--set contact.pair=[{materials=[0,0],friction=0},{materials=[0,0],friction=1}]", "twice"},
           {"--set walls.frction=0.3", "friction"},
           {"--set walls=0.3", "allowed: true or false"},
           {"--set contact.friction=0.3 --set bond.normal_only=true", "cannot be used with 'bond.normal_only'"},
           {"--set contact.friction=0.3 --set bond.stiffness_factor=20", "up to contact.stiffness_factor = 10"},
           {"--set contact.friction=0.3 --set bond.stiffness=1e9", "the smallest penalty of a contact point"}}) {
    const Outcome outcome = check(set);
    INFO(set << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("mpfem"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
  }
}

TEST_CASE("keys of loadings are checked like all others") {
  const Folder folder;
  prepare(folder, 2);
  struct Case {
    std::string stage;
    std::vector<std::string> expected;
  };
  const std::vector<Case> cases = {
      {"type = 'isotropic_compaction'\nwall_speed = 1\nmean_stress = 1\nrelative_density = 0.9",
       {"mean_stress", "relative_density"}},
      {"type = 'isotropic_compaction'\nwall_speed = 1", {"without an end", "relative_density or mean_stress"}},
      {"type = 'unconfined_compression'\nwall_speed = 1", {"without an end", "axial_strain"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain = 0", {"axial_strain", "found 0"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain = 2", {"axial_strain", "2"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain = 1e-9",
       {"axial_strain", "found 1e-09", "at least 1e-06", "at most -1e-06"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain = 0.1\nhold = 'force'",
       {"hold", "cannot be used", "unconfined_compression"}},
      {"type = 'unconfined_compression'\nwall_speed = 1\nstress_drop = 1", {"stress_drop", "< 1"}},
      {"type = 'triaxial_compression'\nwall_speed = 1\naxial_strain = 0.1\nhold = 'strain'", {"hold", "strain"}},
      {"type = 'die_compression'\nwall_speed = 1\nstress_drop = 0.5", {"stress_drop", "cannot be used"}},
      {"type = 'die_compression'\nwall_speed = 1e9\naxial_strain = 0.1", {"wall_speed", "allowed: at most"}},
      {"type = 'triaxial_compression'\nwall_speed = 1\nservo_speed = 1e9\naxial_strain = 0.1",
       {"servo_speed", "allowed: at most"}},
      {"type = 'probe'\nwall_speed = 1\ndissipation_ratio = 1.1\ndirection = [1]", {"direction", "two numbers"}},
      {"type = 'probe'\nwall_speed = 1\ndissipation_ratio = 1.1\ndirection = [0, 0]", {"direction", "not both 0"}},
      {"type = 'probe'\nwall_speed = 1\ndissipation_ratio = 0.9\ndirection = [1, 0]", {"dissipation_ratio", "> 1"}},
      {"type = 'probe'\nwall_speed = 1\nmean_stress = 9\ndirection = [0, 1]", {"mean_stress", "dp = 0"}},
      {"type = 'probe'\nwall_speed = 1\ndeviatoric_stress = 9\ndirection = [-1, 0]", {"deviatoric_stress", "dq = 0"}},
      {"type = 'stress_cycles'\nwall_speed = 1\nlowest_mean_stress = 5\nhighest_mean_stress = 5\ncycles = 1",
       {"lowest_mean_stress", "5"}},
      {"type = 'stress_cycles'\nwall_speed = 1\nlowest_mean_stress = 1\nhighest_mean_stress = 5\ncycles = 0",
       {"cycles", "0"}},
      {"type = 'hold'\nduration = 1e-6\nquasi_static = {}", {"quasi_static", "something moves"}},
      {"type = 'die_compression'\nwall_speed = 5\naxial_strain = 0.1\nquasi_static = { fastest_speed = 4 }",
       {"quasi_static.fastest_speed", "4", "5 …"}},
      {"type = 'die_compression'\nwall_speed = 5\naxial_strain = 0.1\nquasi_static = { kinetic = 0.1 }",
       {"quasi_static.kinetic", "kinetic_tolerance"}},
      {"type = 'die_compression'\nwall_speed = 5\nduration = 1\nquasi_static = {}", {"duration", "cannot be used"}},
      {"type = 'die_compression'\nwall_speed = 5\naxial_strain = 0.1\nquasi_static = { fastest_speed = 1e9 }",
       {"quasi_static.fastest_speed", "allowed: at most"}},
  };
  for (const Case& c : cases) {
    write_text(folder / "scenario.toml", scenario_text + "[[stages]]\n" + c.stage + "\n");
    const Outcome outcome = mpfem_command("check " + (folder / "scenario.toml"));
    INFO(c.stage << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    for (const std::string& part : c.expected) CHECK_THAT(outcome.messages, Catch::Contains(part));
  }
  write_text(folder / "scenario.toml",
             replaced(scenario_text, "[output]", "[output]\ncheckpoint_relative_densities = [0.5, 0.5001]"));
  const Outcome outcome = mpfem_command("check " + (folder / "scenario.toml"));
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.messages, Catch::Contains("checkpoint_relative_densities") && Catch::Contains("0.001"));
}

TEST_CASE("a default that does not fit other keys is not reported as found") {
  const Folder folder;
  prepare(folder, 2);
  const std::string loading = "type = 'triaxial_compression'\naxial_strain = 0.1\nwall_speed = ";
  const auto refused = [&](const std::string& keys) {
    write_text(folder / "scenario.toml", scenario_text + "[[stages]]\n" + loading + keys + "\n");
    const Outcome outcome = mpfem_command("check " + (folder / "scenario.toml"));
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("mpfem"));
    return outcome.messages;
  };
  CHECK_THAT(refused("2e5"), Contains("key 'servo_speed': missing, by default 2e+06 mm/s, allowed: at most"));
  CHECK_THAT(refused("2e5\nservo_speed = 3e6"), Contains("key 'servo_speed': found 3e+06 mm/s, allowed: at most"));
  CHECK_THAT(refused("2e4\nservo_speed = 2e5\nquasi_static = { fastest_speed = 2e5 }"),
             Contains("key 'servo_speed': found 200000 mm/s times 10 with quasi_static, allowed: at most"));
  CHECK_THAT(refused("5e5\nservo_speed = 5e5\nquasi_static = {}"),
             Contains("key 'quasi_static.fastest_speed': missing, by default 2e+06 mm/s, allowed: at most"));
}

TEST_CASE("what makes a run too long or its history too large, and an STL file, is named by its place and key") {
  const Folder folder;
  prepare(folder, 2);
  const auto refused = [&](const std::string& text) {
    write_text(folder / "scenario.toml", text);
    const Outcome outcome = mpfem_command("check " + (folder / "scenario.toml"));
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("mpfem"));
    return outcome.messages;
  };
  const std::string place = "scenario.toml:";
  CHECK_THAT(refused(replaced(scenario_text, "wall_speed = 20000", "wall_speed = 1e-6")),
             Contains(place) && Contains(": key 'wall_speed': found 1e-06 mm/s, which takes "));
  CHECK_THAT(refused(scenario_text + "[[stages]]\ntype = 'hold'\nduration = 1e3\n"),
             Contains(place) && Contains(": key 'duration': found 1000 s, which takes "));
  CHECK_THAT(refused(scenario_text + "[[tools]]\nname = 'die'\ntype = 'stl'\nscale = 1\nfile = 'none.stl'\n"),
             Contains(place) && Contains("tool 'die': key 'file': ") && Contains("none.stl: no such file"));
}

TEST_CASE("every bad input is refused with one clear line and exit code 2") {
  const Folder folder;
  prepare(folder, 2);
  const std::string good = folder / "packing.h5";
  MeshedPacking inverted = eight_grains(2);
  std::swap(inverted.tet[4 * 70], inverted.tet[4 * 70 + 1]);
  write_packing(folder / "inverted.h5", inverted, std::vector<double>(8, 0.1));
  const auto write_overlapping = [&](const std::string& name, double shift) {
    MeshedPacking overlapping = eight_grains(2);
    for (std::int32_t n = overlapping.grain_node_offset[3]; n < overlapping.grain_node_offset[4]; ++n)
      overlapping.node[3 * static_cast<std::size_t>(n)] -= shift;
    write_packing(folder / name, overlapping, std::vector<double>(8, 0.1));
  };
  write_overlapping("overlapping.h5", 0.05);
  write_overlapping("deep.h5", 0.1); // deeper than contact of a run may ever be
  write_text(folder / "nothing.h5", "not an HDF5 file");
  MeshedPacking twice = eight_grains(2); // a tet of the last grain a second time
  twice.tet.insert(twice.tet.end(), twice.tet.end() - 4, twice.tet.end());
  ++twice.grain_tet_offset.back();
  write_packing(folder / "twice.h5", twice, std::vector<double>(8, 0.1));
  MeshedPacking copies = eight_grains(2);
  std::copy_n(copies.node.begin(), 3 * copies.grain_node_offset[1],
              copies.node.begin() + 3 * copies.grain_node_offset[1]);
  write_packing(folder / "copies.h5", copies, std::vector<double>(8, 0.1));
  MeshedPacking flat = eight_grains(2);
  flat.box_lengths[1] = 0;
  write_packing(folder / "flat.h5", flat, std::vector<double>(8, 0.1));

  struct Case {
    std::string from, to;              ///< change of the good scenario
    std::vector<std::string> expected; ///< all of these are in the message
  };
  const std::vector<Case> cases = {
      {"density = 1.55e-9", "density = = 1", {"scenario.toml:3"}},
      {"exponent = 0.3", "exponent = 0.3\nexponnent = 1", {"scenario.toml:11", "exponnent", "exponent"}},
      {"exponent = 0.3", "exponent = 1.3", {"scenario.toml:10", "exponent", "1.3", "0.001 … 1"}},
      {"youngs_modulus = 5000", "youngs_modulus = nan", {"youngs_modulus", "nan"}},
      {"youngs_modulus = 5000", "", {"youngs_modulus", "missing"}},
      {"packing.h5", "absent.h5", {"scenario.toml:1:11: key 'packing': ", "absent.h5: no such file"}},
      {"density = 1.55e-9",
       "density = 1.55",
       {"wall_speed",
        "; material.density = 1.55 tonne/mm^3 is far from any solid; 1.55 g/cm^3 is 1.55e-09 tonne/mm^3"}},
      {"packing.h5", "nothing.h5", {"nothing.h5", "not an HDF5 file"}},
      {"packing.h5", "inverted.h5", {"inverted.h5", "row 70", "inverted"}},
      {"packing.h5", "overlapping.h5", {"overlapping.h5", "grains 2 and 3"}},
      {"packing.h5", "deep.h5", {"deep.h5", "grains 2 and 3 overlap"}},
      {"packing.h5\"",
       "overlapping.h5\"\nbond = {tensile_strength = 25, shear_strength = 18, fracture_energy = 0.5}",
       {"overlapping.h5", "grains 2 and 3"}},
      {"packing.h5", "twice.h5", {"twice.h5", "grain 7"}},
      {"packing.h5", "copies.h5", {"copies.h5", "grains 0 and 1", "same place"}},
      {"packing.h5", "flat.h5", {"flat.h5", "/box/lengths"}},
      {"[output]", "[contact]\nsearch_margin = 1e-6\n[output]", {"search_margin", "0.05"}},
      {"[output]", "[contact]\nsurface = \"round\"\n[output]", {"surface", "round", "facets", "smooth"}},
      {"[output]", "[initial]\ngrain_velocity = [[1, 0, 0]]\n[output]", {"1 rows for 8 grains"}},
      {"damping_fade_stress = 5",
       "damping_fade_stress = 5\n[[stages]]\ntype = \"isotropic_compaction\"\nrelative_density = 0.61\nwall_speed = "
       "1e4",
       {"0.61", "0.6200"}},
      {"wall_speed = 20000", "wall_speed = 1e300", {"wall_speed", "1e+300", "… 1e+12"}},
      {"wall_speed = 20000", "wall_speed = 1e9", {"wall_speed", "allowed: at most"}},
      {"relative_density = 0.62", "relative_density = 1.4", {"relative_density", "1.4"}},
      {"relative_density = 0.62", "relative_density = 0.1", {"relative_density", "0.1", "0.3467"}},
      {"\"isotropic_compaction\"", "\"squeeze\"", {"squeeze", "isotropic_compaction", "hold"}},
      {"wall_speed = 20000", "wall_speed = -1", {"wall_speed", "-1", "1e-12 …"}},
  };
  for (const Case& c : cases) {
    write_text(folder / "scenario.toml", replaced(scenario_text, c.from, c.to));
    for (const std::string command : {"run", "check"}) {
      const Outcome outcome = mpfem_command(command + " " + (folder / "scenario.toml") +
                                            (command == "run" ? " -o " + (folder / "run.h5") : ""));
      INFO(c.to << ": " << outcome.messages);
      CHECK(outcome.exit_code == 2);
      CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), '\n') == 1);
      CHECK(outcome.messages.starts_with("mpfem: error: "));
      for (const std::string& part : c.expected) CHECK_THAT(outcome.messages, Catch::Contains(part));
      CHECK_FALSE(fs::exists(folder / "run.h5"));
      CHECK_FALSE(fs::exists(folder / "run.h5.partial"));
    }
  }

  write_text(folder / "scenario.toml", scenario_text);
  for (const std::string& arguments :
       {fmt::format("run {} -o {}", folder / "absent.toml", folder / "run.h5"),
        fmt::format("run {} -o {}", folder / "scenario.toml", folder / "no-such-folder/run.h5"),
        fmt::format("run {} -o {} --set stages.3.wall_speed=1", folder / "scenario.toml", folder / "run.h5"),
        fmt::format("run {} -o {} --from {}", folder / "scenario.toml", folder / "run.h5", folder / "packing.h5"),
        fmt::format("run {} -o {}", folder / "scenario.toml", folder / "packing.h5"),
        fmt::format("run {} -o {}", folder / "scenario.toml", folder / "scenario.toml"),
        fmt::format("run {} -o ''", folder / "scenario.toml")}) {
    const Outcome outcome = mpfem_command(arguments);
    INFO(arguments << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), '\n') == 1);
  }
}

TEST_CASE("every command has help and version") {
  for (const std::string arguments :
       {"--help", "run --help", "check --help", "bench --help", "bond --help", "--version"})
    CHECK(mpfem_command(arguments).exit_code == 0);
  CHECK(mpfem_command("").exit_code == 2);
  CHECK(mpfem_command("fly").exit_code == 2);
}
