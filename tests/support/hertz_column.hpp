#pragma once
// Equal elastic spheres in a column between two walls, pressed together quasi-statically, against Hertz.

#include <cmath>
#include <vector>

#include "pack-gen/grain_mesh.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/meshes.hpp"

namespace mpfem::test {

/// A sphere as pack-gen meshes it: `size_ratio` nominal element sizes in the radius (mm), the sphere's exact volume.
inline GrainMesh sphere_mesh(double size_ratio, double radius, std::uint64_t seed) {
  const UnitBall unit = mesh_unit_ball(size_ratio, seed);
  GrainMesh mesh;
  for (const auto& x : unit.ball.mesh.node) mesh.node.push_back({x[0], x[1], x[2]});
  mesh.tet = unit.ball.mesh.tet;
  scale(mesh, radius * std::cbrt(4.0 / 3.0 * M_PI / unit.volume));
  return mesh;
}

/// Ratio of the converged finite-element force of a sphere of finite size to Hertz, for the approach of two sphere
/// centres over the radius between 0.02 and 0.08 (tests/reference/README.md, hertz-finite-sphere).
inline double finite_sphere_factor(double approach_over_radius) {
  static constexpr double at[] = {0.005, 0.01, 0.02, 0.04, 0.06, 0.08},
                          factor[] = {1.019, 1.030, 1.045, 1.068, 1.087, 1.105};
  for (int i = 1; i < 6; ++i)
    if (approach_over_radius <= at[i] || i == 5)
      return factor[i - 1] + (factor[i] - factor[i - 1]) * (approach_over_radius - at[i - 1]) / (at[i] - at[i - 1]);
  return factor[5];
}

/// What the column shows at the end of pressing. Forces over the finite-sphere reference at the approach of the centres
/// that the run itself ended with.
struct ColumnResult {
  int tets = 0;                        ///< of one sphere
  double wall_error = 0;               ///< sphere on plane, relative
  double sphere_error = 0;             ///< sphere on sphere, relative; 0 for one sphere
  double contact_radius_over_size = 0; ///< sqrt(R d)/h: elements across the contact's radius
  double kinetic_over_elastic = 0, residual_over_work = 0, wall_imbalance = 0;
};

inline constexpr double column_radius = 0.1, column_width = 0.4; ///< mm

/// `spheres` spheres about the axis of a box, that do not touch; its height is `height` (mm).
inline MeshedPacking column_packing(int spheres, double size_ratio, double height) {
  std::vector<GrainMesh> grains;
  for (int i = 0; i < spheres; ++i) {
    grains.push_back(sphere_mesh(size_ratio, column_radius, static_cast<std::uint64_t>(i) + 1));
    rotate(grains.back(), {0.6, 0, 0.8}, 1.0 + 0.7 * i); // no node just at the contact, no two meshes alike
    move(grains.back(), {0.2, 0.2, height / spheres * (0.5 + i)});
  }
  return pack(grains, {column_width, column_width, height});
}

/// The box is compacted isotropically; it is wide, so that only the walls along z touch: 2 m/s a wall and sphere.
inline Scenario column_scenario(const MeshedPacking& packing, int spheres, double height, double shrink,
                                double stiffness_factor) {
  Scenario scenario = holding_scenario(1);
  scenario.walls = true;
  scenario.contact.stiffness_factor = stiffness_factor;
  IsotropicCompaction compaction{0, 2000.0 * spheres * 0.4 / height * 2, 0.3};
  Stage stage;
  stage.name = "press";
  stage.type = compaction;
  stage.damping = {4e6, 1e9};
  scenario.stages = {stage};
  compaction.relative_density = build_model(packing, scenario, "test").total_reference_volume() /
                                (column_width * column_width * height * std::pow(shrink, 3));
  scenario.stages[0].type = compaction;
  return scenario;
}

/// First node of a grain, and the end.
inline std::pair<std::size_t, std::size_t> nodes_of(const Model& model, int grain) {
  const auto g = static_cast<std::size_t>(grain);
  return {static_cast<std::size_t>(model.node_offset[g]), static_cast<std::size_t>(model.node_offset[g + 1])};
}

/// Mean of one component of `rows` (four numbers for each node) over the nodes of a grain, weighted by their masses.
inline double mean_of_grain(const Model& model, const LazyArray<double>& rows, int grain, std::size_t axis) {
  double sum = 0;
  for (auto [n, end] = nodes_of(model, grain); n < end; ++n) sum += rows[4 * n + axis] / model.inverse_mass[n];
  return sum / model.mass[static_cast<std::size_t>(grain)];
}

/// A column of smooth spheres would buckle: holds the centres on its axis.
inline void hold_on_axis(Model& model) {
  for (int g = 0; g < model.grains; ++g)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double drift = mean_of_grain(model, model.velocity, g, axis);
      for (auto [n, end] = nodes_of(model, g); n < end; ++n) model.velocity[4 * n + axis] -= drift;
    }
}

/// Force (N) on a sphere of finite size whose centre has approached the contact by `approach` mm.
inline double finite_sphere_force(double approach) {
  constexpr double youngs_modulus = 5000, poissons_ratio = 0.3;
  return finite_sphere_factor(2 * approach / column_radius) * 4.0 / 3.0 * youngs_modulus /
         (1 - poissons_ratio * poissons_ratio) * std::sqrt(column_radius) * std::pow(approach, 1.5);
}

/// Reads the errors from the current state; `size_ratio`: R/h.
inline ColumnResult result_of_column(const Simulation& simulation, double size_ratio) {
  const Model& model = simulation.model();
  const HistoryRow row = simulation.observe();
  const auto height_of = [&](int grain) { return mean_of_grain(model, model.position, grain, 2); };
  ColumnResult result;
  result.tets = model.tets() / model.grains;
  result.kinetic_over_elastic = row.kinetic_energy / row.elastic_energy;
  result.residual_over_work = row.energy_residual / row.external_work;
  const double area = row.box_lengths[0] * row.box_lengths[1];
  const double low_force = row.wall_stress[4] * area, high_force = row.wall_stress[5] * area;
  result.wall_imbalance = (high_force - low_force) / (high_force + low_force);
  const Cell& cell = simulation.box().cell();
  const double low_approach = column_radius - (height_of(0) - cell.low[2]);
  const double high_approach = column_radius - (cell.high[2] - height_of(model.grains - 1));
  result.wall_error =
      (low_force + high_force) / (finite_sphere_force(low_approach) + finite_sphere_force(high_approach)) - 1;
  result.contact_radius_over_size = std::sqrt(column_radius * low_approach) * size_ratio / column_radius;
  if (model.grains == 2) {
    const double half = column_radius - 0.5 * (height_of(1) - height_of(0));
    const auto pairs = pair_contacts(model, simulation.contact());
    result.sphere_error = -pairs.at(0).force[2] / finite_sphere_force(half) - 1;
  }
  return result;
}

/// Presses `spheres` (1 or 2) spheres of radius 0.1 mm until every contact has approached by about `approach` mm as
/// seen from a sphere's centre. `size_ratio`: R/h.
inline ColumnResult press_column(int spheres, double size_ratio, double approach, double stiffness_factor) {
  const double start = 1.04 * column_radius; // a coarse mesh's nodes lie up to 3.5 % outside the sphere
  const double height = 2 * start * spheres, shrink = (column_radius - approach) / start;
  const MeshedPacking packing = column_packing(spheres, size_ratio, height);
  const Scenario scenario = column_scenario(packing, spheres, height, shrink, stiffness_factor);
  ThreadTeam team(2);
  Simulation simulation(build_model(packing, scenario, "test"), scenario, team);
  while (!simulation.stage_complete()) {
    simulation.evaluate_forces();
    simulation.advance();
    hold_on_axis(simulation.model_to_disturb());
  }
  simulation.evaluate_forces();
  return result_of_column(simulation, size_ratio);
}

} // namespace mpfem::test
