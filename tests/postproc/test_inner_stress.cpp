// Mean stress of an inner region, on lattices under a known stress.

#include <catch2/catch.hpp>

#include "bonded_run.hpp"
#include "postproc/metrics/inner_stress.hpp"
#include "postproc/metrics/love_weber.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// A cubic lattice of n^3 grains with a spacing of 1 mm in the box [0, n]^3, under a stress (MPa, compression
/// positive): each contact passes on the traction of the face between two cells; walls stand half a spacing from the
/// outer grains.
std::vector<ForceLine> stressed_lattice(int n, const Eigen::Matrix3d& stress, bool with_walls) {
  std::vector<ForceLine> lines;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          const Eigen::Vector3d at(x + 0.5, y + 0.5, z + 0.5), along = Eigen::Vector3d::Unit(axis);
          const bool last = at[axis] > n - 1, first = at[axis] < 1;
          if (!last) lines.push_back({at, at + along, -stress * along});
          if (with_walls && last) lines.push_back({at, at + 0.5 * along, -stress * along});
          if (with_walls && first) lines.push_back({at, at - 0.5 * along, stress * along});
        }
  return lines;
}

} // namespace

TEST_CASE("the part of a line inside a box is what its planes leave of it") {
  const Region region{{0, 0, 0}, {1, 1, 1}};
  CHECK(share_inside(region, {0.2, 0.5, 0.5}, {0.8, 0.5, 0.5}) == 1);
  CHECK(share_inside(region, {-1, 0.5, 0.5}, {1, 0.5, 0.5}) == 0.5);
  CHECK(share_inside(region, {1, 0.5, 0.5}, {-1, 0.5, 0.5}) == 0.5); // whichever way it goes
  CHECK(share_inside(region, {-1, 0.5, 0.5}, {3, 0.5, 0.5}) == 0.25);
  CHECK(share_inside(region, {-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}) == 0.5);
  CHECK(share_inside(region, {-0.5, 0.75, 0.5}, {0.25, -0.5, 0.5}) < 0.5);
  CHECK(share_inside(region, {-1, 0.5, 0.5}, {0.5, 2.5, 0.5}) == 0); // past a corner
  CHECK(share_inside(region, {0.5, 2, 0.5}, {0.5, 3, 0.5}) == 0);
  CHECK(share_inside(region, {-1, 2, 0.5}, {2, 2, 0.5}) == 0); // along a face, outside
}

TEST_CASE("Love and Weber's stress of a lattice is the applied stress, with shear") {
  Eigen::Matrix3d stress;
  stress << 7, 1, -2, 1, 11, 3, -2, 3, 30;
  const Region box{{0, 0, 0}, {6, 6, 6}};
  // The inner half of each length cuts grains' lines in their middle.
  const Eigen::Matrix3d inner = love_weber_stress(inner_region(box, 0.5), stressed_lattice(6, stress, false));
  CHECK((inner - stress).cwiseAbs().maxCoeff() < rounding * 30);
  const Eigen::Matrix3d whole = love_weber_stress(box, stressed_lattice(6, stress, true));
  CHECK((whole - stress).cwiseAbs().maxCoeff() < rounding * 30);
  // Without what the walls push the outer half layer is missing: five contacts of six spacings.
  const Eigen::Matrix3d without = love_weber_stress(box, stressed_lattice(6, stress, false));
  CHECK((without - 5.0 / 6 * stress).cwiseAbs().maxCoeff() < rounding * 30);
}

TEST_CASE("the mean stress by the solid counts pores as free of stress") {
  const Region region{{0, 0, 0}, {2, 1, 1}};
  const std::vector<PressedVolume> solid = {
      {{0.5, 0.5, 0.5}, 0.5, 10}, {{1.5, 0.5, 0.5}, 0.25, -4}, {{2.5, 0.5, 0.5}, 1, 1000}};
  CHECK(solid_mean_stress(region, solid) == (5.0 - 1.0) / 2);
}

TEST_CASE("the inner stress of a snapshot is of its grains' forces, centres and walls") {
  const Folder folder;
  RunContents contents = bonded_run(); // forces of 10 N along x over 2 mm, of 1 N along z over 2 mm, in 5 x 3 x 5 mm
  contents.numbers["/snapshots/*/mean_stress"] = {0.5};
  contents.numbers["/snapshots/*/pressure"] = std::vector<double>(contents.extents.at("tets"), 3.0);
  write_run(folder / "run.h5", contents);
  const schema::FileReader file(folder / "run.h5");
  const Measurement m = measure_inner_stress(file, -1, 1);
  constexpr double single = 1e-6; // places are stored in single precision
  CHECK(m.value == Approx((20.0 + 2) / 75 / 3).epsilon(single));
  CHECK(m.details["stress_xx_MPa"].get<double>() == Approx(20.0 / 75).epsilon(single));
  CHECK(m.details["deviatoric_stress_MPa"].get<double>() == Approx(2.0 / 75 - 10.0 / 75).epsilon(single));
  CHECK(m.details["mean_stress_of_solid_MPa"].get<double>() == Approx(3.0 * 24 / 75).epsilon(single)); // three cubes
  CHECK(m.details["mean_stress_of_walls_MPa"] == 0.5);
  CHECK(m.details["grains_centred_inside"] == 3);
  CHECK(m.notes.size() == 1);
  // The wall at x = -1.5 pushes the first grain, 1.5 mm from it, with 4 N.
  contents.numbers["/snapshots/*/wall_force"] = {4, 0, 0, 0, 0, 0, /**/ 0, 0, 0, 0, 0, 0, /**/ 0, 0, 0, 0, 0, 0};
  write_run(folder / "walls.h5", contents);
  const Measurement with_walls = measure_inner_stress(schema::FileReader(folder / "walls.h5"), -1, 1);
  CHECK(with_walls.details["stress_xx_MPa"].get<double>() == Approx((20.0 + 6) / 75).epsilon(single));
  CHECK_THROWS_WITH(measure_inner_stress(file, -1, 0.01), Catch::Contains("no grain has its centre"));
}
