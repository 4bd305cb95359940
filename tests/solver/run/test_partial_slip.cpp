// Two elastic caps pressed together and dragged to and fro: partial slip (Cattaneo 1938, Mindlin 1949).

#include <algorithm>
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/support/bonded_pair.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double width = 0.1, radius = 0.4, contact_radius = 0.02; // mm: half of a block, of its cap, of the contact
constexpr double poisson = 0.3, youngs = 5000;                     // 1, MPa
constexpr double pressing = 0.5 * contact_radius * contact_radius / radius * 2; // mm, both caps: a^2/(R/2)/2 each

/// Distance from the middle of the i-th of n lines: even cells over 1.5 contact radii, growing ones beyond, up to 1.
double graded(double share) {
  constexpr double fine = 1.6 * contact_radius / width, of_cells = 0.6;
  if (share <= of_cells) return fine * share / of_cells;
  const double t = (share - of_cells) / (1 - of_cells), slope = fine / of_cells * (1 - of_cells);
  return fine + slope * t + (1 - fine - slope) * t * t;
}

/// A block with a spherical cap below, z from 0 up.
GrainMesh cap(int n) {
  GrainMesh mesh = cube_mesh(n);
  for (auto& x : mesh.node) {
    for (std::size_t axis = 0; axis < 2; ++axis) x[axis] = width * std::copysign(graded(std::abs(x[axis])), x[axis]);
    const double height = width * graded(0.5 * (1 + x[2]));
    x[2] = height + (x[0] * x[0] + x[1] * x[1]) / (2 * radius) * (1 - height / width);
  }
  return mesh;
}

MeshedPacking two_caps(int n) {
  GrainMesh upper = cap(n), lower = upper;
  rotate(lower, {1, 0, 0}, M_PI);
  rotate(lower, {0, 0, 1}, 0.4); // meshes that do not match
  move(upper, {0.2, 0.2, width + 1e-6});
  move(lower, {0.2, 0.2, width});
  return pack({lower, upper}, {0.4, 0.4, 2 * width + 1e-6});
}

/// One state of the drag.
struct Drag {
  double way, push, shear; // mm, N, N
};

struct Dragged {
  std::vector<std::vector<Drag>> stage;
  double lost_in_loop = 0; ///< mJ, by friction in the last two stages
};

/// Presses, drags by `way` (mm), back to -`way` and again to `way`.
Dragged drag(int n, double friction, double way, bool loop) {
  constexpr double speed = 600; // mm/s: some 1e-3 of a shear wave's over a width
  Stage press = grip("press", -pressing, speed), out = grip("out", 0, speed, {way, 0, 0}),
        back = grip("back", 0, speed, {-2 * way, 0, 0}), again = grip("again", 0, speed, {2 * way, 0, 0});
  std::vector<Stage> stages = {press, out};
  if (loop) stages.insert(stages.end(), {back, again});
  for (Stage& stage : stages) {
    std::get<GripMotion>(stage.type).depth = 0.02;
    stage.damping = {2e6, 1e9};
  }
  Scenario scenario = holding_scenario(1);
  scenario.contact.friction = friction;
  scenario.contact.surface = ContactSurface::facets;
  scenario.numerics.element = ElementType::tet4_anp;
  scenario.stages = stages;
  ThreadTeam team(2);
  Simulation simulation(build_model(two_caps(n), scenario, "test"), scenario, team);
  // What the grips hold at both ends.
  const auto offset_of_ends = [&] {
    const Model& m = simulation.model();
    std::size_t low = 0, high = 0;
    for (std::size_t node = 0; node < static_cast<std::size_t>(m.nodes()); ++node) {
      if (m.position[4 * node + 2] < m.position[4 * low + 2]) low = node;
      if (m.position[4 * node + 2] > m.position[4 * high + 2]) high = node;
    }
    return std::pair(low, high);
  };
  const auto [low, high] = offset_of_ends();
  const auto offset = [&, low = low, high = high] {
    return simulation.model().position[4 * high] - simulation.model().position[4 * low];
  };
  const double middle = offset();
  Dragged dragged;
  double before_loop = 0;
  for (std::size_t s = 0; s < stages.size(); ++s) {
    if (s == 2) before_loop = simulation.energies().friction_dissipation;
    std::vector<Drag> record;
    for (int i = 0;; ++i) {
      simulation.evaluate_forces();
      const bool end = simulation.stage_complete();
      if (end || i % 20 == 0) {
        Drag now{offset() - middle, 0, 0};
        for (const PairContact& pair : pair_contacts(simulation.model(), simulation.contact()))
          now.push += std::abs(pair.force[2]), now.shear += pair.force[0];
        record.push_back(now);
      }
      if (end) break;
      simulation.advance();
    }
    dragged.stage.push_back(record);
    if (s + 1 == stages.size()) break;
    simulation.begin_next_stage();
    simulation.advance();
  }
  dragged.lost_in_loop = simulation.energies().friction_dissipation - before_loop;
  return dragged;
}

} // namespace

TEST_CASE("explore", "[.]") {
  const double mu = 0.3, h = pressing, slide = mu * h * (2 - poisson) / (2 * (1 - poisson));
  for (int n : {10, 14}) {
    for (double m : {2.0, 0.3}) {
      const Dragged d = drag(n, m, 0.8 * slide, m < 1);
      const double P = d.stage[0].back().push;
      const double Es = youngs / (2 * (1 - poisson * poisson)), a = std::cbrt(3 * P * radius / 2 / (4 * Es));
      const double G = youngs / (2 * (1 + poisson)), Gs = 2 * G / (2 - poisson);
      printf("n %d mu %g P %g a %g (nominal %g) slide %g -> %g lost %g\n", n, m, P, a, contact_radius, slide,
             3 * mu * P / (4 * a * Gs), d.lost_in_loop);
      for (const auto& stage : d.stage) {
        printf("--\n");
        for (std::size_t i = 0; i < stage.size(); i += std::max<std::size_t>(1, stage.size() / 12))
          printf("  %g %g %g  q %g\n", stage[i].way, stage[i].push, stage[i].shear,
                 stage[i].shear / (mu * stage[i].push));
        printf("  %g %g %g  q %g\n", stage.back().way, stage.back().push, stage.back().shear,
               stage.back().shear / (mu * stage.back().push));
      }
    }
  }
}
