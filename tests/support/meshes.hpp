#pragma once
// Small meshes made without a mesher: boxes and balls of Kuhn tetrahedra, several grains side by side.

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "solver/model/model.hpp"

namespace mpfem::test {

/// The mesh of one grain: nodes (mm), tetrahedra of positive volume as indices of its nodes.
struct GrainMesh {
  std::vector<std::array<double, 3>> node;
  std::vector<std::array<std::int32_t, 4>> tet;
};

/// The cube [-1, 1]^3 in cells[0] x cells[1] x cells[2] cells of six tetrahedra each (Kuhn), all with positive volume.
inline GrainMesh block_mesh(const std::array<int, 3>& cells) {
  GrainMesh mesh;
  const auto id = [&](int i, int j, int k) {
    return static_cast<std::int32_t>((i * (cells[1] + 1) + j) * (cells[2] + 1) + k);
  };
  for (int i = 0; i <= cells[0]; ++i)
    for (int j = 0; j <= cells[1]; ++j)
      for (int k = 0; k <= cells[2]; ++k)
        mesh.node.push_back({-1 + 2.0 * i / cells[0], -1 + 2.0 * j / cells[1], -1 + 2.0 * k / cells[2]});
  static constexpr int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int i = 0; i < cells[0]; ++i)
    for (int j = 0; j < cells[1]; ++j)
      for (int k = 0; k < cells[2]; ++k)
        for (int p = 0; p < 6; ++p) {
          int corner[3] = {i, j, k};
          std::array<std::int32_t, 4> tet{id(i, j, k)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++corner[order[p][step]];
            tet[step + 1] = id(corner[0], corner[1], corner[2]);
          }
          if (p >= 3) std::swap(tet[2], tet[3]); // odd permutations
          mesh.tet.push_back(tet);
        }
  return mesh;
}

/// The cube [-1, 1]^3 in n^3 cells.
inline GrainMesh cube_mesh(int n) {
  return block_mesh({n, n, n});
}

/// A ball of the given radius: the cube's shells mapped to spheres.
inline GrainMesh ball_mesh(int n, double radius) {
  GrainMesh mesh = cube_mesh(n);
  for (auto& x : mesh.node) {
    const double shell = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    if (shell == 0) continue;
    // equal angles rather than equal distances on the faces
    double length = 0;
    std::array<double, 3> direction{};
    for (std::size_t a = 0; a < 3; ++a) {
      direction[a] = std::tan(x[a] / shell * M_PI / 4);
      length += direction[a] * direction[a];
    }
    for (std::size_t a = 0; a < 3; ++a) x[a] = radius * shell * direction[a] / std::sqrt(length);
  }
  return mesh;
}

/// Adds `shift` (mm) to every node.
inline void move(GrainMesh& mesh, const std::array<double, 3>& shift) {
  for (auto& x : mesh.node)
    for (std::size_t a = 0; a < 3; ++a) x[a] += shift[a];
}

/// Multiplies every coordinate by `factor`, about the origin.
inline void scale(GrainMesh& mesh, double factor) {
  for (auto& x : mesh.node)
    for (double& c : x) c *= factor;
}

/// Rotation about an axis (unit vector) by an angle in rad.
inline void rotate(GrainMesh& mesh, const std::array<double, 3>& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (auto& x : mesh.node) {
    const double d = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
    const std::array<double, 3> k = {axis[1] * x[2] - axis[2] * x[1], axis[2] * x[0] - axis[0] * x[2],
                                     axis[0] * x[1] - axis[1] * x[0]};
    for (std::size_t a = 0; a < 3; ++a) x[a] = c * x[a] + s * k[a] + (1 - c) * d * axis[a];
  }
}

/// One packing of these grains, in this order, in a box from the origin to `box` (mm).
inline MeshedPacking pack(const std::vector<GrainMesh>& grains, const std::array<double, 3>& box) {
  MeshedPacking packing;
  packing.box_lengths = box;
  packing.grain_node_offset = {0};
  packing.grain_tet_offset = {0};
  for (const GrainMesh& grain : grains) {
    const auto first = static_cast<std::int32_t>(packing.node.size() / 3);
    for (const auto& x : grain.node) packing.node.insert(packing.node.end(), x.begin(), x.end());
    for (const auto& tet : grain.tet)
      for (const std::int32_t node : tet) packing.tet.push_back(first + node);
    packing.grain_node_offset.push_back(static_cast<std::int32_t>(packing.node.size() / 3));
    packing.grain_tet_offset.push_back(static_cast<std::int32_t>(packing.tet.size() / 4));
  }
  return packing;
}

/// An elastic or elasto-plastic scenario without walls that holds for a time.
inline Scenario holding_scenario(double duration, HardeningLaw law = HardeningLaw::elastic) {
  Scenario scenario;
  scenario.packing_file = "test";
  scenario.walls = false;
  scenario.material = {1.55e-9, 5000, 0.3, {law, 25, 125, 0.3, {}, {}}};
  Stage stage;
  stage.name = "hold";
  stage.type = Rest{duration};
  scenario.stages = {stage};
  return scenario;
}

/// The same material between walls that compact it (mm/s) to a relative density.
inline Scenario compaction_scenario(double relative_density, double wall_speed) {
  Scenario scenario = holding_scenario(1, HardeningLaw::power);
  scenario.walls = true;
  Stage stage;
  stage.name = "compaction";
  stage.type = IsotropicCompaction{.relative_density = relative_density, .wall_speed = wall_speed};
  scenario.stages = {stage};
  return scenario;
}

} // namespace mpfem::test
