// Is average nodal pressure free of weak modes? The measurements of studies/nodal-pressure; each prints CSV.
//
//   nodal-pressure frequencies
//     eigenfrequencies of a free elastic sphere
//   nodal-pressure vibration ELEMENT R/h MODE STEPS SPEED VISCOSITY
//     one free elastic grain; MODE: spheroidal, breathing, torsional, noise; SPEED mm/s at the surface, at first;
//     VISCOSITY: bulk viscosity over its default
//   nodal-pressure cycles ELEMENT PACKING.h5 CYCLES
//     a packing of Table 1 compacted to 60 MPa, then cycles of 1 to 60 MPa
//   nodal-pressure flattening ELEMENT R/h
//     one elasto-plastic sphere between walls, to half of its height
//
// ELEMENT: tet4, tet4-anp, tet4-patch. R/h: radius over nominal element size.

#include <algorithm>
#include <complex>
#include <cstdlib>
#include <string>

#include <fmt/format.h>

#include "pack-gen/random.hpp"
#include "solver/run/stages/isotropic_loading.hpp"
#include "tests/support/free_sphere.hpp"
#include "tests/support/pressed_column.hpp"
#include "tests/support/volume_state.hpp"

namespace {

using namespace mpfem;
using namespace mpfem::test;

constexpr double radius = 0.1, youngs_modulus = 5000, poissons_ratio = 0.3, density = 1.55e-9;

ElementType element_of(const std::string& name) {
  return name == "tet4-anp"     ? ElementType::tet4_anp
         : name == "tet4-patch" ? ElementType::tet4_patch
                                : ElementType::tet4;
}

struct ModeName {
  const char* name;
  SphereMode mode;
  int l;
};
constexpr ModeName modes[] = {{"torsional", SphereMode::torsional, 2},
                              {"spheroidal", SphereMode::spheroidal, 2},
                              {"breathing", SphereMode::spheroidal, 0}};

void frequencies() {
  fmt::print("mode,l,omega_radius_over_shear_speed,frequency [1/s]\n");
  for (const ModeName& m : modes)
    fmt::print("{},{},{:.6f},{:.6e}\n", m.name, m.l, sphere_eigenvalue(m.mode, m.l, poissons_ratio),
               sphere_frequency(m.mode, m.l, radius, youngs_modulus, poissons_ratio, density) / (2 * M_PI));
}

/// Angular frequency (1/s) at which the windowed Fourier sum of samples, `step` s apart, is largest, within `range` of
/// a guess.
double peak_frequency(const std::vector<double>& sample, double step, double guess, double range) {
  const auto power = [&](double omega) {
    std::complex<double> sum = 0, turn = std::polar(1.0, -omega * step), phase = 1;
    for (std::size_t i = 0; i < sample.size(); ++i, phase *= turn) {
      const double window =
          std::pow(std::sin(M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(sample.size())), 2);
      sum += window * sample[i] * phase;
    }
    return std::norm(sum);
  };
  double best = guess, width = range * guess;
  for (int refine = 0; refine < 5; ++refine, width /= 15) {
    const double middle = best;
    for (int i = -40; i <= 40; ++i) {
      const double omega = middle + width * i / 40;
      if (power(omega) > power(best)) best = omega;
    }
  }
  return best;
}

/// The columns frequency (1/s) and its relative error of a mode's amplitude so far; "-" where the mode has no
/// reference.
std::string frequency_columns(const std::string& mode, const std::vector<double>& amplitude,
                              const std::vector<double>& time) {
  for (const ModeName& m : modes) {
    if (mode != m.name) continue;
    const double reference = sphere_frequency(m.mode, m.l, radius, youngs_modulus, poissons_ratio, density);
    // The step changes a little when it is estimated again; apart from that, samples are evenly spaced.
    const double spacing = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
    const double found = peak_frequency(amplitude, spacing, reference, 0.2);
    return fmt::format("{:.5e},{:.4f}", found / (2 * M_PI), found / reference - 1);
  }
  return "-,-";
}

/// A velocity for each component of each node, of size 1 at the surface.
std::vector<double> mode_shape(const Model& model, const std::string& mode) {
  const auto nodes = static_cast<std::size_t>(model.nodes());
  std::vector<double> shape(3 * nodes);
  Random random(5);
  for (std::size_t n = 0; n < nodes; ++n) {
    const double* x = &model.position[4 * n];
    const double r[3] = {(x[0] - 0.5) / radius, (x[1] - 0.5) / radius, (x[2] - 0.5) / radius};
    double* v = &shape[3 * n];
    if (mode == "breathing") v[0] = r[0], v[1] = r[1], v[2] = r[2];
    if (mode == "spheroidal") v[0] = r[0], v[1] = r[1], v[2] = -2 * r[2];
    if (mode == "torsional") v[0] = -r[1] * r[2], v[1] = r[0] * r[2];
    if (mode == "noise")
      for (int a = 0; a < 3; ++a) v[a] = 2 * random.uniform() - 1;
  }
  return shape;
}

/// What part of the momentum goes along a mode.
double amplitude_of(const std::vector<double>& shape, const Model& model) {
  double q = 0;
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n)
    for (std::size_t a = 0; a < 3; ++a) q += model.velocity[4 * n + a] * shape[3 * n + a] / model.inverse_mass[n];
  return q;
}

/// Sums over the samples of a window, and the energy's error since the beginning.
class VibrationRecord {
public:
  void add(const HistoryRow& row, const VolumeState& now) {
    // Velocities belong to the half step: the kinetic energy that observe() gives is the mean of both half steps'.
    const double energy = row.kinetic_energy + row.elastic_energy;
    if (first_energy_ == 0) first_energy_ = energy;
    energy_error_ = energy / first_energy_ - 1;
    largest_error_ = std::max(largest_error_, std::abs(energy_error_));
    sum_.reference_volume = now.reference_volume;
    sum_.averaged_square += now.averaged_square, sum_.tet_square += now.tet_square, sum_.node_square += now.node_square;
    kinetic_share_ += row.kinetic_energy / energy;
    ++samples_;
  }
  /// The columns energy_error … node_oscillation; a new window begins.
  std::string end_window() {
    const std::string text = fmt::format(
        "{:.2e},{:.2e},{:.4f},{:.4f},{:.5f},{:.5f}", energy_error_, largest_error_, kinetic_share_ / samples_,
        std::sqrt(sum_.averaged_square / samples_ / sum_.reference_volume),
        std::sqrt(sum_.tet_square / sum_.averaged_square), std::sqrt(sum_.node_square / sum_.averaged_square));
    sum_ = {}, samples_ = 0, kinetic_share_ = 0;
    return text;
  }

private:
  VolumeState sum_;
  int samples_ = 0;
  double kinetic_share_ = 0, energy_error_ = 0, largest_error_ = 0, first_energy_ = 0;
};

struct Vibration {
  std::string element, mode;
  double size_ratio; ///< R/h
  std::int64_t steps;
  double speed;     ///< mm/s at the surface, at first
  double viscosity; ///< bulk viscosity over its default
};

Scenario scenario_of(const Vibration& v) {
  Scenario scenario = holding_scenario(1);
  scenario.numerics.element = element_of(v.element);
  scenario.numerics.own_pressure = usual_own_pressure(scenario.numerics.element);
  scenario.numerics.bulk_viscosity_linear *= v.viscosity;
  scenario.numerics.bulk_viscosity_quadratic *= v.viscosity;
  return scenario;
}

/// Runs and prints a line a window.
void print_windows(const Vibration& v, Simulation& simulation, const std::vector<double>& shape) {
  const Model& model = simulation.model();
  const auto neighbours = tet_neighbours(model);
  constexpr int windows = 10;
  const std::int64_t every = std::max<std::int64_t>(1, v.steps / (windows * 200)), window = v.steps / windows;
  VibrationRecord record;
  std::vector<double> amplitude, time;
  for (std::int64_t step = 0; step < v.steps; ++step) {
    simulation.evaluate_forces();
    if (step % every == 0) record.add(simulation.observe(), volume_state(model, neighbours));
    if (v.mode != "noise" && step % 20 == 0)
      amplitude.push_back(amplitude_of(shape, model)), time.push_back(simulation.state().time);
    if ((step + 1) % window == 0) {
      fmt::print("{},{},{},{},{},{},{},{},{:.4e},{},{}\n", v.element, v.size_ratio, model.tets(), v.mode, v.speed,
                 v.viscosity, (step + 1) / window, step + 1, simulation.state().time, record.end_window(),
                 frequency_columns(v.mode, amplitude, time));
      std::fflush(stdout);
    }
    simulation.advance();
  }
}

void vibration(const Vibration& v) {
  const Scenario scenario = scenario_of(v);
  ThreadTeam team(1);
  GrainMesh mesh = sphere_mesh(v.size_ratio, radius, 1);
  move(mesh, {0.5, 0.5, 0.5});
  Simulation simulation(build_model(pack({mesh}, {1, 1, 1}), scenario, "sphere"), scenario, team);
  Model& model = simulation.model_to_disturb();
  const std::vector<double> shape = mode_shape(model, v.mode);
  for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n)
    for (std::size_t a = 0; a < 3; ++a) model.velocity[4 * n + a] = v.speed * shape[3 * n + a];
  fmt::print("element,size_ratio,tets,mode,speed [mm/s],viscosity,window,steps,time "
             "[s],energy_error,largest_energy_error,kinetic_share,"
             "pressure_rms [MPa],tet_oscillation,node_oscillation,frequency [1/s],frequency_error\n");
  print_windows(v, simulation, shape);
}

/// Compaction, then cycles between 1 and 60 MPa.
Scenario cycling_scenario(const std::string& element, int count) {
  Scenario scenario = holding_scenario(1, HardeningLaw::power);
  scenario.walls = true;
  scenario.contact.surface = ContactSurface::facets;
  scenario.numerics.element = element_of(element);
  scenario.numerics.own_pressure = usual_own_pressure(scenario.numerics.element);
  Stage compaction, cycles;
  compaction.name = "compaction";
  compaction.type = IsotropicCompaction{0.84, 4000, 0.1};
  compaction.damping = {2e6, 0.25};
  StressCycles loading;
  loading.wall_speed = 4000;
  loading.lowest_mean_stress = 1;
  loading.highest_mean_stress = 60;
  loading.cycles = count;
  cycles.name = "cycles";
  cycles.type = loading;
  scenario.stages = {compaction, cycles};
  return scenario;
}

/// Runs the current stage; `print` is called with the number of each half cycle that ends before the last, whose
/// number is returned.
template <class Print>
std::int64_t run_half_cycles(Simulation& simulation, const Print& print) {
  std::int64_t legs = 0;
  for (;;) {
    simulation.evaluate_forces();
    if (const auto* cycles = dynamic_cast<const StressCyclesControl*>(&simulation.stage_run().control());
        cycles && cycles->half_cycles() > legs)
      print(static_cast<double>(legs = cycles->half_cycles()));
    if (simulation.stage_complete()) return legs;
    simulation.advance();
  }
}

void cycles(const std::string& element, const std::string& file, int count) {
  const Scenario scenario = cycling_scenario(element, count);
  ThreadTeam team(1);
  Simulation simulation(build_model(read_packing(file), scenario, file), scenario, team);
  const Model& model = simulation.model();
  const auto neighbours = tet_neighbours(model);
  fmt::print(
      "element,stage,half_cycle,time [s],relative_density,mean_stress [MPa],pressure [MPa],pressure_rms [MPa],"
      "tet_oscillation [MPa],node_oscillation [MPa],volume_ratio,tet_lowest,tet_highest,node_lowest,node_highest,"
      "kinetic_over_elastic,residual_over_work\n");
  const auto print = [&](double half) {
    const HistoryRow row = simulation.observe();
    const VolumeState v = volume_state(model, neighbours);
    fmt::print(
        "{},{},{},{:.4e},{:.5f},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.6f},{:.4f},{:.4f},{:.4f},{:.4f},{:.1e},{:.1e}\n",
        element, scenario.stages[std::size_t(simulation.state().stage)].name, half, simulation.state().time,
        row.relative_density, row.mean_stress, v.pressure(), v.pressure_rms(), v.tet_oscillation(),
        v.node_oscillation(), v.volume / v.reference_volume, v.tet_lowest, v.tet_highest, v.node_lowest, v.node_highest,
        row.kinetic_energy / row.elastic_energy, row.energy_residual / row.external_work);
    std::fflush(stdout);
  };
  run_half_cycles(simulation, print);
  print(0.0);
  simulation.begin_next_stage();
  simulation.advance();
  print(static_cast<double>(run_half_cycles(simulation, print) + 1));
}

void flattening(const std::string& element, double size_ratio) {
  ColumnSetup setup;
  setup.element = element_of(element);
  setup.law = HardeningLaw::power;
  for (const double flattened : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5}) setup.approaches.push_back(flattened * radius);
  GrainMesh mesh = sphere_mesh(size_ratio, radius, 1);
  rotate(mesh, {0.6, 0, 0.8}, 1.0);
  PressedColumn column({mesh}, setup);
  const Model& model = column.model();
  const auto neighbours = tet_neighbours(model);
  fmt::print("element,size_ratio,tets,approach,force,pressure_by_forces [MPa],volume_strain,expected_volume_strain,"
             "pressure [MPa],tet_oscillation,node_oscillation,tet_lowest,tet_highest,node_lowest,node_highest,"
             "kinetic_over_elastic,residual_over_work\n");
  for (const double approach : setup.approaches) {
    column.press();
    const ColumnState state = column.state();
    const VolumeState v = volume_state(model, neighbours);
    const double height = column.simulation().box().cell().length(2);
    // Mean stress of a body at rest from the forces on it alone: p = F H/(3 V); faces without friction.
    const double mean_force = 0.5 * (state.low_force + state.high_force);
    const double by_forces = mean_force * height / (3 * v.volume);
    fmt::print(
        "{},{},{},{},{:.5f},{:.4f},{:.6f},{:.6f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.1e},{:.1e}\n",
        element, size_ratio, model.tets(), approach / radius, mean_force, by_forces, v.volume / v.reference_volume - 1,
        -by_forces / model.material_of(0).moduli.bulk, v.pressure(), v.tet_oscillation() / v.pressure_rms(),
        v.node_oscillation() / v.pressure_rms(), v.tet_lowest, v.tet_highest, v.node_lowest, v.node_highest,
        state.kinetic_over_elastic, state.residual_over_work);
    std::fflush(stdout);
  }
}

bool is_mode(const std::string& name) {
  return name == "noise" ||
         std::any_of(std::begin(modes), std::end(modes), [&](const ModeName& m) { return name == m.name; });
}

int usage() {
  fmt::print(stderr, "nodal-pressure frequencies | vibration ELEMENT R/h MODE STEPS SPEED VISCOSITY (MODE: breathing, "
                     "spheroidal, torsional, noise) | cycles ELEMENT "
                     "PACKING.h5 CYCLES | "
                     "flattening ELEMENT R/h\n");
  return 2;
}

} // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  if (what == "frequencies" && argc == 2)
    frequencies();
  else if (what == "vibration" && argc == 8 && is_mode(argv[4]))
    vibration({.element = argv[2],
               .mode = argv[4],
               .size_ratio = std::atof(argv[3]),
               .steps = std::atoll(argv[5]),
               .speed = std::atof(argv[6]),
               .viscosity = std::atof(argv[7])});
  else if (what == "cycles" && argc == 5)
    cycles(argv[2], argv[3], std::atoi(argv[4]));
  else if (what == "flattening" && argc == 4)
    flattening(argv[2], std::atof(argv[3]));
  else
    return usage();
  return 0;
}
