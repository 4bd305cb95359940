#include "solver/model/boundary_faces.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/index.hpp"

namespace mpfem {

namespace {

using Index = std::int32_t;
using Triangle = std::array<Index, 3>;

/// A side of a tetrahedron.
struct Face {
  std::array<Index, 3> sorted;
  std::array<Index, 3> outward;
  bool operator<(const Face& other) const { return sorted < other.sorted; }
};

/// All sides of the tets, sorted so that the two sides at an inner face follow each other.
std::vector<Face> sorted_faces(std::span<const Index> tet) {
  static constexpr int corner[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  std::vector<Face> faces;
  faces.reserve(tet.size());
  for (std::size_t t = 0; t < tet.size(); t += 4) {
    for (const auto& c : corner) {
      Face face;
      for (std::size_t i = 0; i < 3; ++i) face.outward[i] = tet[t + static_cast<std::size_t>(c[i])];
      face.sorted = face.outward;
      std::sort(face.sorted.begin(), face.sorted.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

/// True if every edge occurs once in each direction, or equally often in both if parts of the surface touch along it.
bool is_closed(const std::vector<Triangle>& boundary) {
  std::vector<std::pair<Index, Index>> forward, backward;
  for (const auto& face : boundary)
    for (std::size_t i = 0; i < 3; ++i) {
      forward.emplace_back(face[i], face[(i + 1) % 3]);
      backward.emplace_back(face[(i + 1) % 3], face[i]);
    }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return !boundary.empty() && forward == backward;
}

} // namespace

std::vector<Triangle> boundary_faces(std::span<const Index> tet, const std::string& grain_name) {
  const std::vector<Face> faces = sorted_faces(tet);
  std::vector<Triangle> boundary;
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i + 1;
    while (j < faces.size() && faces[j].sorted == faces[i].sorted) ++j;
    if (j == i + 1) boundary.push_back(faces[i].outward);
    if (j > i + 2)
      throw InputError(fmt::format("{}: {} tetrahedra share the face of nodes {}, {}, {}, allowed: at most two",
                                   grain_name, j - i, faces[i].sorted[0], faces[i].sorted[1], faces[i].sorted[2]));
    i = j;
  }
  if (!is_closed(boundary))
    throw InputError(
        fmt::format("{}: its surface is not closed, allowed: tetrahedra that meet face to face", grain_name));
  return boundary;
}

} // namespace mpfem
