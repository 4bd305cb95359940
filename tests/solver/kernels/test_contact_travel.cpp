// How far grains have travelled, and what contact leaves out until they have travelled far enough.

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "common/index.hpp"
#include "solver/kernels/contact_candidates.hpp"
#include "solver/kernels/node_motion.hpp"
#include "solver/kernels/surface.hpp"
#include "solver/model/smooth_surface.hpp"
#include "solver/run/simulation.hpp"
#include "tests/support/bonded_pair.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/packing_file.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// The velocities of all nodes are those of the field.
void follow(Model& model, const Advance& field) {
  for (std::size_t n = 0; n < at(model.nodes()); ++n)
    for (std::size_t axis = 0; axis < 3; ++axis)
      model.velocity[4 * n + axis] = affine_velocity(field, axis, model.position[4 * n + axis]);
}

/// Contact of the same model without anything remembered: all candidates are searched for and looked at.
Contact searched_afresh(Model& model, const Contact& contact, ThreadTeam& team) {
  std::vector<Bounds> bounds;
  for (const std::int32_t grain : model.own()) bounds.push_back(surface_bounds(model, grain));
  const double reach = contact.margin + max_contact_offset(model);
  Contact fresh = contact;
  renew_candidates(model, {contact.margin, reach, bounds, find_near_grains(bounds, reach, model.own(), team)}, team,
                   fresh);
  return fresh;
}

/// N, forces of contact on all nodes.
std::vector<double> forces_of(Model& model, Contact& contact) {
  std::fill(model.force.begin(), model.force.end(), 0.0);
  for (const std::int32_t grain : model.own()) contact_forces(model, contact, grain);
  contact_reactions(model, contact, model.own());
  return {model.force.begin(), model.force.end()};
}

/// The same with grains evaluated a few at a time, the last ones first.
std::vector<double> forces_of_groups(Model& model, Contact& contact, std::size_t size) {
  std::fill(model.force.begin(), model.force.end(), 0.0);
  std::vector<std::int32_t> grains(model.own().begin(), model.own().end());
  std::reverse(grains.begin(), grains.end());
  std::vector<ContactSums> sums(size);
  const auto for_each_group = [&](auto&& work) {
    for (std::size_t first = 0; first < grains.size(); first += size)
      work(std::span(grains).subspan(first, std::min(size, grains.size() - first)));
  };
  for_each_group([&](auto group) { contact_forces(model, contact, group, std::span(sums).first(group.size())); });
  for_each_group([&](auto group) { contact_reactions(model, contact, group); });
  return {model.force.begin(), model.force.end()};
}

} // namespace

TEST_CASE("grains that follow the walls travel by the strain of the contact margin, however far they move") {
  Model model = build_model(eight_grains(3), holding_scenario(1), "test");
  const Advance field{.step_mean = 1e-9,
                      .step = 1e-9,
                      .centre = {0.1, 0.2, 50}, // far away: the grains are fast
                      .velocity = {3e5, 0, 0},
                      .rate = {-2e4, 1e4, -4e4}};
  follow(model, field);
  std::fill(model.force.begin(), model.force.end(), 0.0);
  const double fastest = std::abs(affine_velocity(field, 2, model.position[2]));
  const double relative = advance(model, 0, field).largest_relative_speed;
  CHECK(relative < 1e-12 * fastest);
  Contact contact;
  contact.margin = 0.02;
  CHECK(within(travel_in_step(contact, field, 7e3), (7e3 + 0.5 * 4e4 * 0.02) * 1e-9, rounding));
}

// What contact does not look at is what cannot have closed, so nothing may differ but the order of equal candidates.
TEST_CASE("contact that leaves out open gaps finds the forces of a fresh search, as walls carry the grains along") {
  const bool carried = GENERATE(false, true);
  const ContactSurface surface = GENERATE(ContactSurface::facets, ContactSurface::smooth);
  Scenario scenario = compaction_scenario(0.75, 2e4);
  scenario.contact.surface = surface;
  ThreadTeam team(2);
  Simulation simulation(build_model(eight_grains(4), scenario, "test"), scenario, team);
  if (carried) {
    const Cell& cell = simulation.box().cell();
    Advance field;
    for (std::size_t axis = 0; axis < 3; ++axis)
      field.centre[axis] = cell.centre(axis), field.rate[axis] = -4e4 / cell.length(axis);
    follow(simulation.model_to_disturb(), field);
  }
  int compared = 0;
  double largest_force = 0;
  while (!simulation.stage_complete()) {
    simulation.evaluate_forces();
    simulation.advance();
    const double travel = largest_travel_since_search(simulation.contact());
    if (simulation.state().step % 10 != 0 || search_is_due(simulation.contact(), travel)) continue;
    Model model = simulation.model();
    Contact contact = simulation.contact(), fresh = searched_afresh(model, contact, team);
    const std::vector<double> found = forces_of(model, contact), wanted = forces_of(model, fresh);
    double largest = 0, difference = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      largest = std::max(largest, std::abs(wanted[i]));
      difference = std::max(difference, std::abs(wanted[i] - found[i]));
    }
    CAPTURE(simulation.state().step, largest);
    REQUIRE(difference <= 1e-12 * largest);
    largest_force = std::max(largest_force, largest);
    ++compared;
  }
  CHECK(compared > 20);
  CHECK(largest_force > 0);
}

TEST_CASE("grains that are evaluated together get the forces of grains that are evaluated one by one") {
  Scenario scenario = compaction_scenario(0.75, 2e4);
  scenario.bond = table_1(0.05);
  ThreadTeam team(2);
  Simulation simulation(build_model(eight_grains(4), scenario, "test"), scenario, team);
  while (!simulation.stage_complete()) simulation.evaluate_forces(), simulation.advance();
  Model model = simulation.model();
  Contact contact = simulation.contact();
  const std::vector<double> alone = forces_of(model, contact);
  CHECK(*std::max_element(alone.begin(), alone.end()) > 0);
  for (const std::size_t size : {2u, 3u, 8u}) {
    CAPTURE(size);
    CHECK(forces_of_groups(model, contact, size) == alone); // same sums in the same order
  }
}
