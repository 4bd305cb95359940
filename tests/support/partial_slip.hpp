#pragma once
// Two elastic caps pressed together and dragged to and fro: partial slip (Cattaneo 1938, Mindlin 1949). The scene, its
// theory, and how far one is from the other.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "solver/kernels/contact_forces.hpp"
#include "tests/support/bonded_pair.hpp"

namespace mpfem::test {

namespace partial_slip {

constexpr double width = 0.1, radius = 0.4, pressing = 1e-3; // mm: half of a block, of its cap; approach
constexpr double poisson = 0.3, youngs = 5000;               // 1, MPa

/// Place of a line of the mesh, 0 … 1 from the middle to the edge, by its number over that of all: even cells over 1.4
/// of the contact's radius, which is (pressing radius/2)^1/2, growing ones beyond.
inline double graded(double share) {
  constexpr double fine = 0.2, of_cells = 0.6;
  if (share <= of_cells) return fine * share / of_cells;
  const double t = (share - of_cells) / (1 - of_cells), slope = fine / of_cells * (1 - of_cells);
  return fine + slope * t + (1 - fine - slope) * t * t;
}

/// A block with a spherical cap below, z from 0 up.
inline GrainMesh cap(int n) {
  GrainMesh mesh = cube_mesh(n);
  for (auto& x : mesh.node) {
    for (std::size_t axis = 0; axis < 2; ++axis) x[axis] = width * std::copysign(graded(std::abs(x[axis])), x[axis]);
    const double height = width * graded(0.5 * (1 + x[2]));
    x[2] = height + (x[0] * x[0] + x[1] * x[1]) / (2 * radius) * (1 - height / width);
  }
  return mesh;
}

inline MeshedPacking two_caps(int n) {
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
  std::int64_t steps = 0;
};

/// What is varied.
struct Settings {
  int n = 14; ///< cells along an edge: 0.6 n/2 of them over 1.4 of the contact's radius
  ElementType element = ElementType::tet4_anp;
  int threads = 2;
  ContactSurface surface = ContactSurface::facets;
};

/// Elements in the contact's radius: of the half edge's n/2 cells six tenths span 1.4 radii.
inline double elements_in_radius(int n) {
  return 0.6 * n / 2 / 1.4;
}

/// Stages whose grips hold a fifth of a block, damped.
inline Scenario scene(const Settings& settings, double friction, std::vector<Stage> stages) {
  for (Stage& stage : stages) {
    std::get<GripMotion>(stage.type).depth = 0.02;
    stage.damping = {2e6, 1e9};
  }
  Scenario scenario = holding_scenario(1);
  scenario.contact.friction = friction;
  scenario.contact.surface = settings.surface;
  scenario.numerics.element = settings.element;
  scenario.numerics.own_pressure = usual_own_pressure(settings.element);
  scenario.stages = std::move(stages);
  return scenario;
}

/// Presses, drags by `way` (mm), back to -`way` and again to `way`.
inline Dragged drag(const Settings& settings, double friction, double way, bool loop) {
  constexpr double speed = 100, press_speed = 200; // mm/s: grips need 15 transits of waves to come to their places
  Stage press = grip("press", -pressing, press_speed), out = grip("out", 0, speed, {way, 0, 0}),
        back = grip("back", 0, speed, {-2 * way, 0, 0}), again = grip("again", 0, speed, {2 * way, 0, 0});
  std::vector<Stage> stages = {press, out};
  if (loop) stages.insert(stages.end(), {back, again});
  const Scenario scenario = scene(settings, friction, stages);
  ThreadTeam team(settings.threads);
  Simulation simulation(build_model(two_caps(settings.n), scenario, "test"), scenario, team);
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
      if (end || i % 50 == 0) {
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
  dragged.steps = simulation.state().step;
  return dragged;
}

/// Cattaneo and Mindlin for two equal bodies: 1/G* = 2 (2 - nu)/(4 G).
struct Theory {
  double limit; ///< mu P, N
  double slide; ///< mm, at which all slides
  double loop;  ///< (mu P)^2/(a G*), mJ

  Theory(double friction, double push) : limit(friction * push) {
    const double normal = youngs / (2 * (1 - poisson * poisson)),
                 shear = youngs / (1 + poisson) / (2 - poisson); // E*, G*
    const double a = std::cbrt(3 * push * (radius / 2) / (4 * normal));
    slide = 3 * limit / (4 * a * shear);
    loop = limit * limit / (a * shear);
  }
  /// 2 G* a, N/mm, the stiffness while all sticks.
  double stick_stiffness() const { return 1.5 * limit / slide; }
  /// Displacement (mm) at the shear force Q (N): loading from 0, then unloading from `turned`.
  double loading(double q) const { return slide * (1 - std::pow(1 - q / limit, 2.0 / 3)); }
  double unloading(double q, double turned) const {
    return slide * (2 * std::pow(1 - (turned - q) / (2 * limit), 2.0 / 3) - std::pow(1 - turned / limit, 2.0 / 3) - 1);
  }
  /// mJ, of a cycle between two opposite forces of size q (N).
  double loss(double q) const {
    const double s = q / limit;
    return 3.6 * loop * (1 - std::pow(1 - s, 5.0 / 3) - 5 * s / 6 * (1 + std::pow(1 - s, 2.0 / 3)));
  }
};

/// Largest difference of measured shear forces from those that the theory has at the same displacement (of the
/// contact: what blocks and grips yield, `compliance` in mm/N, is taken off), over mu P, with its sign.
template <class Displacement>
double largest_difference(const std::vector<Drag>& drag, const Theory& theory, double compliance, double lowest,
                          double highest, const Displacement& displacement) {
  double largest = 0;
  for (const Drag& at : drag) {
    double low = lowest, high = highest;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (displacement(middle) < at.way - compliance * at.shear ? low : high) = middle;
    }
    const double difference = (at.shear - 0.5 * (low + high)) / theory.limit;
    if (std::abs(difference) > std::abs(largest)) largest = difference;
  }
  return largest;
}

/// Over mu P; the loss over that of the theory, less one.
struct Errors {
  double out = 0, back = 0; ///< largest with its sign, of the shear force where the drag goes out and comes back
  double loss = 0;          ///< of the energy that a whole cycle dissipates
  double amplitude = 0;     ///< of the shear force in the cycle, over mu P
  double other_share = 0;   ///< of blocks and grips in what yields, over that of the contact
  std::int64_t steps = 0;   ///< of both runs: one in which everything sticks, and the cycle
};

inline Errors errors(const Settings& settings, double mu) {
  const double way = 0.8 * mu * pressing * (2 - poisson) / (2 * (1 - poisson));
  // With so much friction everything sticks: what yields besides the contact.
  const Dragged sticking = drag(settings, 2, way, false);
  const Drag stuck = sticking.stage[1].back();
  const Dragged dragged = drag(settings, mu, way, true);
  const Theory theory(mu, dragged.stage[0].back().push);
  const double compliance = stuck.way / stuck.shear - 1 / theory.stick_stiffness();
  const double turned = dragged.stage[1].back().shear;
  Errors errors;
  errors.other_share = compliance * theory.stick_stiffness();
  errors.steps = sticking.steps + dragged.steps;
  errors.out = largest_difference(dragged.stage[1], theory, compliance, 0, theory.limit,
                                  [&](double q) { return theory.loading(q); });
  errors.back = largest_difference(dragged.stage[2], theory, compliance, -turned, turned,
                                   [&](double q) { return theory.unloading(q, turned); });
  const double amplitude = 0.5 * (dragged.stage[3].back().shear - dragged.stage[3].front().shear);
  errors.loss = dragged.lost_in_loop / theory.loss(amplitude) - 1;
  errors.amplitude = amplitude / theory.limit;
  return errors;
}

/// Two caps that come together obliquely: both forces grow in proportion.
struct Oblique {
  double push = 0, shear = 0; ///< N, at the end
  double steepest = 0;        ///< largest of shear over push, where the push is above a tenth of the last
  double lost = 0;            ///< mJ, by friction
  double sheared = 0;         ///< mJ, of the shear force over what the contact gives along it
};
/// Presses and drags at once, so that the shear force is `share` of friction's limit.
inline Oblique press_obliquely(const Settings& settings, double friction, double share) {
  // Where all sticks, both stiffnesses are as 2 (1 - nu) to 2 - nu.
  const double way = share * friction * pressing * (2 - poisson) / (2 * (1 - poisson));
  const Scenario scenario = scene(settings, friction, {grip("oblique", -pressing, 200, {way, 0, 0})});
  ThreadTeam team(settings.threads);
  Simulation simulation(build_model(two_caps(settings.n), scenario, "test"), scenario, team);
  std::vector<Drag> record;
  for (int i = 0;; ++i) {
    simulation.evaluate_forces();
    const bool end = simulation.stage_complete();
    if (end || i % 50 == 0) {
      Drag now{0, 0, 0};
      for (const PairContact& pair : pair_contacts(simulation.model(), simulation.contact()))
        now.push += std::abs(pair.force[2]), now.shear += pair.force[0];
      record.push_back(now);
    }
    if (end) break;
    simulation.advance();
  }
  Oblique oblique{.push = record.back().push, .shear = std::abs(record.back().shear)};
  for (const Drag& at : record)
    if (at.push > 0.1 * oblique.push) oblique.steepest = std::max(oblique.steepest, std::abs(at.shear) / at.push);
  oblique.lost = simulation.energies().friction_dissipation;
  // Both displacements grow as the force to the power of 2/3.
  oblique.sheared = 0.6 * oblique.shear * way;
  return oblique;
}

} // namespace partial_slip

} // namespace mpfem::test
