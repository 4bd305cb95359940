#include "solver/boundary/tools.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "solver/parallel/totals.hpp"

namespace mpfem {

namespace {

/// Calls visit(surface) with a tool's surface where it stands now.
template <class Visitor>
auto with_surface(const Tool& tool, Visitor&& visit) {
  return std::visit(
      [&](const auto& surface) {
        return visit(Shifted<std::decay_t<decltype(surface)>>{surface, vector_of(tool.moved)});
      },
      tool.surface);
}

/// The point about which a tool's moment is taken: a point of the plane, the centre, the apex.
Vector3<double> reference_of(const ToolSurface& surface) {
  return std::visit(
      [](const auto& s) {
        if constexpr (requires { s.point; })
          return s.point;
        else if constexpr (requires { s.centre; })
          return s.centre;
        else
          return s.apex;
      },
      surface);
}

/// The energies (mJ) and the area (mm^2) that all nodes together have.
template <class Friction, class Sticking>
void take_sums(ToolLoad& load, const Friction& friction, const Sticking& sticking) {
  load.friction_energy = friction.energy;
  load.friction_dissipation = friction.dissipation;
  load.adhesion_energy = sticking.energy;
  load.adhesion_dissipation = sticking.dissipation;
  load.bonded_area = sticking.bonded_area;
}

} // namespace

Tools::Tools(std::vector<Tool> tools, int grains) : grains_(grains), tools_(std::move(tools)) {
  of_grain_.resize(tools_.size() * static_cast<std::size_t>(grains_));
  anchors_.resize(of_grain_.size());
  bonds_.resize(of_grain_.size());
  load_.resize(tools_.size());
}

ToolLoad Tools::add_tool(Model& model, std::size_t index, const Bounds& bounds, double last_step, int grain) {
  static const Adhesion nothing_sticks;
  const Tool& tool = tools_[index];
  const bool sticky = tool.adhesion.has_value();
  const Adhesion& adhesion = sticky ? *tool.adhesion : nothing_sticks;
  std::vector<SurfaceAnchor>& anchors = anchors_[slot(grain, index)];
  std::vector<SurfaceBond>& bonds = bonds_[slot(grain, index)];
  return with_surface(tool, [&](const auto& surface) {
    ToolLoad load;
    if (!surface.may_touch(bounds) && anchors.empty() && !any_bond_to_update(adhesion, bonds)) return load;
    const Vector3<double> moved = vector_of(tool.moved), about = reference_of(tool.surface) + moved;
    const auto add_reaction = [&](std::size_t node, const Vector3<double>& on_node) {
      load.force = load.force - on_node;
      load.moment = load.moment - cross(model.contact_point(node) - about, on_node);
    };
    const auto add_bond_reaction = [&](std::size_t node, const Vector3<double>& on_node,
                                       const Vector3<double>& normal) {
      add_reaction(node, on_node);
      load.normal_force += dot(on_node, normal);
    };
    SurfaceFriction friction(model, tool.friction, surface, {moved, vector_of(tool.movement), last_step}, anchors);
    SurfaceAdhesion sticking(model, adhesion, surface, moved, grain, bonds, add_bond_reaction);
    const double size = model.element_size[static_cast<std::size_t>(grain)];
    for_each_node_behind(model, surface, bounds, grain, [&](std::size_t node, const auto& gap) {
      const HeldNode held = sticky ? sticking.hold(node, gap) : HeldNode{};
      const double full = surface_force(model, node, grain, gap.distance), push = held.penalty_left * full;
      gap.normal.push(model, node, push);
      Vector3<double> on_node = push * gap.normal.vector();
      if (tool.friction > 0)
        on_node = on_node + friction.add_force(node, gap, full,
                                               {held.friction_share, held.penalty_left, held.penalty_left_before});
      add_reaction(node, on_node);
      load.normal_force += push;
      load.energy += wall_energy(full, gap.distance);
      load.penetration = std::max(load.penetration, -gap.distance / size);
    });
    if (tool.friction > 0) anchors = friction.finish();
    if (sticky) bonds = sticking.finish();
    take_sums(load, friction, sticking);
    return load;
  });
}

void Tools::add_forces(Model& model, const Bounds& bounds, double last_step, int grain) {
  for (std::size_t tool = 0; tool < size(); ++tool)
    of_grain_[slot(grain, tool)] = tools_[tool].away ? ToolLoad{} : add_tool(model, tool, bounds, last_step, grain);
}

double Tools::take_loads(const Communicator& ranks, const Ownership& ownership) {
  Totals<ToolLoad> totals(size());
  for (const std::int32_t grain : ownership.own)
    for (std::size_t index = 0; index < size(); ++index) totals.add(of_grain_[slot(grain, index)], index);
  totals.combine(ranks);
  double work = 0;
  for (std::size_t index = 0; index < size(); ++index) {
    const ToolLoad sum = totals[index];
    Tool& tool = tools_[index];
    const double own_work = -0.5 * dot(sum.force + vector_of(tool.force), vector_of(tool.movement));
    work += own_work;
    tool.work += own_work;
    tool.force = array_of(sum.force);
    tool.movement = {};
    tool.friction_dissipation += sum.friction_dissipation;
    tool.adhesion_dissipation += sum.adhesion_dissipation;
    load_[index] = sum;
  }
  return work;
}

ToolLoad Tools::total() const {
  ToolLoad sum;
  for (const ToolLoad& load : load_) add_terms(sum, load);
  return sum;
}

double Tools::adhesion_dissipation() const {
  double sum = 0;
  for (const Tool& tool : tools_) sum += tool.adhesion_dissipation;
  return sum;
}

bool Tools::adhere() const {
  return std::any_of(tools_.begin(), tools_.end(), [](const Tool& tool) { return tool.adhesion.has_value(); });
}

void Tools::move(std::span<const std::array<double, 3>> velocity, double step) {
  for (std::size_t index = 0; index < velocity.size(); ++index)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      tools_[index].movement[axis] = step * velocity[index][axis];
      tools_[index].moved[axis] += tools_[index].movement[axis];
    }
}

void Tools::add_stiffness_rate(const Model& model, const Bounds& bounds, int grain, std::span<double> rate) const {
  for (std::size_t index = 0; index < size(); ++index) {
    const Tool& tool = tools_[index];
    if (tool.away) continue;
    with_surface(tool, [&](const auto& surface) {
      add_surface_stiffness_rate(model, surface, bounds, grain, rate);
      if (tool.adhesion) add_adhesion_stiffness_rate(model, *tool.adhesion, surface, grain, bonds(grain, index), rate);
    });
  }
  for (const Tool& tool : tools_)
    if (tool.adhesion) raise_to_rate_of_new_bonds(model, *tool.adhesion, grain, rate);
}

/// N, the pull of a tool's bond on a node in front of it, along the surface's normal and positive towards the grains.
double Tools::pull_on_node(const Model& model, std::size_t node, int grain, std::size_t index) const {
  const Tool& tool = tools_[index];
  const std::vector<SurfaceBond>& list = bonds(grain, index);
  const auto bond = std::ranges::lower_bound(list, static_cast<std::int32_t>(node), {}, &SurfaceBond::node);
  if (bond == list.end() || bond->node != static_cast<std::int32_t>(node) || !bond->intact()) return 0;
  const Vector3<double> normal = with_surface(tool, [&](const auto& surface) {
    return gap_at_any_distance(surface, NodePoint{model, node}).normal.vector();
  });
  return dot(force_of_bond(model, *tool.adhesion, vector_of(tool.moved), grain, *bond), normal);
}

double Tools::push_on_node(const Model& model, std::size_t node, int grain) const {
  double push = 0;
  for (std::size_t index = 0; index < size(); ++index) {
    if (tools_[index].away) continue;
    const double distance = with_surface(tools_[index], [&](const auto& surface) {
      return surface.gap(NodePoint{model, node}).distance;
    });
    if (distance < 0)
      push += surface_force(model, node, grain, distance);
    else if (tools_[index].adhesion)
      push += pull_on_node(model, node, grain, index);
  }
  return push;
}

double Tools::remove_forces_on_grain(Model& model, std::size_t index, const Bounds& bounds, double last_step,
                                     int grain) {
  const std::size_t first = model.first_row(grain), end = model.end_row(grain);
  const std::vector<double> all(model.force.begin() + first, model.force.begin() + end);
  std::fill(model.force.begin() + first, model.force.begin() + end, 0.0);
  add_tool(model, index, bounds, last_step, grain);
  double power = 0;
  for (std::size_t i = first; i < end; ++i) {
    power += model.velocity[i] * model.force[i];
    model.force[i] = all[i - first] - model.force[i];
  }
  return 0.5 * last_step * power;
}

/// Takes a tool's forces off all grains; the energies are added up in the order of grains.
double Tools::remove_forces_on_all_grains(Model& model, std::size_t index, std::span<const Bounds> bounds,
                                          double last_step, const Communicator& ranks) {
  return sum_over_grains(ranks, model.own(), [&](std::int32_t grain) {
    return of_grain_[slot(grain, index)].acts()
               ? remove_forces_on_grain(model, index, bounds[static_cast<std::size_t>(grain)], last_step, grain)
               : 0.0;
  });
}

namespace {

/// Collective. mm, depth of the deepest node behind a tool.
double depth_of_grains(const Tool& tool, const Model& model, const Communicator& ranks) {
  double deepest = 0;
  with_surface(tool, [&](const auto& surface) {
    for (const std::int32_t grain : model.own())
      for_each_node_behind(model, surface, grain,
                           [&](std::size_t, const auto& gap) { deepest = std::max(deepest, -gap.distance); });
  });
  return ranks.largest(deepest);
}

/// Collective. Where a tool stands that returns (mm, since the start of the run): back along its way in, or a plane's
/// normal, as far as it needs to touch no grain. Throws SimulationError if that does not free it.
std::array<double, 3> free_place(Tool tool, const std::array<double, 3>& way, const Model& model,
                                 const Communicator& ranks) {
  constexpr double rounding = 1e-9; // mm, depth that is left
  constexpr double most = 10;       // times the depth: a surface along the way is not left by going on and on
  std::array<double, 3> out = way;
  if (const auto* plane = std::get_if<OrientedPlane>(&tool.surface))
    for (std::size_t axis = 0; axis < 3; ++axis) out[axis] = plane->normal[axis];
  double deepest = depth_of_grains(tool, model, ranks);
  const double first = deepest;
  // One move for a plane; where the surface is oblique to the way, each leaves a part.
  for (double moved = 0; deepest > rounding && moved < most * first && out != std::array<double, 3>{};) {
    for (std::size_t axis = 0; axis < 3; ++axis) tool.moved[axis] -= deepest * out[axis];
    moved += deepest;
    deepest = depth_of_grains(tool, model, ranks);
  }
  if (deepest > rounding)
    throw SimulationError(fmt::format(
        "tool '{}' would stand {:.4g} mm inside grains, allowed: a place where it touches none; move it, "
        "let the grains move out of its way first, or drive it along a direction away from which it is free",
        tool.name, first));
  return tool.moved;
}

} // namespace

double Tools::set_away(std::span<const std::size_t> away, std::span<const std::array<double, 3>> ways, Model& model,
                       std::span<const Bounds> bounds, double last_step, const Communicator& ranks) {
  double taken = 0;
  moved_back_.clear();
  for (std::size_t index = 0; index < size(); ++index) {
    Tool& tool = tools_[index];
    const bool leaves = std::find(away.begin(), away.end(), index) != away.end();
    if (leaves && !tool.away) {
      const double own = load_[index].energy + load_[index].friction_energy + load_[index].adhesion_energy +
                         remove_forces_on_all_grains(model, index, bounds, last_step, ranks);
      taken += own;
      tool.work -= own;
      load_[index] = {};
      tool.force = tool.movement = {};
      for (int grain = 0; grain < grains_; ++grain) {
        of_grain_[slot(grain, index)] = {};
        anchors_[slot(grain, index)].clear();
        for (SurfaceBond& bond : bonds_[slot(grain, index)]) cut(bond);
      }
    }
    if (!leaves && tool.away) {
      const std::array<double, 3> place = free_place(tool, ways[index], model, ranks);
      const double back = std::hypot(place[0] - tool.moved[0], place[1] - tool.moved[1], place[2] - tool.moved[2]);
      if (back > 0)
        moved_back_.push_back(
            fmt::format("tool '{}' begins {:.3g} mm farther back, where it touches no grain", tool.name, back));
      tool.moved = place;
    }
    tool.away = leaves;
  }
  return taken;
}

void Tools::forget() {
  for (auto& list : anchors_) list.clear();
  for (auto& list : bonds_) list.clear();
}

void Tools::refuse_triangles(std::size_t tool) const {
  throw InputError(
      fmt::format("tool '{}': its STL file is another one than that with which the checkpoint was written, "
                  "allowed: the same triangles at the same place",
                  tools_[tool].name));
}

std::optional<std::pair<std::size_t, double>> Tools::behind(const Model& model, std::size_t node) const {
  std::optional<std::pair<std::size_t, double>> found;
  for (std::size_t tool = 0; tool < size(); ++tool) {
    if (tools_[tool].away) continue;
    const double depth = -with_surface(tools_[tool], [&](const auto& surface) {
      return surface.gap(NodePoint{model, node}).distance;
    });
    if (depth > 0 && (!found || depth > found->second)) found = {tool, depth};
  }
  return found;
}

} // namespace mpfem
