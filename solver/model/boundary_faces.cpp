#include "solver/model/boundary_faces.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/tet_boundary.hpp"

namespace mpfem {

namespace {

using Index = std::int32_t;
using Triangle = std::array<Index, 3>;

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
  const auto [boundary, crowded] = tet_boundary(tet);
  if (crowded)
    throw InputError(fmt::format("{}: {} tetrahedra share the face of nodes {}, {}, {}, allowed: at most two",
                                 grain_name, crowded->tets, crowded->node[0], crowded->node[1], crowded->node[2]));
  if (!is_closed(boundary))
    throw InputError(
        fmt::format("{}: its surface is not closed, allowed: tetrahedra that meet face to face", grain_name));
  return boundary;
}

} // namespace mpfem
