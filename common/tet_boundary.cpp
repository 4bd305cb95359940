#include "common/tet_boundary.hpp"

#include <algorithm>

namespace mpfem {

namespace {

struct Face {
  std::array<std::int32_t, 3> ascending, outward;
};

/// All faces of the tets, sorted so that those of the same nodes follow each other.
std::vector<Face> sorted_faces(std::span<const std::int32_t> tet) {
  // Opposite to each corner; outward where the tet's volume is positive.
  static constexpr std::size_t corner[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  std::vector<Face> faces;
  faces.reserve(tet.size());
  for (std::size_t t = 0; t < tet.size(); t += 4)
    for (const auto& c : corner) {
      Face face{};
      for (std::size_t k = 0; k < 3; ++k) face.outward[k] = tet[t + c[k]];
      face.ascending = face.outward;
      std::sort(face.ascending.begin(), face.ascending.end());
      faces.push_back(face);
    }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.ascending < b.ascending; });
  return faces;
}

} // namespace

TetBoundary tet_boundary(std::span<const std::int32_t> tet) {
  const std::vector<Face> faces = sorted_faces(tet);
  TetBoundary boundary;
  for (std::size_t i = 0, end = 0; i < faces.size(); i = end) {
    for (end = i + 1; end < faces.size() && faces[end].ascending == faces[i].ascending;) ++end;
    if (end == i + 1) boundary.face.push_back(faces[i].outward);
    if (end > i + 2 && !boundary.crowded) boundary.crowded = {faces[i].ascending, end - i};
  }
  return boundary;
}

} // namespace mpfem
