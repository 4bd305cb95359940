// Malformed scenarios, given to mpfem check.

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "folder.hpp"
#include "limited_program.hpp"
#include "malformed_toml.hpp"

using namespace mpfem::test;

namespace {

/// Every table, and most keys. The keys of other kinds of stages have separate tests.
const char* const good_scenario = R"(packing = 'packing.h5'
walls = true
[material]
density = 1.55e-9
youngs_modulus = 5000.0
poissons_ratio = 0.3
[material.hardening]
law = 'power'
yield_stress = 30.0
coefficient = 100.0
exponent = 0.5
[[grain_material]]
grains = [0, 3]
density = 2e-9
youngs_modulus = 7000.0
poissons_ratio = 0.25
[grain_material.hardening]
law = 'table'
plastic_strain = [0, 0.1]
flow_stress = [30, 40]
[contact]
stiffness_factor = 10.0
search_margin = 0.3
surface = 'smooth'
[bond]
tensile_strength = 25.0
shear_strength = 18.0
fracture_energy = 0.5
softening = 'energy'
rebond = 'never'
normal_only = false
[numerics]
time_step_factor = 0.9
step_estimate = 'grain'
bulk_viscosity_linear = 0.06
bulk_viscosity_quadratic = 1.2
mass_scaling = 100.0
mass_scaling_step = 1e-9
mass_scaling_lighten = false
[element]
type = 'tet4-anp'
own_pressure = 0.02
precision = 'mixed'
[output]
history_rows = 100
snapshot_relative_densities = [0.6]
checkpoint_relative_densities = [0.7]
snapshot_at_stage_end = true
checkpoint_interval = 60.0
[initial]
velocity = [0, 0, 1]
grain_velocity = [[0, 0, 1]]
grain_angular_velocity = [[0, 0, 1]]
[[stages]]
type = 'triaxial_compression'
name = 'load'
wall_speed = 100.0
servo_speed = 1000.0
ramp_fraction = 0.1
hold = 'stress'
lateral_stress = 5.0
axial_strain = 0.1
axial_stress = 50.0
deviatoric_stress = 40.0
stress_drop = 0.5
dissipation_ratio = 1.5
duration = 0.1
damping_rate = 10.0
damping_fade_stress = 1.0
)";

/// Stages, each of which is refused for its last key.
const std::vector<std::pair<std::string, std::string>> bad_stages = {
    {"type = 'isotropic_compaction'\nwall_speed = 1\nrelative_density", "0"},
    {"type = 'isotropic_compaction'\nwall_speed = 1\nrelative_density", "1.3"},
    {"type = 'isotropic_compaction'\nrelative_density = 0.7\nwall_speed", "0"},
    {"type = 'isotropic_compaction'\nrelative_density = 0.7\nwall_speed", "1e300"},
    {"type = 'isotropic_compaction'\nrelative_density = 0.7\nwall_speed = 1\nramp_fraction", "0.6"},
    {"type = 'isotropic_compaction'\nrelative_density = 0.7\nwall_speed = 1\nduration", "1"},
    {"type = 'isotropic_compaction'\nwall_speed = 1\nmean_stress", "0"},
    {"type = 'isotropic_unloading'\nwall_speed = 1\nmean_stress", "-1"},
    {"type = 'isotropic_unloading'\nwall_speed = 1\nmean_stress", "1e300"},
    {"type = 'grip'\nspeed = 1\ndisplacement = 1\ngrip_depth", "0"},
    {"type = 'grip'\nspeed = 1\ndisplacement = 1\ngrip_depth", "1e300"},
    {"type = 'grip'\nspeed = 1\ngrip_depth = 1\ndisplacement", "0"},
    {"type = 'grip'\nspeed = 1\ngrip_depth = 1\ndisplacement", "-1e300"},
    {"type = 'grip'\ngrip_depth = 1\ndisplacement = 1\nspeed", "0"},
    {"type = 'grip'\ngrip_depth = 1\nspeed = 1\nsliding", "[0, 0, 1]"},
    {"type = 'grip'\ngrip_depth = 1\nspeed = 1\nsliding", "[1, 0]"},
    {"type = 'grip'\ngrip_depth = 1\nspeed = 1\nsliding", "[1e300, 0, 0]"},
    {"type = 'grip'\ngrip_depth = 1\nspeed = 1\ndisplacement = 1\naxis", "'w'"},
    {"type = 'hold'\nduration", "0"},
    {"type = 'hold'\nduration", "1e300"},
    {"type = 'hold'\nduration = 1\nservo_speed", "1"},
    {"type = 'hold'\nduration = 1\nmean_stress = 1\nservo_speed", "0"},
    {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain", "0"},
    {"type = 'unconfined_compression'\nwall_speed = 1\naxial_strain", "0.6"},
    {"type = 'unconfined_compression'\nwall_speed = 1\nstress_drop", "1"},
    {"type = 'unconfined_compression'\nwall_speed = 1\ndissipation_ratio", "1"},
    {"type = 'unconfined_compression'\nwall_speed = 1\nlateral_stress", "1"},
    {"wall_speed = 1\ntype", "'unconfined_compression'"},
    {"wall_speed = 1\ntype", "'compaction'"},
    {"wall_speed = 1\ntype", "''"},
    {"type = 'die_compression'\nwall_speed = 1\nrelative_density", "-0.1"},
    {"type = 'probe'\nwall_speed = 1\nmean_stress = 1\ndirection", "[0, 0]"},
    {"type = 'probe'\nwall_speed = 1\nmean_stress = 1\ndirection", "[1]"},
    {"type = 'probe'\nwall_speed = 1\nmean_stress = 1\ndirection", "[1e300, 1e300]"},
    {"type = 'stress_cycles'\nwall_speed = 1\nhighest_mean_stress = 2\nlowest_mean_stress = 1\ncycles", "0"},
    {"type = 'stress_cycles'\nwall_speed = 1\nhighest_mean_stress = 2\nlowest_mean_stress = 1\ncycles", "1.5"},
    {"type = 'stress_cycles'\nwall_speed = 1\nhighest_mean_stress = 2\ncycles = 1\nlowest_mean_stress", "2"},
    {"type = 'hold'\nduration = 1\nname", "'a/b'"},
    {"type = 'hold'\nduration = 1\nname", "''"},
    {"type = 'hold'\nduration = 1\ndamping_fade_stress", "1"},
};

class Scenarios {
public:
  Scenarios() { write_text(folder_ / "run.h5", "what was there before"); }

  void refused(const std::string& text, std::vector<std::string> names, std::vector<std::string> more = {}) {
    write_text(folder_ / "scenario.toml", text);
    std::vector<std::string> arguments = {"run", folder_ / "scenario.toml", "-o", folder_ / "run.h5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    CHECK(fault_of_refusal(MPFEM_EXECUTABLE, arguments, names) == "");
    CHECK(read_text(folder_ / "run.h5") == "what was there before");
    CHECK_FALSE(std::filesystem::exists(folder_ / "run.h5.partial"));
  }

private:
  Folder folder_;
};

} // namespace

TEST_CASE("A scenario with one spoilt value is refused with file, key and line") {
  Scenarios scenarios;
  for (const MalformedText& document : spoilt_documents(good_scenario)) {
    if (document.what == "walls = {}") continue; // walls may be a table: this one says nothing else
    INFO(document.what);
    std::vector<std::string> names = document.names;
    names.push_back("scenario.toml");
    scenarios.refused(document.text, names);
  }
}

TEST_CASE("A scenario that is no document is refused") {
  Scenarios scenarios;
  for (const MalformedText& document : hopeless_documents()) {
    INFO(document.what);
    std::vector<std::string> names = document.names;
    names.push_back("scenario.toml");
    scenarios.refused(document.text, names);
  }
}

TEST_CASE("A stage whose last key is wrong is refused with that key") {
  Scenarios scenarios;
  const std::string material = "packing = 'p.h5'\n[material]\ndensity = 1e-9\nyoungs_modulus = 5000\npoissons_ratio = "
                               "0.3\nhardening.law = 'elastic'\n[[stages]]\n";
  for (const auto& [before, value] : bad_stages) {
    const std::string text = material + before + " = " + value + "\n";
    const std::string key = before.substr(before.rfind('\n') + 1);
    INFO(before << " = " << value);
    scenarios.refused(text, {"scenario.toml:", key});
  }
}

TEST_CASE("Grain numbers, tables of hardening and stages that do not fit together are refused") {
  Scenarios scenarios;
  const auto changed = [](std::string from, const std::string& to) {
    std::string text = good_scenario;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [from, to, name] : std::vector<std::array<std::string, 3>>{
           {"grains = [0, 3]", "grains = [1e300]", "1e+300"},
           {"grains = [0, 3]", "grains = [-1]", "grains"},
           {"grains = [0, 3]", "grains = [0.5]", "whole"},
           {"grains = [0, 3]", "grains = [0, 0]", "twice"},
           {"grains = [0, 3]", "grains = []", "no grain"},
           {"youngs_modulus = 5000.0", "youngs_modulus = 0", "youngs_modulus"},
           {"density = 1.55e-9", "density = 1e-300", "density"},
           {"poissons_ratio = 0.3", "poissons_ratio = 0.5", "poissons_ratio"},
           {"poissons_ratio = 0.3", "poissons_ratio = -1", "poissons_ratio"},
           {"exponent = 0.5", "exponent = 0", "exponent"},
           {"exponent = 0.5", "exponent = 1e-300", "exponent"},
           {"plastic_strain = [0, 0.1]", "plastic_strain = [0, 0]", "plastic_strain"},
           {"plastic_strain = [0, 0.1]", "plastic_strain = [0.1, 0.2]", "plastic_strain"},
           {"flow_stress = [30, 40]", "flow_stress = [30]", "flow_stress"},
           {"flow_stress = [30, 40]", "flow_stress = [1e6, 1]", "flow_stress"},
           {"[grain_material.hardening]", "[grain_material]", ":17"},
           {"history_rows = 100", "history_rows = 0", "history_rows"},
           {"history_rows = 100", "history_rows = 9223372036854775807", "history_rows"},
           {"history_rows = 100", "history_rows = 9223372036854775808", ":45"},
           {"checkpoint_relative_densities = [0.7]", "checkpoint_relative_densities = [0.7, 0.7]", "steps of at least"},
           {"velocity = [0, 0, 1]", "velocity = [0, 0]", "velocity"},
           {"grain_velocity = [[0, 0, 1]]", "grain_velocity = [0, 0, 1]", "grain_velocity"},
           {"packing = 'packing.h5'", "packing = ''", "packing"},
           {"packing = 'packing.h5'", "packing = \"a\\u0000b\"", "packing"},
           {"packing = 'packing.h5'", "packing = 'none.h5'", "none.h5"},
           {"packing = 'packing.h5'", "packing = '.'", "file"},
           {"packing = 'packing.h5'", "packing = 'scenario.toml'", "HDF5"},
           {"packing = 'packing.h5'", "packing = '/dev/zero'", "/dev/zero"},
           {"[[stages]]", "[stages]", "stages"},
           {"walls = true", "walls = false", "walls"},
       }) {
    INFO(to);
    scenarios.refused(changed(from, to), {name});
  }
}

TEST_CASE("Assignments that are none are refused by their text") {
  Scenarios scenarios;
  std::string endless = "a";
  for (int i = 0; i < 40'000; ++i) endless += ".a";
  for (const std::string& assignment : {std::string(),
                                        std::string("="),
                                        std::string("a"),
                                        std::string("=1"),
                                        std::string(".=1"),
                                        std::string("a.=1"),
                                        std::string("a..b=1"),
                                        std::string("walls="),
                                        std::string("walls=nan"),
                                        std::string("material=1"),
                                        std::string("material.density=nan"),
                                        std::string("material.density=1e999"),
                                        std::string("stages.9.name=a"),
                                        std::string("stages.-1.name=a"),
                                        std::string("stages.18446744073709551616.name=a"),
                                        std::string("stages.x=1"),
                                        std::string("stages=[]"),
                                        std::string("stages=[1]"),
                                        std::string("walls.deeper=1"),
                                        std::string("a[0]=1"),
                                        std::string("a b=1"),
                                        std::string("'a'=1"),
                                        std::string("material.density=[[1]"),
                                        std::string("material.density={"),
                                        std::string("material.density=\"x"),
                                        std::string("a\nb=1"),
                                        std::string("walls=true\nx=1"),
                                        std::string("material.density=1\n"),
                                        std::string(100'000, 'x'),
                                        std::string("material.density=") + std::string(100'000, '9'),
                                        endless.substr(0, 60'000) + "=1",
                                        std::string("material.density=") + std::string(60'000, '[')}) {
    INFO(assignment.substr(0, 60));
    scenarios.refused(good_scenario, {"--set"}, {"--set=" + assignment});
  }
}

TEST_CASE("A scenario that is no regular file, or too large, is refused at once") {
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  REQUIRE(std::filesystem::create_directory(folder / "empty"));
  write_text(folder / "large.toml", "");
  std::filesystem::resize_file(folder / "large.toml", std::uintmax_t{1} << 36U); // it has no blocks on the disk
  const std::string far = std::string("/") + std::string(100'000, 'x');
  for (const std::string& path :
       {folder / "pipe", folder / "empty", folder / "none", folder / "large.toml", std::string("/dev/zero"),
        std::string("/dev/null"), std::string("/dev/tty"), std::string("-"), far, folder / "none/none"}) {
    INFO(path.substr(0, 60));
    for (const char* command : {"check", "run", "bench"}) {
      std::vector<std::string> arguments = {command, path};
      if (std::string(command) == "run") arguments.insert(arguments.end(), {"-o", folder / "run.h5"});
      CHECK(fault_of_refusal(MPFEM_EXECUTABLE, arguments, {path.substr(0, 30)}) == "");
    }
  }
}

TEST_CASE("A packing or run in place of a scenario is refused as an HDF5 file, also where it is large") {
  const Folder folder;
  write_text(folder / "run.h5", "\x89HDF\r\n\x1a\n" + std::string(1000, '['));
  CHECK(fault_of_refusal(MPFEM_EXECUTABLE, {"check", folder / "run.h5"},
                         {"run.h5: found an HDF5 file, allowed: a text file (TOML)"}) == "");
  std::filesystem::resize_file(folder / "run.h5", std::uintmax_t{1} << 36U); // it has no blocks on the disk
  CHECK(fault_of_refusal(MPFEM_EXECUTABLE, {"check", folder / "run.h5"}, {"found an HDF5 file"}) == "");
}

TEST_CASE("A packing that cannot be read is refused at its key in the scenario, or with the assignment") {
  const Folder folder;
  write_text(folder / "scenario.toml", good_scenario);
  const std::string place = folder / "scenario.toml";
  for (const char* command : {"check", "run"}) {
    std::vector<std::string> arguments = {command, place, "--set=packing=none.h5"};
    if (std::string(command) == "run") arguments.insert(arguments.end(), {"-o", folder / "run.h5"});
    CHECK(fault_of_refusal(MPFEM_EXECUTABLE, arguments,
                           {"--set packing=", "key 'packing': ", "none.h5: no such file"}) == "");
  }
}

TEST_CASE("A packing on the command line is relative to the working folder, with quotes or without") {
  const Folder folder;
  std::filesystem::create_directory(folder / "scenarios");
  write_text(folder / "scenarios/scenario.toml", good_scenario);
  std::vector<std::string> messages;
  for (const std::string packing : {"none.h5", R"("none.h5")", "'none.h5'"}) {
    const Outcome outcome =
        run_command(fmt::format(R"(cd '{}' && '{}' check scenarios/scenario.toml --set packing={})", folder / ".",
                                MPFEM_EXECUTABLE, packing[0] == '\'' ? '"' + packing + '"' : '\'' + packing + '\''));
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.messages, Catch::Contains("key 'packing': ") && Catch::Contains("none.h5: no such file"));
    messages.push_back(outcome.messages);
  }
  CHECK(messages == std::vector<std::string>(3, messages[0]));
}

TEST_CASE("A scenario as large as is read is refused within the memory that it may take") {
  Scenarios scenarios;
  std::string text = "packing = [";
  while (text.size() < 8'000'000) text += "1,1,1,1,1,1,1,1,";
  scenarios.refused(text + "]\n", {"scenario.toml", "packing"});
}
