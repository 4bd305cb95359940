#include "solver/run/initial_state.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/parallel/agree.hpp"
#include "solver/parallel/totals.hpp"

namespace mpfem {

namespace {

using Vector = std::array<double, 3>;

/// Sets the velocity of one grain: that of its centre of mass and a spin about it. Returns its kinetic energy (mJ).
double set_velocity(Model& model, std::size_t grain, const Vector& linear, const Vector& spin) {
  const auto first = static_cast<std::size_t>(model.node_offset[grain]),
             end = static_cast<std::size_t>(model.node_offset[grain + 1]);
  Vector centre{};
  for (std::size_t n = first; n < end; ++n)
    for (std::size_t axis = 0; axis < 3; ++axis)
      centre[axis] += model.position[4 * n + axis] / (model.inverse_mass[n] * model.mass[grain]);
  double energy = 0;
  for (std::size_t n = first; n < end; ++n) {
    const double* x = &model.position[4 * n];
    const double r[3] = {x[0] - centre[0], x[1] - centre[1], x[2] - centre[2]};
    double* v = &model.velocity[4 * n];
    v[0] = linear[0] + spin[1] * r[2] - spin[2] * r[1];
    v[1] = linear[1] + spin[2] * r[0] - spin[0] * r[2];
    v[2] = linear[2] + spin[0] * r[1] - spin[1] * r[0];
    for (int axis = 0; axis < 3; ++axis) energy += 0.5 * v[axis] * v[axis] / model.inverse_mass[n];
  }
  return energy;
}

[[noreturn]] void refuse_overlap(const std::string& packing_file, const std::string& what) {
  throw InputError(fmt::format("{}: {}, allowed: no overlap; pack with a larger smallest_gap", packing_file, what));
}

/// Largest penetration of a pair's points over the element size.
double deepest_point(const Model& model, const Contact& contact, std::int32_t pair, std::size_t grain) {
  double deepest = 0;
  // An intact bond may carry the force of a point itself: then the push is zero and the bond's force gives the depth.
  for (const auto points : {contact.active_points(pair), contact.pulling_bonds(pair)})
    for (const ContactForce& point : points)
      if (point.stiffness > 0)
        deepest = std::max(deepest, std::hypot(point.force[0], point.force[1], point.force[2]) /
                                        (point.stiffness * model.element_size[grain]));
  return deepest;
}

void check_overlap(Model& model, Contact& contact, int grain, const std::string& packing_file) {
  /// At the start, nodes may lie inside a neighbour by rounding errors, but not by more.
  constexpr double overlap_tolerance = 1e-6; // of h
  contact_forces(model, contact, grain);
  const ContactCandidates& c = contact.candidates;
  const auto g = static_cast<std::size_t>(grain);
  for (std::int32_t pair = c.outgoing_offset[g]; pair < c.outgoing_offset[g + 1]; ++pair)
    if (const double deepest = deepest_point(model, contact, pair, g); deepest > overlap_tolerance)
      refuse_overlap(packing_file, fmt::format("grains {} and {} overlap at the start by {:.3g} of the element size",
                                               grain, c.pair_second[static_cast<std::size_t>(pair)], deepest));
}

void check_within_walls(const Box& box, const Bounds& b, std::int32_t grain, const std::string& packing_file) {
  constexpr double rounding = 1e-9; // mm
  const Cell& cell = box.cell();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (box.has_walls(axis) && (b.low[axis] < cell.low[axis] - rounding || b.high[axis] > cell.high[axis] + rounding))
      throw InputError(
          fmt::format("{}: grain {} spans {:.6g} … {:.6g} mm along axis {}, allowed: within the box {:.6g} … {:.6g}",
                      packing_file, grain, b.low[axis], b.high[axis], axis, cell.low[axis], cell.high[axis]));
}

/// Collective. Calls check(grain) for all own grains; all ranks throw the error of the lowest grain that fails.
template <class Check>
void for_own_grains(const Model& model, const Communicator& ranks, Check&& check) {
  std::int32_t present = 0;
  agree(
      ranks,
      [&] {
        for (const std::int32_t grain : model.own()) {
          present = grain;
          check(grain);
        }
      },
      [&] { return static_cast<double>(present); });
}

} // namespace

double set_initial_velocities(Model& model, const Scenario& scenario, const Communicator& ranks) {
  const auto grains = static_cast<std::size_t>(model.grains);
  for (const auto* list : {&scenario.grain_velocity, &scenario.grain_angular_velocity})
    if (!list->empty() && list->size() != grains)
      throw InputError(fmt::format("{}: key 'initial': found {} rows for {} grains, allowed: one row per grain",
                                   scenario.packing_file, list->size(), grains));
  return sum_over_grains(ranks, model.own(), [&](std::int32_t grain) {
    const auto g = static_cast<std::size_t>(grain);
    return set_velocity(model, g,
                        scenario.grain_velocity.empty() ? scenario.initial_velocity : scenario.grain_velocity[g],
                        scenario.grain_angular_velocity.empty() ? Vector{} : scenario.grain_angular_velocity[g]);
  });
}

void check_apart(Model& model, Contact& contact, const Box& box, const std::vector<Bounds>& bounds,
                 const std::string& packing_file, const Communicator& ranks) {
  for_own_grains(model, ranks, [&](std::int32_t grain) {
    check_overlap(model, contact, grain, packing_file);
    check_within_walls(box, bounds[static_cast<std::size_t>(grain)], grain, packing_file);
  });
}

void check_clear_of_tools(const Model& model, const Tools& tools, const std::string& packing_file,
                          const Communicator& ranks) {
  constexpr double rounding = 1e-9; // mm
  for_own_grains(model, ranks, [&](std::int32_t grain) {
    const auto g = static_cast<std::size_t>(grain);
    for (std::int32_t n = model.node_offset[g]; n < model.node_offset[g] + model.surface_node_count[g]; ++n)
      if (const auto found = tools.behind(model, static_cast<std::size_t>(n)); found && found->second > rounding) {
        const Tool& tool = tools[found->first];
        throw InputError(fmt::format("{}: grain {} reaches {:.4g} mm into the tool '{}' at the start, allowed: no "
                                     "overlap; move the tool, or pack with a larger smallest_gap{}{}",
                                     packing_file, g, found->second, tool.name, tool.size.empty() ? "" : "; ",
                                     tool.size));
      }
  });
}

} // namespace mpfem
