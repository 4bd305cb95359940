#pragma once
// A run of one grain, the cube [-1, 1]^3 of 48 tets, with three rows of history and one snapshot.

#include "run_file.hpp"
#include "tests/support/meshes.hpp"

namespace mpfem::test {

inline RunContents small_run() {
  const GrainMesh mesh = cube_mesh(2);
  RunContents c;
  c.extents = {{"rows", 3},  {"tets", mesh.tet.size()}, {"nodes", mesh.node.size()}, {"grains", 2}, {"profile", 2},
               {"*pairs", 1}};
  for (const auto& x : mesh.node)
    c.numbers["/snapshots/*/node"].insert(c.numbers["/snapshots/*/node"].end(), x.begin(), x.end());
  for (const auto& tet : mesh.tet) {
    c.numbers["/mesh/tet"].insert(c.numbers["/mesh/tet"].end(), tet.begin(), tet.end());
    c.numbers["/snapshots/*/von_mises"].push_back(static_cast<double>(c.numbers["/snapshots/*/von_mises"].size()));
  }
  const auto tets = static_cast<double>(mesh.tet.size()), nodes = static_cast<double>(mesh.node.size());
  c.numbers["/mesh/grain_tet_offset"] = {0, 24, tets}; // two grains, each a half of the tets
  c.numbers["/mesh/grain_node_offset"] = {0, 13, nodes};
  c.numbers["/snapshots/*/box_low"] = {-1.5, -1.5, -1.5};
  c.numbers["/snapshots/*/box_high"] = {1.5, 1.5, 1.5};
  c.numbers["/snapshots/*/time"] = {2e-6};
  c.numbers["/snapshots/*/relative_density"] = {0.8};
  c.numbers["/snapshots/*/pair_grains"] = {0, 1};
  c.numbers["/snapshots/*/pair_force"] = {3, 0, 4};
  c.numbers["/snapshots/*/pair_area"] = {0.5};
  c.numbers["/history/time"] = {0, 1e-6, 2e-6};
  c.numbers["/history/step"] = {0, 10, 20};
  c.numbers["/history/relative_density"] = {0.5, 0.7, 0.8};
  c.numbers["/history/mean_stress"] = {0, 5, 10};
  c.numbers["/history/external_work"] = {0, 2, 4};
  c.numbers["/history/energy_residual"] = {0, -0.06, 0.02};
  c.numbers["/history/elastic_energy"] = {0, 1, 1};
  c.numbers["/history/plastic_dissipation"] = {0, 1, 3};
  c.numbers["/history/kinetic_energy"] = {0.5, 0.04, 0.02};
  c.numbers["/history/max_penetration"] = {0, 0.03, 0.02};
  c.numbers["/history/time_step"] = {0, 1e-7, 5e-8};
  c.numbers["/history/surface_area"] = {10, 10, 10};
  c.numbers["/history/contact_area"] = {0, 1, 4};
  c.numbers["/history/wall_stress"] = {0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  c.numbers["/provenance/wall_time"] = {0.96};
  c.numbers["/provenance/threads"] = {2};
  c.numbers["/provenance/profile_seconds"] = {0.72, 0.24};
  c.texts["/provenance/profile_name"] = {"element forces", "rest"};
  c.texts["/provenance/status"] = {"complete"};
  return c;
}

} // namespace mpfem::test
