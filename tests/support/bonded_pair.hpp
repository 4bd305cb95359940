#pragma once
// Pairs of bonded grains between grips, driven through stages.

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"

namespace mpfem::test {

inline constexpr double pair_radius = 0.1; // mm

/// Strengths of 25 MPa in tension and 18 MPa in shear; fracture energy in N/mm.
inline BondParameters table_1(double fracture_energy) {
  return {25, 18, fracture_energy, SofteningLaw::exponential, false, false};
}

/// Two grains along z between the faces of a box of height `height`.
inline MeshedPacking stack(GrainMesh lower, GrainMesh upper, double height) {
  move(lower, {0.3, 0.3, pair_radius});
  move(upper, {0.3, 0.3, height - pair_radius});
  return pack({lower, upper}, {0.6, 0.6, height});
}

/// A cube of edge 2 R below a block half as wide again: no node lies on the other's edges. 25 + 9 nodes meet (n = 4).
inline MeshedPacking two_cubes(int n) {
  GrainMesh lower = cube_mesh(n), upper = cube_mesh(n);
  scale(lower, pair_radius);
  for (auto& x : upper.node) x = {1.5 * pair_radius * x[0], 1.5 * pair_radius * x[1], pair_radius * x[2]};
  return stack(lower, upper, 4 * pair_radius + 1e-4);
}
/// Bonds of two_cubes(4).
constexpr int cube_bonds = 34;

/// Two balls of radius R with n^3 cells each, rotated differently, so that their nodes do not face each other.
inline MeshedPacking two_balls(int n) {
  GrainMesh lower = ball_mesh(n, pair_radius), upper = lower;
  rotate(lower, {0.6, 0, 0.8}, 0.7);
  rotate(upper, {0, 0.6, 0.8}, 1.9);
  return stack(lower, upper, 4 * pair_radius + 1e-4);
}

/// Grips along z: change of their distance (mm), their speed (mm/s), sliding of the high grip across z (mm).
inline Stage grip(const std::string& name, double displacement, double speed, std::array<double, 3> sliding = {}) {
  Stage stage;
  stage.name = name;
  // Balls are gripped by a cap, cubes by their faces.
  stage.type = GripMotion{2, 0.03, true, displacement, sliding, speed, 0.2};
  return stage;
}

/// Grains of Table 1: elastic ones would come to strains at which a hypoelastic energy depends on the path (1.5 % of
/// the work when balls are pressed and slid, bonded or not; 0.02 % with yielding).
inline Scenario bonded_scenario(const BondParameters& bond, std::vector<Stage> stages) {
  Scenario scenario = holding_scenario(1e-6);
  scenario.bond = bond;
  scenario.stages = std::move(stages);
  scenario.material.hardening = {HardeningLaw::power, 25, 125, 0.3, {}, {}};
  return scenario;
}

/// What a run of all stages showed.
struct Record {
  std::vector<HistoryRow> last; ///< of each stage
  double worst_residual = 0;    ///< largest |residual| over external work, of rows with some work
  double largest_tension = 0;   ///< N, mean of both grips
};

/// Runs all stages; a row is recorded every `observe_every` steps and at the end of each stage.
inline Record run_stages(Simulation& simulation, const Scenario& scenario, int observe_every = 20) {
  Record record;
  double largest_work = 0, largest_residual = 0;
  for (std::size_t s = 0; s < scenario.stages.size(); ++s) {
    for (int i = 0;; ++i) {
      simulation.evaluate_forces();
      const bool end = simulation.stage_complete();
      if (end || i % observe_every == 0) {
        const HistoryRow row = simulation.observe();
        largest_work = std::max(largest_work, std::abs(row.external_work));
        largest_residual = std::max(largest_residual, std::abs(row.energy_residual));
        record.largest_tension = std::max(record.largest_tension, -0.5 * (row.wall_stress[4] + row.wall_stress[5]) *
                                                                      row.box_lengths[0] * row.box_lengths[1]);
        if (end) record.last.push_back(row);
      }
      if (end) break;
      simulation.advance();
    }
    if (s + 1 == scenario.stages.size()) break;
    simulation.begin_next_stage();
    simulation.advance();
  }
  record.worst_residual = largest_residual / largest_work;
  return record;
}

/// The same for a new simulation of the packing, on one thread.
inline Record run_stages(const MeshedPacking& packing, const Scenario& scenario) {
  ThreadTeam team(1);
  Simulation simulation(build_model(packing, scenario, "test"), scenario, team);
  return run_stages(simulation, scenario);
}

/// Sum of m r x v over the nodes, about the origin.
inline std::array<double, 3> angular_momentum(const Model& m) {
  std::array<double, 3> sum{};
  for (std::size_t n = 0; n < static_cast<std::size_t>(m.nodes()); ++n)
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      sum[a] += (m.position[4 * n + b] * m.velocity[4 * n + c] - m.position[4 * n + c] * m.velocity[4 * n + b]) /
                m.inverse_mass[n];
    }
  return sum;
}

/// Gives all grains one rigid rotation about the middle of the box, instead of the velocities that they have.
inline void spin(Simulation& simulation, const std::array<double, 3>& rate) {
  Model& m = simulation.model_to_disturb();
  for (std::size_t n = 0; n < static_cast<std::size_t>(m.nodes()); ++n) {
    std::array<double, 3> r{};
    for (std::size_t a = 0; a < 3; ++a) r[a] = m.position[4 * n + a] - 0.5 * (m.box_low[a] + m.box_high[a]);
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
      m.velocity[4 * n + a] = rate[b] * r[c] - rate[c] * r[b];
    }
  }
}

} // namespace mpfem::test
