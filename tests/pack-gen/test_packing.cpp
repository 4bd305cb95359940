// Packings: gaps, densities, reproducibility.

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "pack-gen/overlap_minimiser.hpp"
#include "pack-gen/packing.hpp"
#include "pack-gen/settle.hpp"
#include "pack-gen/size_distribution.hpp"
#include "pack-gen/sphere_order.hpp"
#include "tests/support/tolerances.hpp"
#include "tests/support/triangle_meshes.hpp"

using namespace mpfem;

namespace {

/// Smallest gap by looking at every pair and wall; of a cylinder the box's lateral walls are no nearer than its own.
double brute_force_gap(const SpherePacking& p) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < p.radius.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      smallest = std::min({smallest, p.center[i][k] - p.radius[i], p.box[k] - p.center[i][k] - p.radius[i]});
    if (p.shape == ContainerShape::cylinder)
      smallest = std::min(smallest, 0.5 * p.box[0] - p.radius[i] -
                                        std::hypot(p.center[i][0] - 0.5 * p.box[0], p.center[i][1] - 0.5 * p.box[1]));
    for (std::size_t j = 0; j < i; ++j) {
      const double d =
          std::hypot(p.center[i][0] - p.center[j][0], p.center[i][1] - p.center[j][1], p.center[i][2] - p.center[j][2]);
      smallest = std::min(smallest, d - p.radius[i] - p.radius[j]);
    }
  }
  return smallest;
}

PackingRequest request(int count, double density, std::uint64_t seed) {
  const auto table = table_distribution({0.1, 0.14, 0.21}, {0, 0.6, 1}, SizeWeight::number);
  std::vector<double> radius = table->sample(count);
  for (double& r : radius) r *= 0.5;
  double volume = 0;
  for (const double r : radius) volume += 4.0 / 3.0 * M_PI * r * r * r;
  const double edge = std::cbrt(volume / density);
  return {.box = {edge, edge, edge}, .radius = radius, .smallest_gap = 0.002, .seed = seed};
}

/// The same spheres at the same density in a cylinder as high as `aspect` diameters.
PackingRequest cylinder_request(int count, double density, double aspect, std::uint64_t seed) {
  PackingRequest wanted = request(count, density, seed);
  const double volume = wanted.box[0] * wanted.box[1] * wanted.box[2];
  const double diameter = std::cbrt(volume / (0.25 * M_PI * aspect));
  wanted.box = {diameter, diameter, aspect * diameter};
  wanted.shape = ContainerShape::cylinder;
  return wanted;
}

} // namespace

TEST_CASE("a packing denser than random sequential addition keeps every gap and the exact density") {
  // Random sequential addition of spheres ends near 0.38 (0.36 … 0.40 with sizes mixed).
  for (const auto& [count, density] : {std::pair{300, 0.56}, {60, 0.48}}) {
    const PackingRequest wanted = request(count, density, 3);
    const SpherePacking packing = pack_spheres(wanted);
    CHECK(packing.radius == wanted.radius);
    CHECK(relative_density(packing) == Approx(density).epsilon(1e-12));
    const double gap = brute_force_gap(packing);
    CHECK(gap >= wanted.smallest_gap * (1 - 1e-12));
    CHECK(smallest_gap(packing).gap == Approx(gap).epsilon(1e-12));
  }
}

TEST_CASE("a cylinder is filled as densely as a box: every gap kept, no sphere beyond the round wall") {
  for (const auto& [count, density, aspect] : {std::tuple{300, 0.56, 1.2}, {300, 0.53, 0.5}, {60, 0.45, 3.0}}) {
    const PackingRequest wanted = cylinder_request(count, density, aspect, 3);
    const SpherePacking packing = pack_spheres(wanted);
    CHECK(packing.shape == ContainerShape::cylinder);
    CHECK(packing.radius == wanted.radius);
    CHECK(relative_density(packing) == Approx(density).epsilon(1e-12)); // over pi/4 D^2 H
    const double gap = brute_force_gap(packing);
    CHECK(gap >= wanted.smallest_gap * (1 - 1e-12));
    CHECK(smallest_gap(packing).gap == Approx(gap).epsilon(1e-12));
  }
}

TEST_CASE("spheres in a cylinder reach its walls all around: the packing is about its axis") {
  const SpherePacking packing = pack_spheres(cylinder_request(300, 0.55, 1, 5));
  int beside_the_wall[4] = {};
  for (std::size_t i = 0; i < packing.radius.size(); ++i) {
    const double x = packing.center[i][0] - 0.5 * packing.box[0], y = packing.center[i][1] - 0.5 * packing.box[1];
    if (0.5 * packing.box[0] - std::hypot(x, y) - packing.radius[i] < 0.01)
      ++beside_the_wall[(x > 0 ? 1 : 0) + (y > 0 ? 2 : 0)];
  }
  for (const int spheres : beside_the_wall) CHECK(spheres > 10);
}

TEST_CASE("the message about a sphere beyond a cylinder's wall names the round wall") {
  const SpherePacking packing{{1, 1, 2}, {{0.5, 0.5, 1}, {0.8, 0.8, 1}}, {0.1, 0.1}, ContainerShape::cylinder};
  const SphereGap gap = smallest_wall_gap(packing);
  CHECK(test::within(gap.gap, 0.5 - 0.1 - 0.3 * std::sqrt(2.0), test::rounding));
  CHECK(gap.first == 1);
  CHECK(wall_name(-1 - gap.second) == "round wall");
}

TEST_CASE("spheres are numbered along a curve: the next one is near, and none is lost") {
  const SpherePacking packed = pack_spheres(request(300, 0.5, 3)), numbered = along_a_curve(packed);
  const auto sorted = [](const SpherePacking& packing) {
    std::vector<std::pair<Point, double>> spheres;
    for (std::size_t i = 0; i < packing.radius.size(); ++i) spheres.emplace_back(packing.center[i], packing.radius[i]);
    std::sort(spheres.begin(), spheres.end());
    return spheres;
  };
  CHECK(sorted(numbered) == sorted(packed));

  // Two random points of a cube are 0.66 edges apart on average. Two of these spheres that touch are 0.15 apart; jumps
  // of the curve make its mean step longer than that, but not twice as long.
  const auto mean_step = [](const SpherePacking& packing) {
    double sum = 0;
    for (std::size_t i = 1; i < packing.center.size(); ++i)
      sum += point_distance(packing.center[i - 1], packing.center[i]) / packing.box[0];
    return sum / static_cast<double>(packing.center.size() - 1);
  };
  CHECK(mean_step(packed) > 0.6);
  CHECK(mean_step(numbered) < 0.3);
}

TEST_CASE("the same seed gives the same packing, another seed another one") {
  for (const bool cylinder : {false, true}) {
    const auto packed = [&](std::uint64_t seed) {
      return pack_spheres(cylinder ? cylinder_request(80, 0.45, 1, seed) : request(80, 0.45, seed));
    };
    const SpherePacking a = packed(7), b = packed(7), c = packed(8);
    CHECK(a.center == b.center);
    CHECK(a.center != c.center);
  }
}

TEST_CASE("a density beyond jamming is refused with the density that was reached") {
  for (PackingRequest wanted : {request(40, 0.66, 1), cylinder_request(40, 0.66, 1, 1)}) {
    wanted.moves = 200'000; // enough to see that it does not go on
    CHECK_THROWS_WITH(pack_spheres(wanted), Catch::Contains("0.66") && Catch::Contains("reached"));
    CHECK_THROWS_AS(pack_spheres(wanted), InputError);
  }
}

TEST_CASE("a sphere larger than the box or cylinder is refused") {
  CHECK_THROWS_AS(pack_spheres({.box = {1, 1, 0.1}, .radius = {0.06}, .smallest_gap = 0.001}), InputError);
  CHECK_THROWS_WITH(
      pack_spheres({.box = {0.1, 0.1, 1}, .shape = ContainerShape::cylinder, .radius = {0.06}, .smallest_gap = 0.001}),
      Catch::Contains("cylinder's diameter of 0.1 mm"));
}

namespace {

/// How many spheres and walls a sphere touches, within `reach` (mm), and whether one of them, or the bottom, is below.
struct Support {
  int contacts = 0;
  bool from_below = false, on_bottom = false;
};

Support support_of(const SpherePacking& p, std::size_t i, double reach) {
  Support support;
  p.container().for_each_wall(p.center[i], [&](double distance, int wall) {
    if (distance - p.radius[i] > reach) return;
    ++support.contacts;
    if (wall == 4) support.from_below = support.on_bottom = true;
  });
  for (std::size_t j = 0; j < p.radius.size(); ++j) {
    const double d =
        std::hypot(p.center[i][0] - p.center[j][0], p.center[i][1] - p.center[j][1], p.center[i][2] - p.center[j][2]);
    if (j == i || d - p.radius[i] - p.radius[j] > reach) continue;
    ++support.contacts;
    if (p.center[j][2] < p.center[i][2]) support.from_below = true;
  }
  return support;
}

} // namespace

TEST_CASE("settled spheres rest on each other and the bottom, keep their gaps and lie lower than before") {
  for (const PackingRequest& wanted : {request(150, 0.3, 4), cylinder_request(150, 0.3, 1.5, 4)}) {
    const SpherePacking loose = pack_spheres(wanted);
    std::string state;
    const SettledPacking settled =
        settle(loose, {.smallest_gap = 0.002, .progress = [&](const std::string& now) { state = now; }});
    CHECK_THAT(state, Catch::Contains("weights unbalanced (wanted: 0.0001), overlap") &&
                          Catch::EndsWith("mean radii (wanted: 0.00018)"));
    CHECK(settled.packing.shape == wanted.shape);
    CHECK(settled.packing.box == loose.box);
    CHECK(settled.packing.radius == loose.radius);
    CHECK(brute_force_gap(settled.packing) >= 0.002 * (1 - 1e-9));
    CHECK(settled.unbalanced <= 1e-4);
    double before = 0, after = 0;
    for (std::size_t i = 0; i < loose.radius.size(); ++i) {
      const double volume = std::pow(loose.radius[i], 3);
      before += volume * loose.center[i][2];
      after += volume * settled.packing.center[i][2];
      // Without friction three contacts hold a sphere, or the bottom alone; margins are 4e-4 of 0.07 mm.
      const Support support = support_of(settled.packing, i, 0.002 + 5e-5);
      CHECK((support.contacts >= 3 || support.on_bottom));
      CHECK(support.from_below);
    }
    CHECK(after < 0.75 * before);
    SpherePacking bed = settled.packing;
    bed.box[2] = settled.bed_height;
    CHECK(relative_density(bed) > 0.4); // the top of so few spheres is uneven
    CHECK(settle(loose, {.smallest_gap = 0.002}).packing.center == settled.packing.center);
    const SettledPacking fitted = settle(loose, {.smallest_gap = 0.002, .fit_height = true});
    CHECK(fitted.packing.center == settled.packing.center);
    CHECK(fitted.packing.box[2] == Approx(settled.bed_height + 0.002).epsilon(1e-12));
    CHECK(brute_force_gap(fitted.packing) >= 0.002 * (1 - 1e-9));
  }
}

TEST_CASE("a bed that is higher than its container is not held down, but raises the container or is refused") {
  // Between walls that leave no room beside it, a sphere rests on another at the height of both.
  const SpherePacking low{{0.22, 0.22, 0.4}, {{0.11, 0.11, 0.12}, {0.11, 0.11, 0.28}}, {0.1, 0.1}};
  const SettledPacking raised = settle(low, {.smallest_gap = 0.005, .fit_height = true});
  CHECK(raised.bed_height == Approx(0.41).margin(2e-4));                            // overlaps of 2e-4 radii and less
  CHECK(raised.packing.box[2] == Approx(raised.bed_height + 0.005).epsilon(1e-12)); // rounding
  CHECK_THROWS_WITH(settle(low, {.smallest_gap = 0.005}),
                    Catch::Contains("a container that is 0.4 mm high") && Catch::Contains("at least 0.415"));
  // Dense packings have the highest beds.
  const SpherePacking dense = pack_spheres(request(150, 0.5, 1));
  const SettledPacking bed = settle(dense, {.smallest_gap = 0.002, .fit_height = true});
  CHECK(bed.unbalanced <= 1e-4);
  CHECK(brute_force_gap(bed.packing) >= 0.002 * (1 - 1e-9));
}

TEST_CASE("one sphere falls to the bottom, a second one onto it") {
  const SpherePacking above{{0.22, 0.22, 2}, {{0.11, 0.11, 0.9}, {0.11, 0.11, 1.5}}, {0.1, 0.1}};
  const SettledPacking settled = settle(above, {.smallest_gap = 0.005});
  CHECK(settled.packing.center[0][2] == Approx(0.105).margin(1e-4));
  CHECK(settled.packing.center[1][2] == Approx(0.31).margin(1e-4)); // the die is too narrow for it to roll off
  CHECK(settled.bed_height == Approx(0.41).margin(2e-4));
}

namespace {

/// Spheres in the inside of a surface, which moves to the origin.
SpherePacking in_surface(const test::LooseTriangles& triangles, std::vector<mpfem::Point> centers,
                         std::vector<double> radii) {
  const PlacedSurface placed = place_surface(test::welded(triangles));
  return {placed.lengths, std::move(centers), std::move(radii), ContainerShape::surface, placed.container};
}

/// A cube of 1 mm on one of its corners: its three lower faces meet at the lowest point, at right angles.
test::LooseTriangles cube_on_a_corner() {
  test::LooseTriangles cube = test::unit_cube();
  const double a = std::sqrt(1.0 / 2), b = std::sqrt(1.0 / 6), c = std::sqrt(1.0 / 3);
  for (auto& triangle : cube)
    for (auto& x : triangle) x = {a * (x.x - x.y), b * (x.x + x.y - 2 * x.z), c * (x.x + x.y + x.z)};
  return cube;
}

} // namespace

TEST_CASE("a sphere in a hopper rests on three faces at once, sqrt(3) radii above its tip") {
  // The tip is below the middle of the cube: the box around the cube is sqrt(2) by sqrt(8/3) mm wide.
  const SpherePacking above = in_surface(cube_on_a_corner(), {{0.75, 0.85, 0.9}}, {0.1});
  const double gap = 0.002;
  const SettledPacking settled = settle(above, {.smallest_gap = gap});
  CHECK(settled.unbalanced <= 1e-4);
  CHECK(smallest_gap(settled.packing).gap >= gap * (1 - 1e-9));
  // Held within the margin of 2e-4 radii on each face, which the slope of the faces enlarges by sqrt(3).
  const mpfem::Point& center = settled.packing.center[0];
  const double margin = 2e-4 * 0.1 * std::sqrt(3.0);
  CHECK(center[0] == Approx(std::sqrt(0.5)).margin(margin));
  CHECK(center[1] == Approx(std::sqrt(2.0 / 3)).margin(margin));
  CHECK(center[2] == Approx(std::sqrt(3.0) * (0.1 + gap)).margin(margin));
}

TEST_CASE("a bed in a surface is as dense as in the box or cylinder of the same shape") {
  // Beds of 150 spheres that start elsewhere differ by about 2 % in the height of their centre.
  const auto centre_height = [](const SpherePacking& p) {
    double sum = 0, volume = 0;
    for (std::size_t i = 0; i < p.radius.size(); ++i)
      sum += std::pow(p.radius[i], 3) * p.center[i][2], volume += std::pow(p.radius[i], 3);
    return sum / volume;
  };
  for (const PackingRequest& wanted : {request(150, 0.3, 4), cylinder_request(150, 0.3, 1.5, 4)}) {
    const SpherePacking loose = pack_spheres(wanted);
    const bool round = wanted.shape == ContainerShape::cylinder;
    // The polygon of 96 corners goes round the cylinder: 5e-4 wider in radius, and its sides are a sphere's size.
    const double radius = round ? 0.5 * wanted.box[0] / std::cos(M_PI / 96) : std::sqrt(0.5) * wanted.box[0];
    auto polygon = test::regular_polygon(round ? 96 : 4, radius);
    if (!round) polygon = {{0, 0}, {wanted.box[0], 0}, {wanted.box[0], wanted.box[1]}, {0, wanted.box[1]}};
    const SpherePacking placed = in_surface(test::prism(polygon, 0, wanted.box[2]), loose.center, loose.radius);
    const SettledPacking flat = settle(loose, {.smallest_gap = 0.002}),
                         triangles = settle(placed, {.smallest_gap = 0.002});
    CHECK(triangles.unbalanced <= 1e-4);
    CHECK(smallest_gap(triangles.packing).gap >= 0.002 * (1 - 1e-9));
    CHECK(centre_height(triangles.packing) == Approx(centre_height(flat.packing)).epsilon(0.03));
  }
}

TEST_CASE("spheres that have no room for the gap do not settle, and the message says so") {
  const SpherePacking full{{0.2, 0.2, 0.4}, {{0.1, 0.1, 0.1}, {0.1, 0.1, 0.3}}, {0.1, 0.1}};
  CHECK_THROWS_AS(settle(full, {.smallest_gap = 0.01}), InputError);
  CHECK_THROWS_WITH(settle(full, {.smallest_gap = 0.01}), Catch::Contains("do not come to rest with gaps of 0.01 mm"));
}
