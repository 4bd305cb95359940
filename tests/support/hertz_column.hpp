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

/// Presses `spheres` (1 or 2) spheres of radius 0.1 mm until every contact has approached by about `approach` mm as
/// seen from a sphere's centre. `size_ratio`: R/h.
inline ColumnResult press_column(int spheres, double size_ratio, double approach, double stiffness_factor) {
  constexpr double radius = 0.1, youngs_modulus = 5000, poissons_ratio = 0.3;
  const double start = 1.04 * radius; // a coarse mesh's nodes lie up to 3.5 % outside the sphere
  std::vector<GrainMesh> grains;
  for (int i = 0; i < spheres; ++i) {
    grains.push_back(sphere_mesh(size_ratio, radius, static_cast<std::uint64_t>(i) + 1));
    rotate(grains.back(), {0.6, 0, 0.8}, 1.0 + 0.7 * i); // no node just at the contact, no two meshes alike
    move(grains.back(), {0.2, 0.2, start * (1 + 2 * i)});
  }
  const double height = 2 * start * spheres;
  Scenario scenario = holding_scenario(1);
  scenario.walls = true;
  scenario.contact.stiffness_factor = stiffness_factor;
  // The box is compacted isotropically; it is wide, so that only the walls along z touch: 2 m/s a wall and sphere.
  const double shrink = (radius - approach) / start;
  Stage stage;
  stage.name = "press";
  stage.type = IsotropicCompaction{0, 2000.0 * spheres * 0.4 / height * 2, 0.3};
  stage.damping = {4e6, 1e9};
  const MeshedPacking packing = pack(grains, {0.4, 0.4, height});
  ThreadTeam team(2);
  scenario.stages = {stage};
  std::get<IsotropicCompaction>(scenario.stages[0].type).relative_density =
      build_model(packing, scenario, "test").total_reference_volume() / (0.4 * 0.4 * height * std::pow(shrink, 3));
  Simulation simulation(build_model(packing, scenario, "test"), scenario, team);
  Model& model = simulation.model_to_disturb();
  const auto nodes_of = [&model](int g) {
    return std::pair{static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(g)]),
                     static_cast<std::size_t>(model.node_offset[static_cast<std::size_t>(g) + 1])};
  };
  const auto mean = [&](const AlignedVector<double>& rows, int g, std::size_t axis) {
    double sum = 0;
    for (auto [n, end] = nodes_of(g); n < end; ++n) sum += rows[4 * n + axis] / model.inverse_mass[n];
    return sum / model.mass[static_cast<std::size_t>(g)];
  };
  while (!simulation.stage_complete()) {
    simulation.evaluate_forces();
    simulation.advance();
    // A column of smooth spheres would buckle: hold the centres on its axis.
    for (int g = 0; g < spheres; ++g)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double drift = mean(model.velocity, g, axis);
        for (auto [n, end] = nodes_of(g); n < end; ++n) model.velocity[4 * n + axis] -= drift;
      }
  }
  simulation.evaluate_forces();
  const HistoryRow row = simulation.observe();
  const auto reference = [&](double d) {
    return finite_sphere_factor(2 * d / radius) * 4.0 / 3.0 * youngs_modulus / (1 - poissons_ratio * poissons_ratio) *
           std::sqrt(radius) * std::pow(d, 1.5);
  };
  ColumnResult result;
  result.tets = model.tets() / spheres;
  result.kinetic_over_elastic = row.kinetic_energy / row.elastic_energy;
  result.residual_over_work = row.energy_residual / row.external_work;
  const double area = row.box_lengths[0] * row.box_lengths[1];
  const double low_force = row.wall_stress[4] * area, high_force = row.wall_stress[5] * area;
  result.wall_imbalance = (high_force - low_force) / (high_force + low_force);
  const Cell& cell = simulation.box().cell();
  const double low_approach = radius - (mean(model.position, 0, 2) - cell.low[2]);
  const double high_approach = radius - (cell.high[2] - mean(model.position, spheres - 1, 2));
  result.wall_error = (low_force + high_force) / (reference(low_approach) + reference(high_approach)) - 1;
  result.contact_radius_over_size = std::sqrt(radius * low_approach) * size_ratio / radius;
  if (spheres == 2) {
    const double half = radius - 0.5 * (mean(model.position, 1, 2) - mean(model.position, 0, 2));
    const auto pairs = pair_contacts(model, simulation.contact());
    result.sphere_error = -pairs.at(0).force[2] / reference(half) - 1;
  }
  return result;
}

} // namespace mpfem::test
