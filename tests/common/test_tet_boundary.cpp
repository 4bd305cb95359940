#include <algorithm>
#include <array>
#include <vector>

#include <catch2/catch.hpp>

#include "common/tet_boundary.hpp"

using namespace mpfem;

namespace {

using Faces = std::vector<std::array<std::int32_t, 3>>;

Faces boundary_of(const std::vector<std::int32_t>& tets) {
  return tet_boundary(tets).face;
}

} // namespace

TEST_CASE("The boundary of a tet is its four faces, outward, in the order of their nodes") {
  CHECK(boundary_of({0, 1, 2, 3}) == Faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  CHECK(boundary_of({}).empty());
}

TEST_CASE("A face that two tets share is not on the boundary") {
  const Faces faces = boundary_of({0, 1, 2, 3, 1, 2, 3, 4});
  CHECK(faces.size() == 6);
  CHECK(std::find(faces.begin(), faces.end(), std::array<std::int32_t, 3>{1, 2, 3}) == faces.end());
  CHECK_FALSE(tet_boundary(std::vector{0, 1, 2, 3, 1, 2, 3, 4}).crowded);
}

TEST_CASE("The first face that more than two tets share is named with their number") {
  const TetBoundary boundary = tet_boundary(std::vector{7, 1, 2, 3, 8, 1, 2, 3, 3, 2, 1, 9});
  REQUIRE(boundary.crowded);
  CHECK(boundary.crowded->node == std::array{1, 2, 3});
  CHECK(boundary.crowded->tets == 3);
  CHECK(boundary.face.size() == 9);
}
