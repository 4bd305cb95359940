// The contact surface measured: what orientation, unequal meshes and faceted surfaces do to contact forces, and how
// much contact pressure oscillates from node to node. The measurements of studies/contact-surface; each prints CSV.
//
//   contact-surface geometry                                      how far facets lie from the sphere
//   contact-surface rotations ELEMENT SCALING R/h FIRST LAST      elastic columns of two, meshes turned by each seed
//   contact-surface unequal ELEMENT R/h R/h FIRST LAST            lower and upper sphere meshed differently, also
//   renumbered contact-surface pressure ELEMENT R/h FACTOR PROFILE.csv       elasto-plastic pair, flattened; pressure
//   node by node contact-surface packing ELEMENT PACKING.h5 FACTOR             a meshed packing compacted to a relative
//   density of 0.9
//
// ELEMENT: tet4, tet4-anp. SCALING: exact (volume, as pack-gen makes grains), smooth (the same with
// contact.surface = "smooth") or inscribed (nodes on the sphere).
// R/h: radius over nominal element size. FACTOR: penalty K = FACTOR E/h.

#include <cstdlib>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "pack-gen/random.hpp"
#include "tests/support/pressed_column.hpp"
#include "tests/support/surface_pressure.hpp"

namespace {

using namespace mpfem;
using namespace mpfem::test;

constexpr double radius = 0.1, youngs_modulus = 5000, poissons_ratio = 0.3;
constexpr double reduced = youngs_modulus / (1 - poissons_ratio * poissons_ratio);

ElementType element_of(const std::string& name) {
  return name == "tet4-anp" ? ElementType::tet4_anp : ElementType::tet4;
}

/// A ball of pack-gen's with its surface nodes on the sphere, or, as in packings, with the sphere's exact volume.
GrainMesh ball(double size_ratio, bool exact_volume) {
  const UnitBall unit = mesh_unit_ball(size_ratio, 1);
  GrainMesh mesh;
  for (const auto& x : unit.ball.mesh.node) mesh.node.push_back({x[0], x[1], x[2]});
  mesh.tet = unit.ball.mesh.tet;
  scale(mesh, radius * (exact_volume ? std::cbrt(4.0 / 3.0 * M_PI / unit.volume) : 1.0));
  return mesh;
}

/// Turned at random as pack-gen turns grains.
GrainMesh turned(GrainMesh mesh, std::uint64_t seed) {
  const Eigen::Matrix3d turn = Random(seed * 0x9E3779B97F4A7C15ULL).rotation();
  for (auto& x : mesh.node) {
    const Eigen::Vector3d y = turn * Eigen::Vector3d(x[0], x[1], x[2]);
    x = {y[0], y[1], y[2]};
  }
  return mesh;
}

double error_of(double force, double approach) {
  return force / finite_sphere_force(approach, radius, reduced) - 1;
}

void geometry() {
  fmt::print("scaling,size_ratio,tets,surface_nodes,mean_edge_over_radius,node_radius_over_radius,mean_facet_offset,"
             "rms_facet_offset,largest_inside\n");
  for (const bool exact : {false, true})
    for (const double ratio : {4.0, 5.0, 7.0, 10.0}) {
      const GrainMesh mesh = ball(ratio, exact);
      double area = 0, sum = 0, square = 0, inside = 0, node_radius = 0, edge = 0;
      std::size_t edges = 0;
      const auto facets = boundary_facets(mesh.tet);
      std::set<std::int32_t> surface;
      for (const auto& f : facets) {
        Eigen::Vector3d x[3];
        for (std::size_t c = 0; c < 3; ++c) {
          const auto& p = mesh.node[static_cast<std::size_t>(f[c])];
          x[c] = {p[0], p[1], p[2]};
          surface.insert(f[c]);
        }
        for (int c = 0; c < 3; ++c) edge += (x[c] - x[(c + 1) % 3]).norm(), ++edges;
        const double facet_area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
        constexpr int n = 12; // midpoints of n^2 equal triangles
        for (int i = 0; i < n; ++i)
          for (int j = 0; i + j < n; ++j)
            for (int up = 0; up < (i + j < n - 1 ? 2 : 1); ++up) {
              const double a = (i + (up == 0 ? 1.0 : 2.0) / 3) / n, b = (j + (up == 0 ? 1.0 : 2.0) / 3) / n;
              const double offset = ((1 - a - b) * x[0] + a * x[1] + b * x[2]).norm() - radius;
              area += facet_area / (n * n);
              sum += offset * facet_area / (n * n);
              square += offset * offset * facet_area / (n * n);
              inside = std::max(inside, -offset);
            }
      }
      for (const auto s : surface) {
        const auto& p = mesh.node[static_cast<std::size_t>(s)];
        node_radius += std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      }
      node_radius /= static_cast<double>(surface.size());
      fmt::print("{},{},{},{},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f}\n", exact ? "exact" : "inscribed", ratio,
                 mesh.tet.size(), surface.size(), edge / static_cast<double>(edges) / radius, node_radius / radius,
                 sum / area / radius, std::sqrt(square / area) / radius, inside / radius);
    }
}

void print_state(const std::string& label, double nominal, const ColumnState& s) {
  const auto row = [&](const char* contact, double approach, double force) {
    fmt::print("{},{},{},{:.6f},{:.6e},{:.5f},{:.1e},{:.1e},{:.4f}\n", label, nominal, contact, approach / radius,
               force, error_of(force, approach), s.kinetic_over_elastic, s.residual_over_work, s.penetration);
  };
  row("wall", s.low_approach, s.low_force);
  row("wall", s.high_approach, s.high_force);
  row("pair", s.pair_approach, s.pair_force);
}
constexpr const char* state_columns =
    "nominal_approach,contact,approach,force,error,kinetic_over_elastic,residual_over_work,penetration\n";

void rotations(const std::string& element, const std::string& scaling, double size_ratio, std::uint64_t first,
               std::uint64_t last) {
  fmt::print("element,scaling,size_ratio,seed,{}", state_columns);
  const GrainMesh mesh = ball(size_ratio, scaling != "inscribed");
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    ColumnSetup setup;
    setup.element = element_of(element);
    setup.surface = scaling == "smooth" ? ContactSurface::smooth : ContactSurface::facets;
    setup.approaches = {0.01 * radius, 0.02 * radius, 0.04 * radius};
    PressedColumn column({turned(mesh, 2 * seed), turned(mesh, 2 * seed + 1)}, setup);
    for (const double approach : setup.approaches) {
      column.press();
      print_state(fmt::format("{},{},{},{}", element, scaling, size_ratio, seed), approach / radius, column.state());
    }
    std::fflush(stdout);
  }
}

void unequal(const std::string& element, double lower, double upper, std::uint64_t first, std::uint64_t last) {
  fmt::print("element,lower,upper,listed,seed,net_force_over_force,net_moment_over_force_radius,{}", state_columns);
  const GrainMesh lower_mesh = ball(lower, true), upper_mesh = ball(upper, true);
  for (std::uint64_t seed = first; seed <= last; ++seed)
    for (const bool from_top : {false, true}) {
      ColumnSetup setup;
      setup.element = element_of(element);
      setup.approaches = {0.01 * radius, 0.02 * radius, 0.04 * radius};
      setup.listed_from_top = from_top;
      PressedColumn column({turned(lower_mesh, 2 * seed), turned(upper_mesh, 2 * seed + 1)}, setup);
      for (const double approach : setup.approaches) {
        column.press();
        const ColumnState state = column.state();
        const SurfacePressure surface = surface_pressure(column.model(), column.simulation().contact());
        const auto size = [](const std::vector<double>& v) { return std::hypot(v[0], v[1], v[2]); };
        print_state(fmt::format("{},{},{},{},{},{:.1e},{:.1e}", element, lower, upper, from_top ? "top" : "bottom",
                                seed, size(surface.net_force) / state.pair_force,
                                size(surface.net_moment) / (state.pair_force * radius)),
                    approach / radius, state);
      }
      std::fflush(stdout);
      if (lower == upper) break; // the same meshes: nothing to exchange
    }
}

void pressure(const std::string& element, double size_ratio, double factor, const std::string& profile,
              ContactSurface contact_surface) {
  fmt::print(
      "element,size_ratio,factor,contact,nominal_approach,force,inner_nodes,mean_pressure,from_mean,from_plane,largest,"
      "own_from_mean,own_from_plane,penetration,kinetic_over_elastic,residual_over_work\n");
  const GrainMesh mesh = ball(size_ratio, true);
  ColumnSetup setup;
  setup.element = element_of(element);
  setup.law = HardeningLaw::power;
  setup.stiffness_factor = factor;
  setup.surface = contact_surface;
  setup.approaches = {0.05 * radius, 0.1 * radius, 0.2 * radius};
  PressedColumn column({turned(mesh, 3), turned(mesh, 4)}, setup);
  for (const double approach : setup.approaches) {
    column.press();
    const ColumnState state = column.state();
    const SurfacePressure surface = surface_pressure(column.model(), column.simulation().contact());
    const SurfacePressure on_walls = wall_pressure(column.simulation(), surface);
    for (const SurfacePressure* seen : {&surface, &on_walls}) {
      const PressureOscillation total = oscillation(column.model(), *seen, seen->total),
                                own = oscillation(column.model(), *seen, seen->own);
      fmt::print("{},{},{},{},{},{:.5f},{},{:.2f},{:.4f},{:.4f},{:.3f},{:.4f},{:.4f},{:.4f},{:.1e},{:.1e}\n",
                 element + (contact_surface == ContactSurface::smooth ? " smooth" : ""), size_ratio, factor,
                 seen == &surface ? "pair" : "wall", approach / radius, state.pair_force, total.nodes, total.mean,
                 total.from_mean, total.from_plane, total.largest, own.from_mean, own.from_plane, state.penetration,
                 state.kinetic_over_elastic, state.residual_over_work);
    }
    std::fflush(stdout);
    if (approach != setup.approaches.back()) continue;
    auto file = std::ofstream(profile);
    file << "grain,distance_over_radius,pressure,own_pressure\n";
    const Model& model = column.model();
    for (std::size_t n = 0; n < static_cast<std::size_t>(model.nodes()); ++n)
      if (surface.touching[n] != 0)
        file << fmt::format("{},{:.5f},{:.3f},{:.3f}\n",
                            n < static_cast<std::size_t>(model.node_offset[1]) ? "lower" : "upper",
                            std::hypot(model.position[4 * n] - 0.5, model.position[4 * n + 1] - 0.5) / radius,
                            surface.total[n], surface.own[n]);
    if (!file.flush()) throw std::runtime_error(profile + ": not written");
  }
}

void packing(const std::string& element, const std::string& file, double factor) {
  fmt::print("element,factor,relative_density,mean_stress,inner_nodes,mean_pressure,from_mean,from_plane,largest,"
             "own_from_mean,own_from_plane,penetration,kinetic_over_elastic,residual_over_work\n");
  Scenario scenario = holding_scenario(1, HardeningLaw::power);
  scenario.walls = true;
  scenario.numerics.element = element_of(element);
  scenario.numerics.own_pressure = usual_own_pressure(scenario.numerics.element);
  scenario.contact.stiffness_factor = factor;
  scenario.contact.surface = ContactSurface::facets;
  scenario.stages.clear();
  for (const double density : {0.7, 0.8, 0.9}) {
    Stage stage;
    stage.name = "compaction";
    stage.type = IsotropicCompaction{density, 4000, 0.1};
    stage.damping = {2e6, 0.25};
    scenario.stages.push_back(stage);
  }
  ThreadTeam team(1);
  Simulation simulation(build_model(read_packing(file), scenario, file), scenario, team);
  for (std::size_t s = 0; s < scenario.stages.size(); ++s) {
    if (s > 0) {
      simulation.begin_next_stage();
      simulation.advance();
    }
    for (;;) {
      simulation.evaluate_forces();
      if (simulation.stage_complete()) break;
      simulation.advance();
    }
    const HistoryRow row = simulation.observe();
    const SurfacePressure surface = surface_pressure(simulation.model(), simulation.contact());
    const PressureOscillation total = oscillation(simulation.model(), surface, surface.total),
                              own = oscillation(simulation.model(), surface, surface.own);
    fmt::print("{},{},{:.4f},{:.3f},{},{:.2f},{:.4f},{:.4f},{:.3f},{:.4f},{:.4f},{:.4f},{:.1e},{:.1e}\n", element,
               factor, row.relative_density, row.mean_stress, total.nodes, total.mean, total.from_mean,
               total.from_plane, total.largest, own.from_mean, own.from_plane, row.max_penetration,
               row.kinetic_energy / row.elastic_energy, row.energy_residual / row.external_work);
    std::fflush(stdout);
  }
}

int usage() {
  fmt::print(stderr,
             "contact-surface geometry | rotations ELEMENT SCALING R/h FIRST LAST | unequal ELEMENT R/h R/h FIRST "
             "LAST | pressure ELEMENT R/h FACTOR PROFILE.csv [smooth] | packing ELEMENT PACKING.h5 FACTOR\n");
  return 2;
}

} // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const auto number = [argv](int i) { return std::atof(argv[i]); };
  const auto whole = [argv](int i) { return std::strtoull(argv[i], nullptr, 10); };
  if (what == "geometry" && argc == 2)
    geometry();
  else if (what == "rotations" && argc == 7)
    rotations(argv[2], argv[3], number(4), whole(5), whole(6));
  else if (what == "unequal" && argc == 7)
    unequal(argv[2], number(3), number(4), whole(5), whole(6));
  else if (what == "pressure" && (argc == 6 || (argc == 7 && std::string(argv[6]) == "smooth")))
    pressure(argv[2], number(3), number(4), argv[5], argc == 7 ? ContactSurface::smooth : ContactSurface::facets);
  else if (what == "packing" && argc == 5)
    packing(argv[2], argv[3], number(4));
  else
    return usage();
  return 0;
}
