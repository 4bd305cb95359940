// Meshes of grains: exact volume, closed surfaces, proven gaps.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "pack-gen/convex_distance.hpp"
#include "pack-gen/mesh_report.hpp"
#include "pack-gen/sphere_file.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;

namespace {

SpherePacking three_spheres() {
  return {.box = {0.5, 0.5, 0.5},
          .center = {{0.13, 0.13, 0.13}, {0.36, 0.13, 0.14}, {0.2, 0.33, 0.3}},
          .radius = {0.12, 0.105, 0.08}};
}

std::vector<mpfem::Point> nodes_of(const PackingMesh& mesh, std::size_t grain) {
  std::vector<mpfem::Point> nodes;
  for (auto n = static_cast<std::size_t>(mesh.grain_node_offset[grain]);
       n < static_cast<std::size_t>(mesh.grain_node_offset[grain + 1]); ++n)
    nodes.push_back({mesh.node[3 * n], mesh.node[3 * n + 1], mesh.node[3 * n + 2]});
  return nodes;
}

std::vector<Tet> tets_of(const PackingMesh& mesh, std::size_t grain) {
  std::vector<Tet> tets;
  for (auto t = static_cast<std::size_t>(mesh.grain_tet_offset[grain]);
       t < static_cast<std::size_t>(mesh.grain_tet_offset[grain + 1]); ++t) {
    Tet tet{};
    for (std::size_t c = 0; c < 4; ++c) tet[c] = mesh.tet[4 * t + c] - mesh.grain_node_offset[grain];
    tets.push_back(tet);
  }
  return tets;
}

} // namespace

TEST_CASE("every grain's mesh has its sphere's volume, positive tets and a closed surface") {
  const SpherePacking packing = three_spheres();
  const PackingMesh mesh = mesh_packing(packing, {.nominal_size = 0.03, .seed = 4, .threads = 2});
  REQUIRE(mesh.grain_tet_offset.size() == 4);
  for (std::size_t g = 0; g < 3; ++g) {
    const TetMesh grain{nodes_of(mesh, g), tets_of(mesh, g)};
    const double r = packing.radius[g], exact = 4.0 / 3.0 * M_PI * r * r * r;
    CHECK(mesh_volume(grain) == Approx(exact).epsilon(1e-12));
    for (const Tet& t : grain.tet) {
      const auto at = [&](std::size_t c) { return grain.node[static_cast<std::size_t>(t[c])]; };
      CHECK(tet_volume(at(0), at(1), at(2), at(3)) > 0);
    }
    CHECK(is_closed_sphere(boundary_facets(grain.tet)));
    CHECK(ball_defect(grain).empty());
    // As many tets as the nominal size says: 11.05 in a cube of its edge, a coarse ball's grain of counting aside.
    CHECK(static_cast<double>(grain.tet.size()) ==
          Approx(exact * tets_per_cubed_size / std::pow(0.03, 3)).epsilon(0.12));
  }
}

TEST_CASE("the proven facet gap is below every distance of sampled surface points, and not far below") {
  const SpherePacking packing = three_spheres();
  const PackingMesh mesh = mesh_packing(packing, {.nominal_size = 0.03, .seed = 4});
  const double proven = smallest_facet_gap(packing, mesh).gap;
  CHECK(proven > 0);
  // Points on all facets: corners, and a grid inside.
  std::vector<std::vector<mpfem::Point>> surface(3);
  double sampled = std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < 3; ++g) {
    const auto nodes = nodes_of(mesh, g);
    for (const Facet& f : boundary_facets(tets_of(mesh, g)))
      for (int a = 0; a <= 4; ++a)
        for (int b = 0; a + b <= 4; ++b) {
          mpfem::Point p{};
          for (std::size_t k = 0; k < 3; ++k)
            p[k] = (a * nodes[static_cast<std::size_t>(f[0])][k] + b * nodes[static_cast<std::size_t>(f[1])][k] +
                    (4 - a - b) * nodes[static_cast<std::size_t>(f[2])][k]) /
                   4;
          surface[g].push_back(p);
          for (std::size_t k = 0; k < 3; ++k) sampled = std::min({sampled, p[k], packing.box[k] - p[k]});
        }
  }
  for (std::size_t g = 0; g < 3; ++g)
    for (std::size_t h = 0; h < g; ++h)
      for (const mpfem::Point& p : surface[g])
        for (const mpfem::Point& q : surface[h])
          sampled = std::min(sampled, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
  CHECK(proven <= sampled + 1e-12);
  CHECK(proven > sampled - 0.002); // the grid's own error: (edge/4)^2 over the sphere's radius and the like
}

TEST_CASE("the proven facet gap is that of the nearest grains, though all are farther apart than their size") {
  const SpherePacking packing{.box = {20, 20, 20}, .center = {{3.9, 10, 10}, {8.1, 10, 10}}, .radius = {0.5, 0.5}};
  const SphereGap gap = smallest_facet_gap(packing, mesh_packing(packing, {.nominal_size = 0.3}));
  CHECK(gap.first == 0);
  CHECK(gap.second == 1);
  CHECK(gap.gap < 3.2); // between the spheres; 3.4 to the nearest wall. Nodes lie outside the spheres, which
  CHECK(gap.gap > 3.0); // the volume of so coarse a mesh needs by a few per cent of the radius
}

TEST_CASE("the distance of convex hulls is proven from below and reached from above") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    Eigen::Matrix3Xd a(3, 30), b(3, 20);
    for (int c = 0; c < 30; ++c)
      a.col(c) = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    for (int c = 0; c < 20; ++c)
      b.col(c) =
          Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized() + Eigen::Vector3d(2.5, 0.3, 0);
    const ConvexDistance d = convex_distance(a, b, Eigen::Vector3d(1, 0, 0));
    CHECK(d.lower > 0);
    CHECK(d.upper == Approx(d.lower).epsilon(1e-6));
    // The plane is a proof: no point of a goes further along its normal than the nearest of b, less the distance.
    CHECK((d.direction.transpose() * b).minCoeff() - (d.direction.transpose() * a).maxCoeff() >= d.lower - 1e-12);
  }
}

TEST_CASE("the mesh does not depend on the number of threads, and the same seed gives the same mesh") {
  const SpherePacking packing = three_spheres();
  const PackingMesh one = mesh_packing(packing, {.nominal_size = 0.035, .seed = 2, .threads = 1});
  const PackingMesh two = mesh_packing(packing, {.nominal_size = 0.035, .seed = 2, .threads = 2});
  CHECK((one.node == two.node)); // in brackets: a failure need not print them
  CHECK((one.tet == two.tet));
  const PackingMesh other = mesh_packing(packing, {.nominal_size = 0.035, .seed = 3, .threads = 1});
  CHECK((one.node != other.node));
}

TEST_CASE("quality and critical step of the regular tetrahedron are known") {
  const mpfem::Point a{1, 1, 1}, b{-1, 1, -1}, c{1, -1, -1}, d{-1, -1, 1};
  const double quality = tet_quality(a, b, c, d);
  CHECK(quality == Approx(1).epsilon(1e-12));
  CHECK(tet_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-9}) < 1e-6);
  // The step grows with the size and falls with the wave speed.
  const StepMaterial material;
  const mpfem::Point a2{2, 2, 2}, b2{-2, 2, -2}, c2{2, -2, -2}, d2{-2, -2, 2};
  CHECK(critical_step(a2, b2, c2, d2, material) == Approx(2 * critical_step(a, b, c, d, material)).epsilon(1e-9));
}

TEST_CASE("choosing balls and moving their nodes raises the critical step, at the same number of tets") {
  for (const double size_ratio : {2.5, 4.0}) {
    const UnitBall plain = mesh_unit_ball(size_ratio, 3, false), optimised = mesh_unit_ball(size_ratio, 3);
    CAPTURE(size_ratio, plain.smallest_step, optimised.smallest_step);
    CHECK(optimised.smallest_step > 1.3 * plain.smallest_step);
    const auto tets = [](const UnitBall& unit) { return static_cast<double>(unit.ball.mesh.tet.size()); };
    CHECK(tets(optimised) == Approx(tets(plain)).epsilon(size_ratio < 3 ? 0.3 : 0.06)); // both within their tolerance
  }
}

TEST_CASE("a size too large for the smallest sphere is refused and says what is allowed") {
  CHECK_THROWS_WITH(mesh_packing(three_spheres(), {.nominal_size = 0.2}),
                    Catch::Contains("0.12") && Catch::Contains("allowed"));
  CHECK_THROWS_AS(mesh_packing(three_spheres(), {.nominal_size = 1e-6}), InputError);
}

namespace {

/// A sphere and its twelve neighbours of a face-centred cubic packing, `gap` apart.
SpherePacking cluster(double radius, double gap) {
  SpherePacking packing{.box = {8 * radius, 8 * radius, 8 * radius},
                        .center = {{4 * radius, 4 * radius, 4 * radius}},
                        .radius = {radius}};
  const double step = (2 * radius + gap) / std::sqrt(2.0);
  for (const double a : {-step, step})
    for (const double b : {-step, step})
      for (const mpfem::Point& offset : {mpfem::Point{a, b, 0}, mpfem::Point{a, 0, b}, mpfem::Point{0, a, b}}) {
        packing.center.push_back({4 * radius + offset[0], 4 * radius + offset[1], 4 * radius + offset[2]});
        packing.radius.push_back(radius);
      }
  return packing;
}

} // namespace

TEST_CASE("grains that extend beyond their spheres are rotated until none touch, with the same result on any number of "
          "threads") {
  // At radius/size 3 nodes lie 1.2 % of the radius outside: two of them need more than the gap of 1 %.
  const SpherePacking packing = cluster(0.06, 0.0006);
  const PackingMesh one = mesh_packing(packing, {.nominal_size = 0.02, .seed = 1, .threads = 1});
  REQUIRE(one.notes.size() == 1);
  CHECK_THAT(one.notes[0], Catch::Contains("rotated"));
  CHECK(smallest_facet_gap(packing, one).gap > 0);
  for (std::size_t g = 0; g < packing.radius.size(); ++g) {
    const TetMesh grain{nodes_of(one, g), tets_of(one, g)};
    CHECK(mesh_volume(grain) == Approx(4.0 / 3.0 * M_PI * std::pow(0.06, 3)).epsilon(1e-12));
  }
  CHECK((one.node == mesh_packing(packing, {.nominal_size = 0.02, .seed = 1, .threads = 3}).node));
}

TEST_CASE("pack-gen prints the notes of a mesh, and with --quiet nothing") {
  const test::Folder folder;
  const SpherePacking packing = cluster(0.06, 0.0006);
  export_spheres(folder / "s.csv", packing);
  const std::string import = fmt::format("'{}' import {} --box {} --size 0.02 -o {}", MPFEM_PACK_GEN, folder / "s.csv",
                                         fmt::join(packing.box, ","), folder / "m.h5");
  const test::Outcome loud = test::run_command(import), quiet = test::run_command(import + " --quiet");
  CHECK(loud.exit_code == 0);
  CHECK_THAT(loud.messages, Catch::Contains("pack-gen: note: ") && Catch::Contains("rotated"));
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.messages.empty());
  CHECK(quiet.output.empty());
}

TEST_CASE("spheres too near for so coarse a mesh are refused, with the grains named") {
  // At radius/size 1.2 nodes lie 6 % of the radius outside: no orientation clears twelve neighbours all but touching.
  CHECK_THROWS_WITH(mesh_packing(cluster(0.06, 1e-9), {.nominal_size = 0.05}),
                    Catch::Contains("grain") && Catch::Contains("allowed: a smaller size or a larger smallest_gap"));
}

TEST_CASE("a mesh that the memory surely cannot hold is refused before it is made") {
  SpherePacking packing = three_spheres();
  const MeshRequest fitting{.nominal_size = 0.05, .memory = 1e6}, coarse{.nominal_size = 0.05, .memory = 1000};
  CHECK_NOTHROW(mesh_packing(packing, fitting));
  CHECK_THROWS_WITH(mesh_packing(packing, coarse),
                    Catch::Contains("which need at least") && Catch::Contains("GiB of memory that are free here"));
}
