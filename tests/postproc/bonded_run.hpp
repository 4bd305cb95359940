#pragma once
// A run of two cubes of 2 mm that are bonded over the plane square x = 1, beside a third that is not.

#include <cmath>

#include "small_run.hpp"

namespace mpfem::test {

/// Cells along a cube's edge: the contact has (cells + 1)^2 nodes on either side.
constexpr int cube_cells = 4;

/// Damage of a bond at (y, z) in [-1, 1]^2: rises linearly from 0 at y = -1 to 1 at y = 1, so that its mean is a half.
inline double damage_at(double y) {
  return 0.5 * (y + 1);
}

/// The mesh, instead of that of small_run().
inline void add_mesh(RunContents& c, const MeshedPacking& packing) {
  std::erase_if(c.numbers, [](const auto& entry) {
    return entry.first.starts_with("/snapshots/") || entry.first.starts_with("/mesh/");
  });
  c.numbers["/mesh/tet"].assign(packing.tet.begin(), packing.tet.end());
  c.numbers["/mesh/grain_tet_offset"].assign(packing.grain_tet_offset.begin(), packing.grain_tet_offset.end());
  c.numbers["/mesh/grain_node_offset"].assign(packing.grain_node_offset.begin(), packing.grain_node_offset.end());
  c.numbers["/snapshots/*/node"] = packing.node;
}

inline void add_snapshot_numbers(RunContents& c) {
  const std::pair<const char*, std::vector<double>> numbers[] = {
      {"box_low", {-1.5, -1.5, -1.5}}, {"box_high", {3.5, 1.5, 3.5}},         {"time", {2e-6}},
      {"relative_density", {0.8}},     {"pair_grains", {0, 1, 0, 2}},         {"pair_force", {-10, 0, 0, 0, 0, -1}},
      {"pair_area", {4, 4}},           {"pair_bonded_area", {3.5, 0}},        {"pair_damage", {0.5, -1}},
      {"pair_bond_energy", {0.25, 0}}, {"pair_damage_dissipation", {0.75, 0}}};
  for (const auto& [name, values] : numbers) c.numbers[std::string("/snapshots/*/") + name] = values;
}

/// The bonds stand for the trapezoid rule's areas.
inline void add_bonds(RunContents& c, const std::vector<double>& node) {
  const std::size_t nodes = node.size() / 3;
  auto& damage = c.numbers["/snapshots/*/damage"];
  damage.assign(nodes, -1);
  constexpr double spacing = 2.0 / cube_cells;
  const auto weight = [](double at) { return std::abs(at) > 1 - 1e-9 ? 0.5 * spacing : spacing; };
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto grain = n * 3 / nodes; // three grains of as many nodes
    const double x = node[3 * n], y = node[3 * n + 1], z = node[3 * n + 2];
    if (grain == 2 || std::abs(x - 1) > 1e-9) continue;
    damage[n] = damage_at(y);
    c.numbers["/snapshots/*/bond_node"].push_back(static_cast<double>(n));
    c.numbers["/snapshots/*/bond_grain"].push_back(grain == 0 ? 1 : 0);
    c.numbers["/snapshots/*/bond_damage"].push_back(damage_at(y));
    c.numbers["/snapshots/*/bond_area"].push_back(weight(y) * weight(z));
    c.numbers["/snapshots/*/bond_separation"].push_back(0.001 * (y + 1)); // opening
    c.numbers["/snapshots/*/bond_separation"].push_back(0.002);           // sliding
  }
}

/// Grain 0 is the cube [-1, 1]^3, grain 1 the one next to it along +x, grain 2 a third above the first along z, which
/// touches it without bonds. The bonds of 0 and 1 stand for the trapezoid rule's areas: 4 mm^2 on either side.
inline RunContents bonded_run() {
  GrainMesh first = cube_mesh(cube_cells), second = first, third = first;
  move(second, {2, 0, 0});
  move(third, {0, 0, 2});
  const MeshedPacking packing = pack({first, second, third}, {6, 6, 6});
  RunContents c = small_run();
  add_mesh(c, packing);
  add_snapshot_numbers(c);
  add_bonds(c, packing.node);
  c.numbers["/history/bonds"] = {0, 60, 40};
  c.numbers["/history/bonded_area"] = {0, 8, 7};
  c.numbers["/history/mean_damage"] = {0, 0.25, 0.5};
  c.numbers["/history/bond_energy"] = {0, 0.5, 0.25};
  c.numbers["/history/damage_dissipation"] = {0, 0.25, 0.75};
  c.extents = {{"rows", 3},
               {"tets", packing.tet.size() / 4},
               {"nodes", packing.node.size() / 3},
               {"grains", 3},
               {"profile", 2},
               {"*pairs", 2},
               {"*bonds", c.numbers.at("/snapshots/*/bond_node").size()}};
  return c;
}

} // namespace mpfem::test
