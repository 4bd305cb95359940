#pragma once
// The surface of a grain's mesh.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mpfem {

/// Faces that belong to one tetrahedron only, outward counter-clockwise, for the tets [begin, end) of `tet` [tets * 4].
/// `grain_name` stands for the grain in messages. Throws InputError where more than two tetrahedra share a face, or the
/// faces left over do not close the grain.
std::vector<std::array<std::int32_t, 3>> boundary_faces(const std::vector<std::int32_t>& tet, std::int32_t begin,
                                                        std::int32_t end, const std::string& grain_name);

} // namespace mpfem
